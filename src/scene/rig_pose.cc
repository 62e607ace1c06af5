#include "scene/rig_pose.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"
#include "scene/rig_ranges.h"

namespace laterna {
namespace {

constexpr double kDefaultNear = 0.1;
constexpr std::array<std::string_view, 4> kOpenings = {"yfov_deg", "hfov_deg", "intrinsics", "orthographic"};

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

std::optional<Projection> from_intrinsics(const JsonDocument& json, const JsonValue& value, FaultList& faults,
                                          double near, double far) {
  JsonObject object(json, value, faults);
  const std::size_t errors_before = faults.error_count();
  object.require_all({"fx", "fy", "cx", "cy", "width", "height"});
  const double fx = object.number("fx", kPositive).value_or(1),
               fy = object.number("fy", kPositive).value_or(1);
  const double cx = object.number("cx").value_or(0), cy = object.number("cy").value_or(0);
  const double width = object.number("width", kPositive).value_or(1);
  const double height = object.number("height", kPositive).value_or(1);
  object.report_unknown_members("intrinsics");
  if (faults.error_count() != errors_before) return std::nullopt;
  return Projection::from_intrinsics(fx, fy, cx, cy, width, height, near, far);
}

std::optional<Projection> orthographic(const JsonDocument& json, const JsonValue& value, FaultList& faults,
                                       double aspect, double near, double far) {
  JsonObject object(json, value, faults);
  object.require("height");
  const std::optional<double> height = object.number("height", kPositive);
  object.report_unknown_members("orthographic");
  if (!height) return std::nullopt;
  return Projection::orthographic(*height / 2 * aspect, *height / 2, near, far);
}

// The vertical field of a frustum that is `hfov` wide.
Angle vertical_field(Angle hfov, double aspect) {
  return Angle::radians(2 * arctangent(tangent(hfov.in_radians() / 2) / aspect));
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

bool has_one_opening(JsonObject& object) {
  std::vector<std::string_view> given;
  for (const std::string_view name : kOpenings) {
    object.any(name);
    if (object.has(name)) given.push_back(name);
  }
  if (given.size() == 1) return true;
  if (given.empty()) {
    object.error({}, fmt::format("needs one of \"{}\"", fmt::join(kOpenings, "\", \"")));
  } else {
    object.error(given[1], fmt::format("only one of \"{}\" may be given", fmt::join(given, "\" and \"")));
  }
  return false;
}

std::optional<RigFrustum> read_frustum(const JsonDocument& json, JsonObject& object, FaultList& faults,
                                       std::optional<double> aspect_of_picture) {
  const std::size_t errors_before = faults.error_count();
  const bool is_orthographic = object.has("orthographic");
  const double near = object.number("near", is_orthographic ? kAnyNumber : kPositive)
                          .value_or(is_orthographic ? 0 : kDefaultNear);
  const double far = object.number("far").value_or(std::numeric_limits<double>::infinity());
  const std::optional<double> aspect = object.number("aspect", kPositive);
  const std::optional<double> yfov = object.number("yfov_deg", kFieldOfView);
  const std::optional<double> hfov = object.number("hfov_deg", kFieldOfView);
  const JsonValue* intrinsics = object.object("intrinsics");
  const JsonValue* parallel = object.object("orthographic");
  if (far <= near) object.error("far", fmt::format("must be beyond near ({}), got {}", near, far));
  if (!has_one_opening(object) || faults.error_count() != errors_before) return std::nullopt;

  const double shape = aspect.value_or(aspect_of_picture.value_or(1));
  std::optional<Projection> projection;
  if (intrinsics != nullptr) {
    if (aspect) object.error("aspect", "follows from the intrinsics");
    projection = from_intrinsics(json, *intrinsics, faults, near, far);
  } else if (parallel != nullptr) {
    if (std::isinf(far)) object.error("far", "is missing: an orthographic view ends somewhere");
    projection = orthographic(json, *parallel, faults, shape, near, far);
  } else if (hfov) {
    if (!aspect && !aspect_of_picture)
      object.error("hfov_deg", "needs \"aspect\" (width / height) beside it");
    projection = Projection::perspective(vertical_field(Angle::degrees(*hfov), shape), shape, near, far);
  } else {
    projection = Projection::perspective(Angle::degrees(yfov.value_or(1)), shape, near, far);
  }
  if (!projection || faults.error_count() != errors_before) return std::nullopt;
  if (std::string fault = find_fault(*projection); !fault.empty()) {
    object.error({}, std::move(fault));
    return std::nullopt;
  }
  return RigFrustum{*projection, aspect.has_value() || intrinsics != nullptr};
}

}  // namespace laterna
