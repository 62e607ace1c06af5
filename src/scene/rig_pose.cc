#include "scene/rig_pose.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "scene/rig_ranges.h"

namespace laterna {
namespace {

glm::dvec3 to_vec3(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

// +Y, except for who looks along it: looking down, the top of the picture is toward −Z, as on a map with
// north up.
glm::dvec3 default_up(glm::dvec3 gaze) {
  const glm::dvec3 y(0, 1, 0);
  const double length = std::sqrt(glm::dot(gaze, gaze));
  const glm::dvec3 side = glm::cross(gaze / length, y);
  if (glm::dot(side, side) > 1e-12) return y;
  return gaze.y < 0 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 0, 1);
}

}  // namespace

std::optional<glm::dmat4> read_pose(JsonObject& object) {
  const bool is_complete = object.require_all({"position", "target"});
  const auto position = object.numbers<3>("position", kCoordinate);
  const auto target = object.numbers<3>("target", kCoordinate);
  const auto up = object.numbers<3>("up", kCoordinate);
  if (!is_complete || !position || !target || (object.has("up") && !up)) return std::nullopt;
  const glm::dvec3 gaze = to_vec3(*target) - to_vec3(*position);
  if (gaze == glm::dvec3(0)) {
    object.error("target", "is the same point as position: there is no direction to look in");
    return std::nullopt;
  }
  const Result<Pose> pose =
      Pose::look_at(to_vec3(*position), to_vec3(*target), up ? to_vec3(*up) : default_up(gaze));
  if (!pose) {
    object.error(up ? "up" : "target", to_string(pose.error()));
    return std::nullopt;
  }
  return pose->world_from_view();
}

std::optional<std::array<double, 9>> read_look_at(JsonObject& key, JsonObject& owner) {
  const auto of = [&](std::string_view name) {
    return key.has(name) ? key.numbers<3>(name, kCoordinate) : owner.numbers<3>(name, kCoordinate);
  };
  const auto position = of("position"), target = of("target"), up = of("up");
  if (!position || !target || (key.has("up") && !up)) return std::nullopt;
  const glm::dvec3 gaze = to_vec3(*target) - to_vec3(*position);
  if (gaze == glm::dvec3(0)) {
    key.error(key.has("target") ? "target" : "position",
              "position and target are the same point: there is no direction to look in");
    return std::nullopt;
  }
  const glm::dvec3 upward = up ? to_vec3(*up) : default_up(gaze);
  const Result<Pose> pose = Pose::look_at(to_vec3(*position), to_vec3(*target), upward);
  if (!pose) {
    key.error(key.has("up") ? "up" : "target", to_string(pose.error()));
    return std::nullopt;
  }
  return std::array<double, 9>{(*position)[0], (*position)[1], (*position)[2], (*target)[0], (*target)[1],
                               (*target)[2],   upward.x,       upward.y,       upward.z};
}

}  // namespace laterna
