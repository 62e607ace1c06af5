#include "scene/lobe_factors.h"

#include <algorithm>
#include <cmath>

namespace laterna {
namespace {

using P = AnimatedProperty;
using Lobes = MaterialLobes;

constexpr float kEndlessDistance = std::numeric_limits<float>::infinity();
// Shorter than any light's wave; its inverse is finite in single precision.
constexpr float kLeastDistance = 1e-9F;
constexpr float kMaxThickness = 1e9F;
// Radians; what cosine() takes.
constexpr float kMaxRotation = 1e5F;

constexpr std::string_view kClearcoat = "KHR_materials_clearcoat", kSheen = "KHR_materials_sheen",
                           kSpecular = "KHR_materials_specular", kAnisotropy = "KHR_materials_anisotropy",
                           kIridescence = "KHR_materials_iridescence",
                           kTransmission = "KHR_materials_transmission", kVolume = "KHR_materials_volume";

constexpr LobeFactor kFactors[] = {
    {P::ior, "KHR_materials_ior", "ior", "ior", 1, 1, kMaxIor, [](const Lobes& l) { return &l.ior; }},
    {P::specular, kSpecular, "specularFactor", "specular.factor", 1, 0, 1,
     [](const Lobes& l) { return &l.specular.factor; }},
    {P::specular_color, kSpecular, "specularColorFactor", "specular.color", 3, 0,
     static_cast<float>(kMaxRadiance), [](const Lobes& l) -> const float* { return &l.specular.color.x; }},
    {P::clearcoat, kClearcoat, "clearcoatFactor", "clearcoat.factor", 1, 0, 1,
     [](const Lobes& l) { return &l.clearcoat.factor; }},
    {P::clearcoat_roughness, kClearcoat, "clearcoatRoughnessFactor", "clearcoat.roughness", 1, 0, 1,
     [](const Lobes& l) { return &l.clearcoat.roughness; }},
    {P::clearcoat_normal_scale, kClearcoat, "clearcoatNormalTexture/scale", "clearcoat.normal_scale", 1,
     -1e6F, 1e6F, [](const Lobes& l) { return &l.clearcoat.normal_scale; }},
    {P::sheen_color, kSheen, "sheenColorFactor", "sheen.color", 3, 0, 1,
     [](const Lobes& l) -> const float* { return &l.sheen.color.x; }},
    {P::sheen_roughness, kSheen, "sheenRoughnessFactor", "sheen.roughness", 1, 0, 1,
     [](const Lobes& l) { return &l.sheen.roughness; }},
    {P::anisotropy_strength, kAnisotropy, "anisotropyStrength", "anisotropy.strength", 1, 0, 1,
     [](const Lobes& l) { return &l.anisotropy.strength; }},
    {P::anisotropy_rotation, kAnisotropy, "anisotropyRotation", "anisotropy.rotation", 1, -kMaxRotation,
     kMaxRotation, [](const Lobes& l) { return &l.anisotropy.rotation; }},
    {P::iridescence, kIridescence, "iridescenceFactor", "iridescence.factor", 1, 0, 1,
     [](const Lobes& l) { return &l.iridescence.factor; }},
    {P::iridescence_ior, kIridescence, "iridescenceIor", "iridescence.ior", 1, 1, kMaxIor,
     [](const Lobes& l) { return &l.iridescence.ior; }},
    {P::iridescence_thickness_minimum, kIridescence, "iridescenceThicknessMinimum",
     "iridescence.thickness_minimum", 1, 0, kMaxFilmThickness,
     [](const Lobes& l) { return &l.iridescence.thickness_minimum; }},
    {P::iridescence_thickness_maximum, kIridescence, "iridescenceThicknessMaximum",
     "iridescence.thickness_maximum", 1, 0, kMaxFilmThickness,
     [](const Lobes& l) { return &l.iridescence.thickness_maximum; }},
    {P::transmission, kTransmission, "transmissionFactor", "transmission.factor", 1, 0, 1,
     [](const Lobes& l) { return &l.transmission.factor; }},
    {P::thickness, kVolume, "thicknessFactor", "volume.thickness", 1, 0, kMaxThickness,
     [](const Lobes& l) { return &l.volume.thickness; }},
    {P::attenuation_distance, kVolume, "attenuationDistance", "volume.attenuation_distance", 1,
     kLeastDistance, kEndlessDistance, [](const Lobes& l) { return &l.volume.attenuation_distance; }},
    {P::attenuation_color, kVolume, "attenuationColor", "volume.attenuation_color", 3, 0, 1,
     [](const Lobes& l) -> const float* { return &l.volume.attenuation_color.x; }},
};

constexpr LobeTexture kTextures[kLobeTextures] = {
    {kSpecular, "specularTexture", "specular.texture"},
    {kSpecular, "specularColorTexture", "specular.color_texture"},
    {kClearcoat, "clearcoatTexture", "clearcoat.texture"},
    {kClearcoat, "clearcoatRoughnessTexture", "clearcoat.roughness_texture"},
    {kClearcoat, "clearcoatNormalTexture", "clearcoat.normal_texture"},
    {kSheen, "sheenColorTexture", "sheen.color_texture"},
    {kSheen, "sheenRoughnessTexture", "sheen.roughness_texture"},
    {kAnisotropy, "anisotropyTexture", "anisotropy.texture"},
    {kIridescence, "iridescenceTexture", "iridescence.texture"},
    {kIridescence, "iridescenceThicknessTexture", "iridescence.thickness_texture"},
    {kTransmission, "transmissionTexture", "transmission.texture"},
    {kVolume, "thicknessTexture", "volume.thickness_texture"},
};

template <class Of, class L>
std::array<Of*, kLobeTextures> list_textures(L& l) {
  return {&l.specular.texture,         &l.specular.color_texture,
          &l.clearcoat.texture,        &l.clearcoat.roughness_texture,
          &l.clearcoat.normal_texture, &l.sheen.color_texture,
          &l.sheen.roughness_texture,  &l.anisotropy.texture,
          &l.iridescence.texture,      &l.iridescence.thickness_texture,
          &l.transmission.texture,     &l.volume.thickness_texture};
}

// The material's own, which nothing else has.
MaterialLobes& own_lobes(Material& material) {
  auto own = material.lobes == nullptr ? std::make_shared<MaterialLobes>()
                                       : std::make_shared<MaterialLobes>(*material.lobes);
  MaterialLobes& lobes = *own;
  material.lobes = std::move(own);
  return lobes;
}

}  // namespace

bool LobeFactor::allows(double value) const {
  if (property == P::ior && value == 0) return true;
  return value >= static_cast<double>(low) && value <= static_cast<double>(high);
}

float LobeFactor::nearest(double value) const {
  if (allows(value)) return static_cast<float>(value);
  return static_cast<float>(std::clamp(value, static_cast<double>(low), static_cast<double>(high)));
}

std::span<const LobeFactor> lobe_factors() { return kFactors; }

const LobeFactor* find_lobe_factor(AnimatedProperty property) {
  const auto* found = std::find_if(std::begin(kFactors), std::end(kFactors),
                                   [&](const LobeFactor& factor) { return factor.property == property; });
  return found == std::end(kFactors) ? nullptr : found;
}

std::span<const LobeTexture, kLobeTextures> lobe_textures() { return kTextures; }

void set_lobe_factor(Material& material, const LobeFactor& factor, std::span<const double> values) {
  const std::span<float> numbers = factor.of(own_lobes(material));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = factor.nearest(values[i]);
}

Texture& lobe_texture_of(Material& material, std::size_t number) {
  return *textures_of(own_lobes(material))[number];
}

std::array<Texture*, kLobeTextures> textures_of(MaterialLobes& lobes) {
  return list_textures<Texture>(lobes);
}
std::array<const Texture*, kLobeTextures> textures_of(const MaterialLobes& lobes) {
  return list_textures<const Texture>(lobes);
}

std::vector<std::string_view> shown_lobes(const MaterialLobes& lobes) {
  const bool is_usual = lobes.ior == 1.5F && lobes.specular.factor == 1 &&
                        lobes.specular.color == glm::vec3(1) && !lobes.specular.texture.is_set() &&
                        !lobes.specular.color_texture.is_set();
  const std::pair<std::string_view, bool> all[] = {
      {"specular", !is_usual},
      {"clearcoat", lobes.clearcoat.factor > 0},
      {"sheen", lobes.sheen.color != glm::vec3(0)},
      {"anisotropy", lobes.anisotropy.strength > 0},
      {"iridescence", lobes.iridescence.factor > 0},
      {"transmission", lobes.transmission.factor > 0},
      {"volume", lobes.transmission.factor > 0 && lobes.volume.thickness > 0}};
  std::vector<std::string_view> names;
  for (const auto& [name, shows] : all) {
    if (shows) names.push_back(name);
  }
  return names;
}

}  // namespace laterna
