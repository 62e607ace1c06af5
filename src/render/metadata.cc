#include "render/metadata.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/channels.h"

namespace laterna::render {
namespace {

template <class Description, class Value>
std::string_view name_in(std::span<const Description> all, Value Description::*member, Value value) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Description& d) { return d.*member == value; });
  return found == all.end() ? std::string_view() : found->name;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string_view shading_name(ShadingModel model) {
  switch (model) {
    case ShadingModel::papers:
      return "papers";
    case ShadingModel::phong:
      return "phong";
    case ShadingModel::pbr:
      break;
  }
  return "pbr";
}

std::string matrix_text(const glm::dmat4& m) {
  std::string text;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      text += fmt::format("{}{}", text.empty() ? "" : " ", m[column][row]);
  }
  return text;
}

}  // namespace

std::map<std::string, std::string> describe(const RenderSettings& settings, const View& view,
                                            const frame::Frame& frame) {
  std::map<std::string, std::string> all;
  all["laterna.samples"] = std::to_string(settings.samples);
  all["laterna.shading"] = shading_name(settings.shading);
  all["laterna.shadows"] = name_in(list_techniques(), &TechniqueDescription::technique, settings.shadows);
  all["laterna.passes"] = settings.passes == Passes::multi ? "multi" : "single";
  all["laterna.interpolation"] = settings.interpolation == Interpolation::affine ? "affine" : "perspective";
  all["laterna.anisotropy"] = std::to_string(settings.anisotropy);
  all["laterna.clip_from_world"] = matrix_text(view.clip_from_world());
  all["laterna.view_from_world"] = matrix_text(view.view_from_world());
  if (has_layer(settings, Layer::object)) {
    std::string names = "{";
    for (std::size_t i = 0; i < frame.object_names.size(); ++i) {
      names += fmt::format("{}\"{}\": {}", i == 0 ? "" : ", ", i, quoted(frame.object_names[i]));
    }
    all["laterna.objects"] = names + "}";
  }
  return all;
}

}  // namespace laterna::render
