#include "scene/gltf_lobes.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "scene/gltf_extension.h"
#include "scene/lobe_factors.h"

namespace laterna::gltf {
namespace {

// glTF's defaults are those of MaterialLobes.
void read_factor(JsonObject& object, std::string_view member, const LobeFactor& factor,
                 MaterialLobes& lobes) {
  std::array<double, 3> values{};
  if (factor.components == 3) {
    const auto read = object.numbers<3>(member);
    if (!read) return;
    values = *read;
  } else {
    const std::optional<double> read = object.number(member);
    if (!read) return;
    values[0] = *read;
  }
  const std::span<float> numbers = factor.of(lobes);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = factor.nearest(values[i]);
    if (!factor.allows(values[i]))
      object.warning(member, fmt::format("{} is out of range and taken as {}", values[i], numbers[i]));
  }
}

// Of a textureInfo: "clearcoatNormalTexture/scale".
void read_texture_factor(const JsonDocument& json, JsonObject& object, const LobeFactor& factor,
                         FaultList& faults, MaterialLobes& lobes) {
  const std::size_t slash = factor.member.find('/');
  const JsonValue* info = object.object(factor.member.substr(0, slash));
  if (info == nullptr) return;
  JsonObject texture(json, *info, faults);
  read_factor(texture, factor.member.substr(slash + 1), factor, lobes);
}

bool is_of_texture(const LobeFactor& factor) { return factor.member.find('/') != std::string_view::npos; }

}  // namespace

void read_lobes(const JsonDocument& json, const JsonValue& material, Textures& textures, FaultList& faults,
                Material& result) {
  MaterialLobes lobes;
  bool has_any = false;
  for (const LobeFactor& factor : lobe_factors()) {
    const JsonValue* extension = find_extension(material, factor.extension);
    if (extension == nullptr) continue;
    has_any = true;
    JsonObject object(json, *extension, faults);
    if (is_of_texture(factor)) {
      read_texture_factor(json, object, factor, faults, lobes);
    } else {
      read_factor(object, factor.member, factor, lobes);
    }
  }
  if (!has_any) return;
  const std::array<Texture*, kLobeTextures> of_lobes = textures_of(lobes);
  for (std::size_t i = 0; i < kLobeTextures; ++i) {
    const LobeTexture& texture = lobe_textures()[i];
    const JsonValue* extension = find_extension(material, texture.extension);
    if (extension == nullptr || !extension->is_object()) continue;
    JsonObject object(json, *extension, faults);
    *of_lobes[i] = textures.read(object, texture.member, result.name);
  }
  result.lobes = std::make_shared<const MaterialLobes>(std::move(lobes));
}

void write_lobes(
    const Material& material, Document& document, Json& json,
    const std::function<void(Json& object, const char* name, const Texture& texture)>& set_texture) {
  if (material.lobes == nullptr) return;
  const MaterialLobes usual;
  const std::array<const Texture*, kLobeTextures> textures = textures_of(*material.lobes);
  std::string_view last;
  for (const LobeFactor& first : lobe_factors()) {
    if (first.extension == last) continue;
    last = first.extension;
    Json extension = Json::object();
    for (std::size_t i = 0; i < kLobeTextures; ++i) {
      if (lobe_textures()[i].extension == last)
        set_texture(extension, std::string(lobe_textures()[i].member).c_str(), *textures[i]);
    }
    for (const LobeFactor& factor : lobe_factors()) {
      if (factor.extension != last) continue;
      const std::span<const float> values = factor.of(*material.lobes);
      const std::span<const float> usual_values = factor.of(usual);
      if (std::equal(values.begin(), values.end(), usual_values.begin())) continue;
      Json value = shortest(values[0]);
      if (factor.components == 3) value = {shortest(values[0]), shortest(values[1]), shortest(values[2])};
      if (!is_of_texture(factor)) {
        extension[std::string(factor.member)] = std::move(value);
        continue;
      }
      const std::size_t slash = factor.member.find('/');
      const std::string info(factor.member.substr(0, slash));
      if (extension.contains(info)) extension[info][std::string(factor.member.substr(slash + 1))] = value;
    }
    if (!extension.empty()) document.extend(json, last, std::move(extension));
  }
}

}  // namespace laterna::gltf
