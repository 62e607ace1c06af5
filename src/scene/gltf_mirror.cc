#include "scene/gltf_mirror.h"

#include "scene/gltf_extension.h"
#include "scene/gltf_setting_writer.h"
#include "scene/mirror_settings.h"

namespace laterna::gltf {
namespace {

Json wave_json(const Wave& wave) {
  Json json = Json::object();
  set(json, "direction", components(wave.direction_ws));
  set(json, "length", wave.length);
  set(json, "amplitude", wave.amplitude);
  if (wave.speed) set(json, "speed", *wave.speed);
  if (wave.phase != 0) set(json, "phase_deg", wave.phase);
  return json;
}

Json volume_json(const MirrorVolume& volume) {
  const MirrorVolume usual;
  Json json = Json::object();
  if (volume.attenuation_color != usual.attenuation_color)
    set(json, "attenuation_color", components(volume.attenuation_color));
  if (volume.attenuation_distance != usual.attenuation_distance)
    set(json, "attenuation_distance", shortest(volume.attenuation_distance));
  return json;
}

}  // namespace

std::shared_ptr<const Mirror> read_mirror(const JsonDocument& json, const JsonValue& material,
                                          AlphaMode alpha_mode, FaultList& faults) {
  const JsonValue* extension = find_extension(material, kMirrorExtension);
  if (extension == nullptr) return nullptr;
  std::shared_ptr<const Mirror> mirror = read_mirror_settings(json, *extension, faults, kGltfNames);
  if (const std::string fault = find_volume_fault(*mirror, alpha_mode); !fault.empty())
    faults.error(json.place(*extension, "volume"), fault);
  return mirror;
}

Json mirror_json(const Mirror& mirror) {
  const Mirror usual;
  Json json = Json::object();
  if (mirror.reflectance != usual.reflectance) set(json, "reflectance", components(mirror.reflectance));
  if (mirror.ior) set(json, "ior", shortest(*mirror.ior));
  if (mirror.roughness != usual.roughness) set(json, "roughness", shortest(mirror.roughness));
  if (!mirror.waves.empty()) {
    Json waves = Json::array();
    for (const Wave& wave : mirror.waves) waves.push_back(wave_json(wave));
    set(json, "waves", std::move(waves));
  }
  if (mirror.volume) set(json, "volume", volume_json(*mirror.volume));
  return json;
}

}  // namespace laterna::gltf
