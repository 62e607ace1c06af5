#include "scene/gltf_environment_writer.h"

#include <glm/gtc/quaternion.hpp>

namespace laterna::gltf {
namespace {

constexpr const char* kImageBasedExtension = "EXT_lights_image_based";
constexpr const char* kPlace = "environment";

void warn_of_rest(const Environment& environment, Document& document) {
  if (environment.distance != EnvironmentDistance::infinite)
    document.warn(kPlace, "glTF has no boxes and spheres about environments: it is infinitely far there");
  if (!environment.visible)
    document.warn(kPlace, "glTF cannot hide an environment: whether it is seen is the viewer's choice");
}

}  // namespace

Result<void> write_environment(const Scene& scene, PictureWriter& pictures, Document& document) {
  if (!scene.environment) return {};
  const Environment& environment = *scene.environment;
  if (environment.specular_pictures.empty() || !environment.irradiance) {
    document.warn(kPlace,
                  "is not carried: glTF holds filtered environments alone, which filter_environment() makes");
    return {};
  }
  Json levels = Json::array();
  int side = 0;
  for (const std::array<int, 6>& faces : environment.specular_pictures) {
    Json level = Json::array();
    for (const int face : faces) {
      const Result<int> image = pictures.image(face);
      if (!image) return tl::unexpected(image.error());
      if (side == 0) side = pictures.size(face).width;
      level.push_back(*image);
    }
    levels.push_back(std::move(level));
  }
  Json irradiance = Json::array();
  for (const glm::dvec3& coefficient : *environment.irradiance) irradiance.push_back(components(coefficient));
  Json light = Json::object();
  set_unless(light, "intensity", environment.intensity, 1.0);
  const glm::dquat rotation = glm::quat_cast(environment.world_from_environment);
  if (rotation.w != 1) light["rotation"] = {rotation.x, rotation.y, rotation.z, rotation.w};
  light["irradianceCoefficients"] = std::move(irradiance);
  light["specularImageSize"] = side;
  light["specularImages"] = std::move(levels);
  document.extension(kImageBasedExtension)["lights"] = Json::array({std::move(light)});
  document.extend(document.at("scenes", 0), kImageBasedExtension, {{"light", 0}});
  warn_of_rest(environment, document);
  return {};
}

}  // namespace laterna::gltf
