// What a material may have beyond metallic-roughness: glTF's KHR_materials_* extensions, by their names and meanings.
// docs/materials.md
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <limits>
#include <string_view>
#include <vector>

#include "laterna/scene.h"

namespace laterna {

/// KHR_materials_specular: how strongly, and in which colour, what is no metal mirrors. F₀ = min(F₀(ior) color, 1) factor.
struct SpecularLobe {
  float factor = 1;       ///< 0 … 1
  Texture texture;        ///< linear, A
  glm::vec3 color{1};     ///< linear, 0 … kMaxRadiance
  Texture color_texture;  ///< sRGB
};

/// KHR_materials_clearcoat: a clear lacquer (index of refraction 1.5) over everything else.
struct ClearcoatLobe {
  float factor = 0;           ///< 0 … 1
  Texture texture;            ///< linear, R
  float roughness = 0;        ///< 0 … 1
  Texture roughness_texture;  ///< linear, G
  Texture normal_texture;  ///< linear, tangent space; unset: the surface's normals without their normal map
  float normal_scale = 1;
};

/// KHR_materials_sheen: fibres that stand up from cloth, over all but the coat.
struct SheenLobe {
  glm::vec3 color{0};         ///< linear, 0 … 1
  Texture color_texture;      ///< sRGB
  float roughness = 0;        ///< 0 … 1
  Texture roughness_texture;  ///< linear, A
};

/// KHR_materials_anisotropy: highlights drawn out along a direction of the surface.
struct AnisotropyLobe {
  float strength = 0;  ///< 0 … 1
  float rotation = 0;  ///< radians, from the tangent toward the bitangent
  Texture texture;     ///< linear; direction in RG as −1 … 1, strength in B
};

/// KHR_materials_iridescence: a thin film whose colour changes with the angle.
struct IridescenceLobe {
  float factor = 0;               ///< 0 … 1
  Texture texture;                ///< linear, R
  float ior = 1.3F;               ///< of the film, 1 … kMaxIor
  float thickness_minimum = 100;  ///< nanometres, 0 … kMaxFilmThickness: where `thickness_texture` is 0
  float thickness_maximum = 400;  ///< nanometres: where it is 1, and where there is none
  Texture thickness_texture;      ///< linear, G
};

/// KHR_materials_transmission: light that goes through what is no metal, in place of what it would scatter back.
struct TransmissionLobe {
  float factor = 0;  ///< 0 … 1
  Texture texture;   ///< linear, R
};

/// KHR_materials_volume: what lies beneath a transmissive surface. Without thickness it is a pane and bends nothing.
struct VolumeLobe {
  float thickness = 0;        ///< of the mesh's own units, not negative
  Texture thickness_texture;  ///< linear, G
  /// Metres in which white light turns to `attenuation_color`; above 0.
  float attenuation_distance = std::numeric_limits<float>::infinity();
  glm::vec3 attenuation_color{1};  ///< linear, 0 … 1
};

/// Lobes of a material's reflection. Shading model `pbr` alone shows them. As made, they change nothing.
struct MaterialLobes {
  /// KHR_materials_ior: 1 … kMaxIor, or 0: mirrors everything, which leaves it to `specular` what that comes to.
  float ior = 1.5F;
  SpecularLobe specular;
  ClearcoatLobe clearcoat;
  SheenLobe sheen;
  AnisotropyLobe anisotropy;
  IridescenceLobe iridescence;
  TransmissionLobe transmission;
  VolumeLobe volume;
};

inline constexpr float kMaxIor = 100;
inline constexpr float kMaxFilmThickness = 1e6F;  ///< nanometres; films show no colour long before

inline constexpr std::size_t kLobeTextures = 12;
/// Its textures in the order in which they are declared: ClipChannel::texture counts on from the material's own five.
std::array<Texture*, kLobeTextures> textures_of(MaterialLobes& lobes);
std::array<const Texture*, kLobeTextures> textures_of(const MaterialLobes& lobes);

/// Those that change anything, whatever their textures hold: "specular" (and ior), "clearcoat", "sheen", "anisotropy",
/// "iridescence", "transmission", "volume".
std::vector<std::string_view> shown_lobes(const MaterialLobes& lobes);

}  // namespace laterna
