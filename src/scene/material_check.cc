#include "scene/material_check.h"

#include <fmt/format.h>

#include <cmath>

#include "laterna/mirrors.h"
#include "laterna/relief.h"
#include "scene/lobe_factors.h"
#include "scene/mirror_settings.h"
#include "scene/scene_check.h"
#include "scene/spelling.h"

namespace laterna {
namespace {

class MaterialCheck : SceneCheck {
 public:
  MaterialCheck(const Scene& scene, FaultList& faults) : SceneCheck(scene, faults) {}

  void run() {
    check_pictures();
    for (std::size_t i = 0; i < scene_.materials.size(); ++i)
      check_material(scene_.materials[i], item("materials", i));
  }

 private:
  void check_pictures();
  void check_film(const Picture& picture, const std::string& place);
  void check_texture(const Texture& texture, const std::string& place);
  void check_material(const Material& material, const std::string& place);
  void check_layers(const Material& material, const std::string& place);
  void check_light_map(const LightMap& light_map, const std::string& place);
  void check_lobes(const MaterialLobes& lobes, const std::string& place);
  void check_relief(const Material& material, const std::string& place);
  void check_mirror(const Mirror& mirror, AlphaMode alpha_mode, const std::string& place);
  void check_layer_projector(const SurfaceLayer& layer, const std::string& place);
};

void MaterialCheck::check_pictures() {
  for (std::size_t i = 0; i < scene_.pictures.size(); ++i) {
    const Picture& picture = scene_.pictures[i];
    const int sources =
        (picture.file.empty() ? 0 : 1) + (picture.encoded.empty() ? 0 : 1) + (picture.pixels ? 1 : 0);
    if (sources != 1) {
      fault(item("pictures", i),
            fmt::format("expected exactly one of file, encoded and pixels, got {}", sources));
    }
    if (picture.pixels && picture.pixels->empty())
      fault(item("pictures", i) + ".pixels", "the image is empty");
    if (picture.film) check_film(picture, item("pictures", i) + ".film");
  }
}

void MaterialCheck::check_film(const Picture& picture, const std::string& place) {
  const FilmTiming& film = *picture.film;
  if (picture.file.empty()) fault(place, "is set, but the picture is no file");
  const auto check = [&](const char* name, double value, double most) {
    if (!(value > 0 && value <= most))
      fault(place + name, fmt::format("expected a number greater than 0, at most {:g}, got {}", most, value));
  };
  check(".frames_per_second", film.frames_per_second, kMaxFramesPerSecond);
  check(".rate", film.rate, kMaxFilmRate);
  if (!(std::abs(film.start) <= kMaxSceneTime))
    fault(place + ".start", fmt::format("expected a number from {:g} to {:g}, got {}", -kMaxSceneTime,
                                        kMaxSceneTime, film.start));
  check_enumerator(place + ".at_end", film.at_end, AtEnd::ping_pong);
}

void MaterialCheck::check_texture(const Texture& texture, const std::string& place) {
  check_reference(place + ".picture", texture.picture, scene_.pictures.size(), "pictures");
  const auto picture = static_cast<std::size_t>(texture.picture);
  if (texture.is_set() && picture < scene_.pictures.size() && scene_.pictures[picture].film)
    fault(place + ".picture", "is a film; only a light's slide can be one");
  check_enumerator(place + ".sampler.wrap_u", texture.sampler.wrap_u, Wrap::clamp);
  check_enumerator(place + ".sampler.wrap_v", texture.sampler.wrap_v, Wrap::clamp);
  check_enumerator(place + ".sampler.magnify", texture.sampler.magnify, Filter::linear);
  check_enumerator(place + ".sampler.minify", texture.sampler.minify, Filter::linear);
  check_enumerator(place + ".sampler.mip", texture.sampler.mip, MipFilter::linear);
  if (texture.uv_set != 0 && texture.uv_set != 1) {
    fault(place + ".uv_set", fmt::format("expected 0 or 1, got {}", texture.uv_set));
  }
  for (std::size_t i = 0; i < texture.uv_from_mesh_uv.size(); ++i) {
    if (std::isfinite(texture.uv_from_mesh_uv[i])) continue;
    fault(item(place + ".uv_from_mesh_uv", i),
          fmt::format("expected a finite number, got {}", texture.uv_from_mesh_uv[i]));
  }
}

void MaterialCheck::check_material(const Material& material, const std::string& place) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  check_color(place + ".base_color", material.base_color, kMaxRadiance);
  check_enumerator(place + ".alpha_mode", material.alpha_mode, AlphaMode::blend);
  check_number(place + ".metallic", material.metallic, 0, 1);
  check_number(place + ".roughness", material.roughness, 0, 1);
  check_number(place + ".normal_scale", material.normal_scale, -1e6, 1e6);
  check_number(place + ".occlusion_strength", material.occlusion_strength, 0, 1);
  check_color(place + ".emissive", material.emissive, kMaxRadiance);
  check_number(place + ".alpha_cutoff", material.alpha_cutoff, 0, kEndless);
  check_texture(material.base_color_texture, place + ".base_color_texture");
  check_texture(material.metallic_roughness_texture, place + ".metallic_roughness_texture");
  check_texture(material.normal_texture, place + ".normal_texture");
  check_texture(material.occlusion_texture, place + ".occlusion_texture");
  check_texture(material.emissive_texture, place + ".emissive_texture");
  check_light_map(material.light_map, place + ".light_map");
  check_layers(material, place + ".layers");
  if (material.lobes != nullptr) check_lobes(*material.lobes, place + ".lobes.");
  check_relief(material, place + ".relief");
  if (material.mirror != nullptr) check_mirror(*material.mirror, material.alpha_mode, place + ".mirror");
}

// Luxels of both sides lie in the same places.
void MaterialCheck::check_light_map(const LightMap& light_map, const std::string& place) {
  check_texture(light_map.front, place + ".front");
  check_texture(light_map.back, place + ".back");
  check_number(place + ".intensity", light_map.intensity, 0, kMaxRadiance);
  if (!light_map.back.is_set()) return;
  if (!light_map.front.is_set()) {
    fault(place + ".front", "is not set, but the back is");
  } else if (light_map.back.uv_set != light_map.front.uv_set) {
    fault(place + ".back.uv_set",
          fmt::format("expected the front's, {}, got {}", light_map.front.uv_set, light_map.back.uv_set));
  }
}

void MaterialCheck::check_lobes(const MaterialLobes& lobes, const std::string& place) {
  for (const LobeFactor& factor : lobe_factors()) {
    const std::span<const float> values = factor.of(lobes);
    const std::string at = place + std::string(factor.field);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!factor.allows(values[i]))
        check_number(values.size() > 1 ? item(at, i) : at, values[i], factor.low, factor.high);
    }
  }
  const std::array<const Texture*, kLobeTextures> textures = textures_of(lobes);
  for (std::size_t i = 0; i < kLobeTextures; ++i)
    check_texture(*textures[i], place + std::string(lobe_textures()[i].field));
}

void MaterialCheck::check_mirror(const Mirror& mirror, AlphaMode alpha_mode, const std::string& place) {
  check_color(place + ".reflectance", mirror.reflectance, 1);
  if (mirror.ior) check_number(place + ".ior", *mirror.ior, 1, kMaxMirrorIor);
  check_number(place + ".roughness", mirror.roughness, 0, 1);
  if (mirror.waves.size() > kMaxWaves)
    fault(place + ".waves", fmt::format("{} waves are more than {}", mirror.waves.size(), kMaxWaves));
  for (std::size_t i = 0; i < mirror.waves.size(); ++i) {
    const Wave& wave = mirror.waves[i];
    const std::string at = item(place + ".waves", i);
    for (int k = 0; k < 3; ++k)
      check_number(at + ".direction_ws", wave.direction_ws[k], -kMaxCoordinate, kMaxCoordinate);
    if (wave.direction_ws == glm::dvec3(0)) fault(at + ".direction_ws", "is the zero vector");
    check_number(at + ".length", wave.length, kShortestWave, kMaxCoordinate);
    check_number(at + ".amplitude", wave.amplitude, 0, kMaxCoordinate);
    if (wave.speed) check_number(at + ".speed", *wave.speed, -1e6, 1e6);
    check_number(at + ".phase", wave.phase, -kMaxWavePhase, kMaxWavePhase);
  }
  if (!mirror.volume) return;
  check_color(place + ".volume.attenuation_color", mirror.volume->attenuation_color, 1);
  if (const double distance = mirror.volume->attenuation_distance; !std::isinf(distance) || distance < 0)
    check_number(place + ".volume.attenuation_distance", distance,
                 static_cast<float>(kLeastAttenuationDistance), std::numeric_limits<float>::max());
  if (!mirror.ior) fault(place + ".volume", "bends light by `ior`, which is not set");
  if (const std::string reason = find_volume_fault(mirror, alpha_mode); !reason.empty())
    fault(place + ".volume", reason);
}

void MaterialCheck::check_layers(const Material& material, const std::string& place) {
  if (material.layers.size() > kMaxSurfaceLayers)
    fault(place, fmt::format("{} layers are more than {}", material.layers.size(), kMaxSurfaceLayers));
  for (std::size_t i = 0; i < material.layers.size(); ++i) {
    const SurfaceLayer& layer = material.layers[i];
    const std::string at = item(place, i);
    check_texture(layer.texture, at + ".texture");
    check_layer_projector(layer, at + ".projector");
    check_color(at + ".color", layer.color, kMaxRadiance);
    check_number(at + ".opacity", layer.opacity, 0, 1);
    check_enumerator(at + ".blend", layer.blend, BlendMode::dot3);
  }
}

void MaterialCheck::check_relief(const Material& material, const std::string& place) {
  if (material.relief == nullptr) return;
  const Relief& relief = *material.relief;
  check_texture(relief.texture, place + ".texture");
  check_number(place + ".depth", relief.depth, 0, kMaxReliefDepth);
  check_enumerator(place + ".kind", relief.kind, ReliefKind::depth);
  if (material.alpha_mode == AlphaMode::blend)
    fault(place, "belongs to opaque surfaces and cut-outs; this material blends");
}

void MaterialCheck::check_layer_projector(const SurfaceLayer& layer, const std::string& place) {
  check_reference(place, layer.projector, scene_.lights.size(), "lights");
  if (layer.projector < 0 || static_cast<std::size_t>(layer.projector) >= scene_.lights.size()) return;
  const Light& light = scene_.lights[static_cast<std::size_t>(layer.projector)];
  if (layer.texture.is_set()) fault(place, "is set beside a texture: a layer shows one or the other");
  if (light.type != LightType::projector)
    fault(place, fmt::format("light {} is no projector", in_quotes(light.name)));
  if (light.slide_is_intensity)
    fault(place, fmt::format("light {} throws an intensity map, which is no colour", in_quotes(light.name)));
  if (std::none_of(scene_.nodes.begin(), scene_.nodes.end(),
                   [&](const Node& node) { return node.light == layer.projector; }))
    fault(place, fmt::format("light {} stands at no node", in_quotes(light.name)));
}

}  // namespace

void check_materials(const Scene& scene, FaultList& faults) { MaterialCheck(scene, faults).run(); }

}  // namespace laterna
