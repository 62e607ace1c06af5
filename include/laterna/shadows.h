// How shadows are found, and what they look like. Equations, cost and failure cases of each technique: docs/shadows.md.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

namespace laterna {

/// list_techniques() describes those that can be asked for.
enum class ShadowTechnique : std::uint8_t {
  none,
  ground,
  silhouette,
  map,
  pcss,
  variance,
  cascades,
  volume,
  exact,
  raytraced,
};
struct TechniqueDescription {
  ShadowTechnique technique;
  std::string_view name;  ///< on the command line and in rigs
  std::string_view meaning;
};
std::span<const TechniqueDescription> list_techniques();

/// How a shadow map is read.
enum class ShadowFilter : std::uint8_t {
  refined,   ///< near edges and contacts, the triangles that the texels saw are tested themselves: shadow
             ///< edges are as sharp as the picture, antialiased, and surfaces never shade themselves
  nearest,   ///< one texel: a staircase
  bilinear,  ///< four texels, weighted
  percentage_closer,  ///< kernel × kernel nearest texels, all of one weight
};
/// How the texels of a directional light's one map lie on the scene.
enum class ShadowWarp : std::uint8_t {
  none,                     ///< all of one size, on all that casts shadows, whatever the camera sees of it
  light_space_perspective,  ///< on what the camera sees, finer toward it
};
enum class CasterFaces : std::uint8_t { both, back_only };

/// One light's shadows. The defaults need no tuning: bias follows from the receiver's plane and the texel's footprint.
/// A manual bias, constant, by slope or both, takes its place, and `refined` is then read as `bilinear`.
struct ShadowSettings {
  std::optional<ShadowTechnique> technique;  ///< unset: the picture's

  // Shadow maps.
  int resolution = 0;  ///< texels per side of a map (per cube face); 0: 2048, point lights 1024
  ShadowFilter filter = ShadowFilter::refined;
  int kernel = 3;                       ///< percentage_closer: kernel × kernel nearest taps, 2…9
  std::optional<double> constant_bias;  ///< metres toward the light; overrides the automatic bias
  std::optional<double> slope_bias;     ///< texel footprints per unit of depth slope; overrides likewise
  CasterFaces caster_faces = CasterFaces::both;
  bool outside_is_lit = true;          ///< beyond the map's sides or far plane
  ShadowWarp warp = ShadowWarp::none;  ///< technique map, directional lights that are fitted to the scene

  // Cascades.
  int cascades = 4;           ///< maps, one behind the other along the camera's view, 1…8
  double split_lambda = 0.8;  ///< where they meet: 0 at equal distances, 1 at equal ratios of distances
  double cascade_distance =
      0;  ///< metres from the camera to where the last one ends; 0: as far as there is anything

  // How dark: physical unless set. With α the fraction that arrives, ambient + (1 − ambient) α takes its place (row 91,
  // GL_ARB_shadow_ambient), and of each colour 1 − opacity (1 − color) (1 − that) is seen (row 34).
  glm::vec3 color{0};  ///< of shadows, linear, 0…1
  float opacity = 1;   ///< 0…1
  float ambient = 0;   ///< what arrives where nothing does, 0…1
  /// Of the light that does not arrive this much is still reflected diffusely, without highlight, so that curved surfaces
  /// in shadow do not look flat (row 90). 0…1.
  float fill = 0;

  bool operator==(const ShadowSettings&) const = default;
};

}  // namespace laterna
