#include "scene/rig_mirror.h"

#include <fmt/format.h>

#include "scene/rig_ranges.h"

namespace laterna {
namespace {

Wave read_wave(const JsonDocument& json, const JsonValue& value, FaultList& faults) {
  constexpr NumberRange kWaveLength{kShortestWave, kMaxCoordinate, false, false};
  constexpr NumberRange kSpeed{-1e6, 1e6, false, false}, kPhase{-36000, 36000, false, false};
  JsonObject object(json, value, faults);
  Wave wave;
  object.require_all({"direction", "length", "amplitude"});
  if (const auto d = object.numbers<3>("direction", kCoordinate)) {
    wave.direction_ws = {(*d)[0], (*d)[1], (*d)[2]};
    if (wave.direction_ws == glm::dvec3(0)) object.error("direction", "is the zero vector");
  }
  wave.length = object.number("length", kWaveLength).value_or(wave.length);
  wave.amplitude = object.number("amplitude", kLength).value_or(wave.amplitude);
  wave.speed = object.number("speed", kSpeed);
  wave.phase = Angle::degrees(object.number("phase_deg", kPhase).value_or(0)).in_radians();
  object.report_unknown_members("a wave");
  return wave;
}

}  // namespace

std::shared_ptr<const Mirror> read_rig_mirror(const JsonDocument& json, const JsonValue& value,
                                              FaultList& faults) {
  constexpr NumberRange kIor{1, kMaxMirrorIor, false, false};
  JsonObject object(json, value, faults);
  auto mirror = std::make_shared<Mirror>();
  if (const auto color = object.numbers<3>("reflectance", kZeroToOne))
    mirror->reflectance = glm::vec3((*color)[0], (*color)[1], (*color)[2]);
  if (const std::optional<double> ior = object.number("ior", kIor)) mirror->ior = static_cast<float>(*ior);
  mirror->roughness = static_cast<float>(object.number("roughness", kZeroToOne).value_or(0));
  if (const JsonValue* waves = object.array("waves")) {
    if (waves->children.size() > kMaxWaves)
      object.error("waves", fmt::format("{} waves are more than {}", waves->children.size(), kMaxWaves));
    for (const JsonValue& wave : waves->children) mirror->waves.push_back(read_wave(json, wave, faults));
  }
  object.report_unknown_members("a mirror");
  mirror->file = faults.file();
  mirror->place = json.place(value);
  return mirror;
}

}  // namespace laterna
