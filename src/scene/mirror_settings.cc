#include "scene/mirror_settings.h"

#include <fmt/format.h>

#include <limits>

#include "scene/rig_ranges.h"

namespace laterna {
namespace {

Wave read_wave(const JsonDocument& json, const JsonValue& value, FaultList& faults,
               const SettingNames& names) {
  constexpr NumberRange kWaveLength{kShortestWave, kMaxCoordinate, false, false};
  constexpr NumberRange kSpeed{-1e6, 1e6, false, false};
  const double most = Angle::radians(kMaxWavePhase).in_degrees();
  const NumberRange phase{-most, most, false, false};
  JsonObject object(json, value, faults, names);
  Wave wave;
  object.require_all({"direction", "length", "amplitude"});
  if (const auto d = object.numbers<3>("direction", kCoordinate)) {
    wave.direction_ws = {(*d)[0], (*d)[1], (*d)[2]};
    if (wave.direction_ws == glm::dvec3(0)) object.error("direction", "is the zero vector");
  }
  wave.length = object.number("length", kWaveLength).value_or(wave.length);
  wave.amplitude = object.number("amplitude", kLength).value_or(wave.amplitude);
  wave.speed = object.number("speed", kSpeed);
  wave.phase = object.angle("phase_deg", phase).value_or(Angle()).in_radians();
  object.report_unknown_members("a wave");
  return wave;
}

MirrorVolume read_volume(const JsonDocument& json, const JsonValue& value, FaultList& faults,
                         const SettingNames& names) {
  constexpr NumberRange kDistance{kLeastAttenuationDistance, std::numeric_limits<float>::max(), false, false};
  JsonObject object(json, value, faults, names);
  MirrorVolume volume;
  if (const auto color = object.numbers<3>("attenuation_color", kZeroToOne))
    volume.attenuation_color = glm::vec3((*color)[0], (*color)[1], (*color)[2]);
  if (const std::optional<double> distance = object.number("attenuation_distance", kDistance))
    volume.attenuation_distance = static_cast<float>(*distance);
  object.report_unknown_members("a volume");
  return volume;
}

}  // namespace

std::shared_ptr<const Mirror> read_mirror_settings(const JsonDocument& json, const JsonValue& value,
                                                   FaultList& faults, const SettingNames& names) {
  constexpr NumberRange kIor{1, kMaxMirrorIor, false, false};
  JsonObject object(json, value, faults, names);
  auto mirror = std::make_shared<Mirror>();
  if (const auto color = object.numbers<3>("reflectance", kZeroToOne))
    mirror->reflectance = glm::vec3((*color)[0], (*color)[1], (*color)[2]);
  if (const std::optional<double> ior = object.number("ior", kIor)) mirror->ior = static_cast<float>(*ior);
  mirror->roughness = static_cast<float>(object.number("roughness", kZeroToOne).value_or(0));
  if (const JsonValue* waves = object.array("waves")) {
    if (waves->children.size() > kMaxWaves)
      object.error("waves", fmt::format("{} waves are more than {}", waves->children.size(), kMaxWaves));
    for (const JsonValue& wave : waves->children)
      mirror->waves.push_back(read_wave(json, wave, faults, names));
  }
  if (const JsonValue* volume = object.object("volume")) {
    mirror->volume = read_volume(json, *volume, faults, names);
    if (!object.has("ior")) object.error("volume", "bends light by \"ior\", and there is none");
  }
  if (&names == &kGltfNames) {
    for (const std::string_view known : {"extensions", "extras"}) (void)object.any(known);
  }
  object.report_unknown_members("a mirror");
  mirror->file = faults.file();
  mirror->place = json.place(value);
  return mirror;
}

std::string find_volume_fault(const Mirror& mirror, AlphaMode alpha_mode) {
  if (!mirror.volume || alpha_mode == AlphaMode::blend) return {};
  return "is seen through surfaces that blend (alphaMode BLEND); this material does not";
}

}  // namespace laterna
