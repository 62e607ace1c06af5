#include "scene/gltf_lights.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/elementary.h"
#include "scene/gltf_extension.h"
#include "scene/json_object.h"
#include "scene/rig_frustum.h"

namespace laterna::gltf {
namespace {

constexpr NumberRange kFieldOfView{0, kPi, true, true};
// Up to a right angle, which in single precision, as exporters write it, is a little more: 1.57079637.
constexpr NumberRange kHalfAngle{0, 1.5707964, false, false};

// Reads a member that must be there.
double required_number(JsonObject& object, std::string_view name, const NumberRange& range) {
  object.require(name);
  return object.number(name, range).value_or(0);
}

void read_perspective(JsonObject& object, Camera& camera) {
  const double yfov = required_number(object, "yfov", kFieldOfView);
  const double near = required_number(object, "znear", kPositive);
  const std::optional<double> far = object.number("zfar", kPositive);
  const std::optional<double> aspect = object.number("aspectRatio", kPositive);
  if (far && *far <= near) object.error("zfar", fmt::format("must be beyond znear ({}), got {}", near, *far));
  camera.projection = Projection::perspective(Angle::radians(yfov), aspect.value_or(1), near,
                                              far.value_or(std::numeric_limits<double>::infinity()));
  camera.aspect_from_picture = !aspect;
}

void read_orthographic(JsonObject& object, Camera& camera) {
  const double xmag = required_number(object, "xmag", kPositive);
  const double ymag = required_number(object, "ymag", kPositive);
  const double near = required_number(object, "znear", kNotNegative);
  const double far = required_number(object, "zfar", kPositive);
  if (far != 0 && far <= near)
    object.error("zfar", fmt::format("must be beyond znear ({}), got {}", near, far));
  camera.projection = Projection::orthographic(xmag, ymag, near, far);
  camera.aspect_from_picture = false;
}

// A frustum that glTF cannot say: off the axis, or of OpenCV's intrinsics.
void read_extended_frustum(const JsonDocument& json, const JsonValue& value, FaultList& faults,
                           Camera& camera) {
  const JsonValue* extension = find_extension(value, kLightingExtension);
  if (extension == nullptr) return;
  JsonObject object(json, *extension, faults, kGltfNames);
  for (const std::string_view allowed : {"extensions", "extras"}) object.any(allowed);
  const std::optional<bool> from_picture = object.boolean("aspect_from_picture");
  const auto frustum = read_frustum(json, object, faults, FrustumOf::camera, std::nullopt,
                                    DepthRange{camera.projection.near, camera.projection.far});
  object.report_unknown_members("a camera");
  if (!frustum) return;
  camera.projection = frustum->projection;
  camera.aspect_from_picture = from_picture.value_or(!frustum->aspect_is_given);
}

void read_spot(const JsonDocument& json, JsonObject& object, Light& light, FaultList& faults) {
  light.inner_cone = Angle::radians(0);
  light.outer_cone = Angle::radians(kPi / 4);
  object.require("spot");
  const JsonValue* value = object.object("spot");
  if (value == nullptr) return;
  JsonObject spot(json, *value, faults);
  const auto half_angle = [&](std::string_view name, double fallback) {
    return Angle::radians(std::min(spot.number(name, kHalfAngle).value_or(fallback), kPi / 2));
  };
  light.inner_cone = half_angle("innerConeAngle", 0);
  light.outer_cone = half_angle("outerConeAngle", kPi / 4);
  if (light.inner_cone > light.outer_cone) {
    spot.error("innerConeAngle", fmt::format("must not exceed outerConeAngle ({}), got {}",
                                             light.outer_cone.in_radians(), light.inner_cone.in_radians()));
  }
}

}  // namespace

std::optional<Camera> read_camera(const JsonDocument& json, const JsonValue& value, FaultList& faults) {
  const std::size_t errors_before = faults.error_count();
  JsonObject object(json, value, faults);
  Camera camera;
  camera.name = object.string("name").value_or("");
  object.require("type");
  const auto is_orthographic = object.choice<bool>("type", {{"perspective", false}, {"orthographic", true}});
  if (!is_orthographic) return std::nullopt;
  const std::string_view kind = *is_orthographic ? "orthographic" : "perspective";
  object.require(kind);
  const JsonValue* lens = object.object(kind);
  if (lens == nullptr) return std::nullopt;
  JsonObject lens_object(json, *lens, faults);
  *is_orthographic ? read_orthographic(lens_object, camera) : read_perspective(lens_object, camera);
  if (faults.error_count() == errors_before) read_extended_frustum(json, value, faults, camera);
  if (faults.error_count() != errors_before) return std::nullopt;
  return camera;
}

std::optional<Light> read_light(const JsonDocument& json, const JsonValue& value, LightExtensions& extensions,
                                FaultList& faults) {
  const std::size_t errors_before = faults.error_count();
  JsonObject object(json, value, faults);
  Light light;
  light.name = object.string("name").value_or("");
  object.require("type");
  const auto type = object.choice<LightType>(
      "type",
      {{"directional", LightType::directional}, {"point", LightType::point}, {"spot", LightType::spot}});
  if (!type) return std::nullopt;
  light.type = *type;
  const auto color = object.numbers<3>("color", kNotNegative).value_or(std::array<double, 3>{1, 1, 1});
  light.color = glm::vec3(color[0], color[1], color[2]);
  light.intensity = object.number("intensity", kNotNegative).value_or(1);
  if (const std::optional<double> range = object.number("range", kPositive);
      range && *type != LightType::directional) {
    light.range = *range;
    light.attenuation = Attenuation::gltf_windowed;
  }
  if (*type == LightType::spot) read_spot(json, object, light, faults);
  light = extensions.extend(value, std::move(light));
  if (faults.error_count() != errors_before) return std::nullopt;
  return light;
}

const JsonValue* find_lights(const JsonDocument& json, FaultList& faults) {
  const JsonValue* extension = find_extension(json.root(), "KHR_lights_punctual");
  if (extension == nullptr) return nullptr;
  return JsonObject(json, *extension, faults).array("lights");
}

}  // namespace laterna::gltf
