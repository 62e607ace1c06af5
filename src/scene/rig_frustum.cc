#include "scene/rig_frustum.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "base/elementary.h"
#include "scene/rig_ranges.h"

namespace laterna {
namespace {

constexpr double kDefaultNear = 0.1;

// What says how wide a frustum is; the last is for projectors alone.
constexpr std::array<std::string_view, 7> kOpenings = {
    "yfov_deg", "hfov_deg", "focal_length_mm", "intrinsics", "orthographic", "frustum", "throw_ratio"};

// Widths and heights of the picture: far beyond any lens.
constexpr NumberRange kLensShift{-100, 100, false, false};

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
  JsonObject object(json, value, faults);  // one word: spelled alike everywhere
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

std::vector<std::string_view> spelled(const JsonObject& object, std::span<const std::string_view> names) {
  std::vector<std::string_view> words;
  for (const std::string_view name : names) words.push_back(object.names().spelled(name));
  return words;
}

// Whether one key, and only one, says how wide the frustum is.
bool has_one_opening(JsonObject& object, FrustumOf of) {
  const std::size_t count = kOpenings.size() - (of == FrustumOf::projector ? 0 : 1);
  const std::span openings = std::span(kOpenings).first(count);
  std::vector<std::string_view> given;
  for (const std::string_view name : openings) {
    object.any(name);
    if (object.has(name)) given.push_back(name);
  }
  if (given.size() == 1) return true;
  if (given.empty()) {
    object.error({}, fmt::format("needs one of \"{}\"", fmt::join(spelled(object, openings), "\", \"")));
  } else {
    object.error(given[1], fmt::format("only one of \"{}\" may be given",
                                       fmt::join(spelled(object, given), "\" and \"")));
  }
  return false;
}

// "sensor_mm": a width, or a width and a height.
struct Sensor {
  double width = 1;
  std::optional<double> height;
};

bool is_width_and_height(const JsonObject& object) {
  const JsonValue* value = object.value().find(object.names().spelled("sensor_mm"));
  return value != nullptr && value->is_array();
}

std::optional<Sensor> read_sensor(JsonObject& object) {
  if (!object.has("sensor_mm")) return std::nullopt;
  if (!is_width_and_height(object)) {
    const std::optional<double> width = object.number("sensor_mm", kPositive);
    return width ? std::optional(Sensor{*width, std::nullopt}) : std::nullopt;
  }
  const auto sides = object.numbers<2>("sensor_mm", kPositive);
  return sides ? std::optional(Sensor{(*sides)[0], (*sides)[1]}) : std::nullopt;
}

}  // namespace

bool needs_aspect_of_picture(const JsonObject& object) {
  if (object.has("aspect") || is_width_and_height(object)) return false;
  return object.has("hfov_deg") || object.has("focal_length_mm") || object.has("throw_ratio");
}

namespace {

// Reads the keys of a frustum and puts it together; every fault is reported.
class FrustumReader {
 public:
  FrustumReader(const JsonDocument& json, JsonObject& object, FaultList& faults, FrustumOf of,
                std::optional<double> aspect_of_picture, std::optional<DepthRange> range)
      : json_(json),
        object_(object),
        faults_(faults),
        of_(of),
        aspect_of_picture_(aspect_of_picture),
        known_range_(range) {}

  std::optional<RigFrustum> read() {
    const std::size_t errors_before = faults_.error_count();
    read_range();
    aspect_ = object_.number("aspect", kPositive);
    yfov_ = object_.angle("yfov_deg", kFieldOfView);
    hfov_ = object_.angle("hfov_deg", kFieldOfView);
    focal_length_ = object_.number("focal_length_mm", kPositive);
    sensor_ = read_sensor(object_);
    if (of_ == FrustumOf::projector) throw_ratio_ = object_.number("throw_ratio", kPositive);
    intrinsics_ = object_.object("intrinsics");
    orthographic_ = object_.object("orthographic");
    sides_ = object_.object("frustum");
    shift_ = object_.numbers<2>("lens_shift", kLensShift);
    check_together();
    if (!has_one_opening(object_, of_) || faults_.error_count() != errors_before) return std::nullopt;

    std::optional<Projection> projection = open();
    if (!projection || faults_.error_count() != errors_before) return std::nullopt;
    if (shift_) projection = projection->shifted((*shift_)[0], (*shift_)[1]);
    if (std::string fault = find_fault(*projection); !fault.empty()) {
      object_.error({}, std::move(fault));
      return std::nullopt;
    }
    return RigFrustum{*projection,
                      aspect_ || intrinsics_ != nullptr || sides_ != nullptr || (sensor_ && sensor_->height)};
  }

 private:
  void read_range() {
    const JsonValue* sides = object_.value().find("frustum");
    const JsonValue* is_parallel = sides == nullptr ? nullptr : sides->find("parallel");
    const bool is_orthographic =
        object_.has("orthographic") || (is_parallel != nullptr && is_parallel->boolean);
    const DepthRange range = known_range_.value_or(
        DepthRange{is_orthographic ? 0 : kDefaultNear, std::numeric_limits<double>::infinity()});
    near_ = object_.number("near", is_orthographic ? kAnyNumber : kPositive).value_or(range.near);
    far_ = object_.number("far").value_or(range.far);
    if (far_ <= near_) {
      object_.error(
          "far", fmt::format("must be beyond {} ({}), got {}", object_.names().spelled("near"), near_, far_));
    }
  }

  // Keys that need or exclude each other.
  void check_together() {
    if (object_.has("focal_length_mm") && !object_.has("sensor_mm"))
      object_.error("focal_length_mm", fmt::format("needs {} beside it: width, or [width, height]",
                                                   object_.quoted("sensor_mm")));
    if (object_.has("sensor_mm") && !object_.has("focal_length_mm"))
      object_.error("sensor_mm", fmt::format("needs {} beside it", object_.quoted("focal_length_mm")));
    if (object_.has("aspect") && is_width_and_height(object_))
      object_.error("aspect", "follows from the sensor's width and height");
    if (shift_ && intrinsics_ != nullptr)
      object_.error("lens_shift", "follows from the intrinsics' cx and cy");
    for (const std::string_view name : {"aspect", "lens_shift"}) {
      if (sides_ != nullptr && object_.has(name))
        object_.error(name, "follows from the sides of the frustum");
    }
    for (const std::string_view name : {"hfov_deg", "focal_length_mm"}) {
      if (of_ == FrustumOf::camera && object_.has(name) && needs_aspect_of_picture(object_))
        object_.error(name, fmt::format("needs {} (width / height) beside it", object_.quoted("aspect")));
    }
  }

  std::optional<Projection> open() {
    const double shape = aspect_.value_or(aspect_of_picture_.value_or(1));
    if (intrinsics_ != nullptr) {
      if (aspect_) object_.error("aspect", "follows from the intrinsics");
      return from_intrinsics(json_, *intrinsics_, faults_, near_, far_);
    }
    if (orthographic_ != nullptr) {
      if (std::isinf(far_)) object_.error("far", "is missing: an orthographic view ends somewhere");
      return orthographic(json_, *orthographic_, faults_, shape, near_, far_);
    }
    if (sides_ != nullptr) {
      Projection projection = Projection::perspective(Angle::degrees(1), 1, near_, far_);
      read_sides(json_, *sides_, faults_, projection);
      return projection;
    }
    if (hfov_) return Projection::perspective(vertical_field(*hfov_, shape), shape, near_, far_);
    if (throw_ratio_) return Projection::from_throw_ratio(*throw_ratio_, shape, near_, far_);
    if (focal_length_) {
      const double height = sensor_->height.value_or(sensor_->width / shape);
      return Projection::from_focal_length(*focal_length_, sensor_->width, height, near_, far_);
    }
    return Projection::perspective(yfov_.value_or(Angle::degrees(1)), shape, near_, far_);
  }

  const JsonDocument& json_;
  JsonObject& object_;
  FaultList& faults_;
  FrustumOf of_;
  std::optional<double> aspect_of_picture_;
  std::optional<DepthRange> known_range_;
  double near_ = kDefaultNear, far_ = std::numeric_limits<double>::infinity();
  std::optional<double> aspect_, focal_length_, throw_ratio_;
  std::optional<Angle> yfov_, hfov_;
  std::optional<Sensor> sensor_;
  std::optional<std::array<double, 2>> shift_;
  const JsonValue* intrinsics_ = nullptr;
  const JsonValue* orthographic_ = nullptr;
  const JsonValue* sides_ = nullptr;
};

}  // namespace

void read_sides(const JsonDocument& json, const JsonValue& value, FaultList& faults, Projection& projection) {
  JsonObject object(json, value, faults);
  object.require_all({"left", "right", "bottom", "top"});
  projection.left = object.number("left").value_or(projection.left);
  projection.right = object.number("right").value_or(projection.right);
  projection.bottom = object.number("bottom").value_or(projection.bottom);
  projection.top = object.number("top").value_or(projection.top);
  projection.is_orthographic = object.boolean("parallel").value_or(projection.is_orthographic);
  object.report_unknown_members("a frustum");
}

std::optional<RigFrustum> read_frustum(const JsonDocument& json, JsonObject& object, FaultList& faults,
                                       FrustumOf of, std::optional<double> aspect_of_picture,
                                       std::optional<DepthRange> range) {
  return FrustumReader(json, object, faults, of, aspect_of_picture, range).read();
}

}  // namespace laterna
