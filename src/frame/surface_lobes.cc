#include "frame/surface_lobes.h"

#include <algorithm>
#include <span>

#include "scene/lobe_factors.h"

namespace laterna::frame {

TextureBinding bind(const Texture& texture, image::MipUse use, const TextureLibrary& library) {
  return {library.find(texture.picture, use), texture.sampler, texture.uv_set, texture.uv_from_mesh_uv};
}

// In the extensions' own words: colours are sRGB, all else is linear.
constexpr auto kColor = image::MipUse::colour, kData = image::MipUse::data;
const std::array<image::MipUse, kLobeTextures> kLobeTextureUses = {kData, kColor, kData, kData, kData, kColor,
                                                                   kData, kData,  kData, kData, kData, kData};

std::shared_ptr<const SurfaceLobes> bind_lobes(const MaterialLobes& lobes, const TextureLibrary& library) {
  if (shown_lobes(lobes).empty()) return nullptr;
  auto bound = std::make_shared<SurfaceLobes>();
  bound->values = lobes;
  TextureBinding* const bindings[kLobeTextures] = {&bound->specular,         &bound->specular_color,
                                                   &bound->clearcoat,        &bound->clearcoat_roughness,
                                                   &bound->clearcoat_normal, &bound->sheen_color,
                                                   &bound->sheen_roughness,  &bound->anisotropy,
                                                   &bound->iridescence,      &bound->iridescence_thickness,
                                                   &bound->transmission,     &bound->thickness};
  const std::array<const Texture*, kLobeTextures> textures = textures_of(lobes);
  for (std::size_t i = 0; i < kLobeTextures; ++i)
    *bindings[i] = bind(*textures[i], kLobeTextureUses[i], library);
  bound->has_clearcoat = lobes.clearcoat.factor > 0;
  bound->has_sheen = lobes.sheen.color != glm::vec3(0);
  bound->has_anisotropy = lobes.anisotropy.strength > 0;
  bound->has_iridescence = lobes.iridescence.factor > 0;
  bound->has_transmission = lobes.transmission.factor > 0;
  return bound;
}

bool may_show(const Scene& scene, int material, AnimatedProperty factor) {
  const auto& lobes = scene.materials[static_cast<std::size_t>(material)].lobes;
  const std::span<const float> values =
      lobes == nullptr ? std::span<const float>() : find_lobe_factor(factor)->of(*lobes);
  if (std::any_of(values.begin(), values.end(), [](float value) { return value > 0; })) return true;
  return std::any_of(scene.clips.begin(), scene.clips.end(), [&](const Clip& clip) {
    return std::any_of(clip.channels.begin(), clip.channels.end(), [&](const ClipChannel& channel) {
      return channel.property == factor && channel.target == material;
    });
  });
}

bool may_show(const Scene& scene, AnimatedProperty factor) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (may_show(scene, static_cast<int>(i), factor)) return true;
  }
  return false;
}

}  // namespace laterna::frame
