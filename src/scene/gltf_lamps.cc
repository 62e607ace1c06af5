#include "scene/gltf_lamps.h"

#include <fmt/format.h>

#include <utility>

#include "scene/gltf_extension.h"
#include "scene/json_object.h"
#include "scene/uri.h"

namespace laterna::gltf {
namespace {

constexpr std::string_view kIesExtension = "EXT_lights_ies";
constexpr std::string_view kMimeType = "application/x-ies-lm-63";

}  // namespace

Lamps::Lamps(const JsonDocument& json, Buffers& buffers, std::filesystem::path folder, FaultList& faults)
    : json_(json), buffers_(buffers), folder_(std::move(folder)), faults_(faults) {
  const JsonValue* extension = find_extension(json.root(), kIesExtension);
  if (extension != nullptr) list_ = JsonObject(json, *extension, faults).array("lights");
  if (list_ != nullptr) profiles_.resize(list_->children.size());
}

std::optional<Light> Lamps::read(const JsonValue& node, LightExtensions& extensions) {
  const JsonValue* extension = find_extension(node, kIesExtension);
  if (extension == nullptr) return std::nullopt;
  JsonObject object(json_, *extension, faults_);
  object.require("light");
  const int index = object.index("light", profiles_.size(), "EXT_lights_ies.lights");
  Light light;
  light.type = LightType::point;
  light.intensity = object.number("multiplier", kNotNegative).value_or(1);
  const auto color = object.numbers<3>("color", kNotNegative).value_or(std::array<double, 3>{1, 1, 1});
  light.color = glm::vec3(color[0], color[1], color[2]);
  if (index < 0) return std::nullopt;
  light.distribution = profile(static_cast<std::size_t>(index));
  if (light.distribution == nullptr) return std::nullopt;
  const JsonValue& value = list_->children[static_cast<std::size_t>(index)];
  light.name = JsonObject(json_, value, faults_).string("name").value_or("");
  return extensions.extend(*extension, std::move(light));
}

std::shared_ptr<const LightDistribution> Lamps::profile(std::size_t index) {
  Profile& profile = profiles_[index];
  if (std::exchange(profile.is_read, true)) return profile.distribution;
  std::optional<Result<LightDistribution>> lamp = load(list_->children[index]);
  if (!lamp) return nullptr;
  if (*lamp) {
    if ((*lamp)->name.empty())
      (*lamp)->name = fmt::format("{}: {}", faults_.file(), json_.path(list_->children[index]));
    profile.distribution = std::make_shared<const LightDistribution>(std::move(**lamp));
  } else {
    faults_.error(json_.path(list_->children[index]), to_string(lamp->error()));
  }
  return profile.distribution;
}

// Nothing when there are no bytes, which has been reported.
std::optional<Result<LightDistribution>> Lamps::load(const JsonValue& value) {
  JsonObject object(json_, value, faults_);
  if (object.has("uri") == object.has("bufferView")) {
    object.error({}, "expected either a uri or a bufferView");
    return std::nullopt;
  }
  if (object.has("bufferView")) {
    object.require("mimeType");
    (void)object.choice<bool>("mimeType", {{kMimeType, true}});
    const int view = object.index("bufferView", buffers_.view_count(), "bufferViews");
    const std::optional<OwnedSpan> bytes = view < 0 ? std::nullopt : buffers_.read(view);
    if (!bytes) return std::nullopt;
    return read_lamp(bytes->bytes, {}, folder_);
  }
  const std::optional<std::string> uri = object.string("uri");
  if (!uri) return std::nullopt;
  if (is_data_uri(*uri)) {
    const auto decoded = decode_data_uri(*uri);
    if (decoded) return read_lamp(*decoded, {}, folder_);
    object.error("uri", decoded.error());
    return std::nullopt;
  }
  const auto path = resolve_file(folder_, *uri);
  if (path) return read_lamp_file(*path);
  object.error("uri", path.error());
  return std::nullopt;
}

}  // namespace laterna::gltf
