// How shadows are found, and what they look like. Equations, cost and failure cases of each technique: docs/shadows.md.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

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
  averaged_depths,  ///< the mean of kernel × kernel depths, compared once: wrong, kept to show why (row 101)
};
/// Which depth is compared: along the map's axis, or the length of the ray from the light (row 61).
enum class ShadowDepth : std::uint8_t { planar, radial };
/// What a variance map holds: moments of depth, or of two exponentials of it, which lets far less light bleed through.
enum class ShadowMoments : std::uint8_t { variance, exponential };
/// How the texels of a directional light's one map lie on the scene.
enum class ShadowWarp : std::uint8_t {
  none,                     ///< all of one size, on all that casts shadows, whatever the camera sees of it
  light_space_perspective,  ///< on what the camera sees, finer toward it
};
/// What holds the directions of a light that shines all round.
enum class ShadowLayout : std::uint8_t {
  cube,             ///< six maps, the faces of a cube
  dual_paraboloid,  ///< two, each as one paraboloid mirror shows half of the directions
};
enum class CasterFaces : std::uint8_t { both, back_only };

/// Largest ShadowSettings::blur.
inline constexpr double kMaxShadowBlur = 64;

/// A plane that ground shadows fall on: the points x with normal · x = distance, where normal is brought to length 1.
struct ShadowPlane {
  glm::dvec3 normal{0, 1, 0};  ///< of any length from 1e-12 on
  double distance = 0;         ///< metres from the origin, along the normal
  bool operator==(const ShadowPlane&) const = default;
};

/// How silhouettes are smoothed (row 36).
enum class SmoothKernel : std::uint8_t {
  eight_neighbours,  ///< the mean of the eight neighbours, without the texel itself, as Chen and Tung print it
  binomial,          ///< 1 2 1 across and down: tends to a Gaussian, and the middle counts most
};

// Limits of the settings below.
inline constexpr int kMaxShadowResolution = 16384;
inline constexpr int kLeastKernel = 2, kMostKernel = 9;
inline constexpr int kMostSmoothing = 64;
inline constexpr int kMostCascades = 8;

/// One light's shadows. The defaults need no tuning: bias follows from the receiver's plane and the texel's footprint.
/// A manual bias, constant, by slope or both, takes its place, and `refined` is then read as `bilinear`.
struct ShadowSettings {
  std::optional<ShadowTechnique> technique;  ///< unset: the picture's

  // Shadow maps.
  /// Texels per side of a map (per cube face), to kMaxShadowResolution; 0: 2048, point lights 1024, silhouettes 512.
  int resolution = 0;
  ShadowFilter filter = ShadowFilter::refined;
  int kernel =
      3;  ///< percentage_closer and averaged_depths: kernel × kernel nearest taps, kLeastKernel…kMostKernel
  std::optional<double> constant_bias;  ///< metres toward the light; overrides the automatic bias
  std::optional<double> slope_bias;     ///< texel footprints per unit of depth slope; overrides likewise
  CasterFaces caster_faces = CasterFaces::both;
  bool outside_is_lit = true;  ///< beyond the map's sides or far plane
  ShadowDepth depth = ShadowDepth::planar;
  ShadowLayout layout = ShadowLayout::cube;  ///< technique map, lights that shine all round
  /// Metres that a caster must stand before a surface to darken it wholly; less darkens it by a smooth step (row 87).
  /// Where set, `refined` is read as `bilinear`.
  double soft_edge = 0;

  // Variance maps.
  ShadowMoments moments = ShadowMoments::exponential;
  /// Cuts off what bleeds through, 0…1: of α, what is below is dark, and the rest is stretched to 0…1.
  float bleeding_reduction = 0.2F;
  float blur = 2;  ///< texels that the moments are averaged over to each side, 0…kMaxShadowBlur

  // Ground shadows.
  std::vector<ShadowPlane> planes;  ///< empty: the scene's floor, its lowest large horizontal one

  // Projected silhouettes.
  int smooth = 0;  ///< passes, 0…kMostSmoothing
  SmoothKernel smooth_kernel = SmoothKernel::eight_neighbours;
  bool orders_objects = true;   ///< false: objects between a light and a caster are shaded by it too (row 31)
  bool culls_occluders = true;  ///< false: all silhouettes are drawn; the picture is the same (row 47)

  // Warped maps and cascades.
  ShadowWarp warp = ShadowWarp::none;  ///< technique map, directional lights that are fitted to the scene
  int cascades = 4;           ///< maps, one behind the other along the camera's view, 1…kMostCascades
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
