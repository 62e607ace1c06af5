#include "scene/gltf_light_extensions.h"

#include <utility>

#include "scene/gltf_extension.h"
#include "scene/uri.h"

namespace laterna::gltf {

tl::expected<std::filesystem::path, std::string> LightExtensions::Files::find(std::string_view name) {
  return resolve_file(folder_, name);
}

std::optional<std::filesystem::path> LightExtensions::Files::pattern(std::string_view name) {
  const std::filesystem::path path = percent_decoded(name);
  if (path.is_absolute() || path.string().find('\0') != std::string::npos) return std::nullopt;
  return folder_ / path;
}

int LightExtensions::Files::read_picture(JsonObject& light, std::string_view key) {
  return textures_.read_picture(light, key);
}

LightExtensions::LightExtensions(const JsonDocument& json, Textures& textures, std::filesystem::path folder,
                                 FaultList& faults)
    : json_(json), files_(textures, std::move(folder)), faults_(faults) {}

Light LightExtensions::extend(const JsonValue& value, Light light) {
  const JsonValue* projector = find_extension(value, kProjectorExtension);
  const JsonValue* lighting = find_extension(value, kLightingExtension);
  if (projector != nullptr && lighting != nullptr) {
    faults_.error(json_.place(*lighting),
                  "stands beside LATERNA_projector, which says all of it: give one of them");
    return light;
  }
  if (projector != nullptr) {
    if (light.type != LightType::spot || light.distribution != nullptr) {
      faults_.error(json_.place(*projector), "only a light of type \"spot\" can be a projector");
      return light;
    }
    // The cone is for those who do not read this.
    light.type = LightType::projector;
    light.inner_cone = Light().inner_cone;
    light.outer_cone = Light().outer_cone;
  }
  const JsonValue* extension = projector != nullptr ? projector : lighting;
  if (extension == nullptr) return light;
  return read_light_extension(json_, *extension, files_, faults_, std::move(light));
}

}  // namespace laterna::gltf
