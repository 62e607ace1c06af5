#include "scene/rig_distortion.h"

#include <optional>

#include "laterna/lens.h"

namespace laterna {
namespace {

constexpr NumberRange kCoefficient{-kMaxDistortion, kMaxDistortion, false, false};

LensDistortion read_named(const JsonDocument& json, const JsonValue& value, FaultList& faults) {
  JsonObject object(json, value, faults);
  const auto number = [&](std::string_view name) { return object.number(name, kCoefficient).value_or(0); };
  const LensDistortion lens{number("k1"), number("k2"), number("p1"), number("p2"), number("k3")};
  object.report_unknown_members("a distortion");
  return lens;
}

LensDistortion read_in_order(JsonObject& light_object, std::size_t count) {
  if (count == 4) {
    const auto four = light_object.numbers<4>("distortion", kCoefficient);
    return four ? LensDistortion{(*four)[0], (*four)[1], (*four)[2], (*four)[3], 0} : LensDistortion{};
  }
  if (count == 5) {
    const auto five = light_object.numbers<5>("distortion", kCoefficient);
    return five ? LensDistortion{(*five)[0], (*five)[1], (*five)[2], (*five)[3], (*five)[4]}
                : LensDistortion{};
  }
  light_object.error("distortion", "expected 4 or 5 numbers: k1, k2, p1, p2 and k3, as OpenCV orders them");
  return {};
}

}  // namespace

void read_rig_distortion(const JsonDocument& json, JsonObject& light_object, FaultList& faults,
                         Light& light) {
  const JsonValue* value = light_object.any("distortion");
  if (value == nullptr) return;
  const std::size_t errors_before = faults.error_count();
  if (value->is_array()) {
    light.distortion = read_in_order(light_object, value->children.size());
  } else {
    light.distortion = read_named(json, *value, faults);
  }
  if (faults.error_count() != errors_before) return;
  if (std::string fault = find_fault(light.distortion, light.projection); !fault.empty())
    light_object.error("distortion", std::move(fault));
}

}  // namespace laterna
