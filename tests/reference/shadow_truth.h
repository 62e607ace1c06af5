// How wrong a shadow is: a technique's mask against rays, measured in texels of the light's shadow map.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "laterna/render.h"

namespace laterna::reference {

/// One point of a surface as a light sees it.
struct ShadowSample {
  /// Number of the object; −1: not counted, because there is nothing, or the light does not fall on it.
  int object = -1;
  int face = 0;            ///< of the light's maps
  glm::dvec2 texel{0};     ///< in that map
  double depth = 0;        ///< metres along the map's axis
  double footprint = 0;    ///< of a texel at that depth, metres
  double depth_slope = 0;  ///< change of depth along the surface from one texel to the next, at most
  glm::vec3 position_ws{0}, normal_ws{0};
};

/// What one map of a light covers, and how finely.
struct ShadowMapFrame {
  View view;
  int width = 0, height = 0;
};
std::vector<ShadowMapFrame> shadow_map_frames(const Renderer& renderer, const std::string& light);

/// A technique's picture and a finer one of the truth: `fineness` × `fineness` truth samples per pixel, an odd number,
/// so that the middle one is the pixel's own.
struct ShadowMasks {
  int width = 0, height = 0;
  int fineness = 1;
  std::vector<bool> is_lit;           ///< per pixel: α ≥ 0.5
  std::vector<bool> is_truly_lit;     ///< per truth sample
  std::vector<ShadowSample> samples;  ///< per truth sample
  std::vector<ShadowMapFrame> maps;
  /// Whether a ray from a point to the light meets anything beyond `near` metres.
  std::function<bool(const glm::dvec3& position_ws, double near)> is_blocked;
};

/// The scene with each triangle's own normal, so that a normal layer tells which triangles face the light.
Scene with_flat_normals(Scene scene);

/// Draws both pictures: with the settings' technique, and ray traced. Pixels whose triangle faces the light count.
ShadowMasks draw_shadow_masks(const Renderer& renderer, const View& camera, const RenderSettings& settings,
                              const std::string& light, int fineness);

struct ShadowErrors {
  int pixels = 0;  ///< counted: those on which the light falls
  int false_dark = 0, false_lit = 0;
  /// Of these, those farther than kFarTexels from every true boundary: acne and leaks.
  int far_false_dark = 0, far_false_lit = 0;
  /// Largest distance of a false pixel from the nearest true boundary, in texels.
  double farthest_false_dark = 0, farthest_false_lit = 0;
  /// Of false lit pixels whose shadow is thrown from between kCoincidentTexels and kContactTexels away: the largest
  /// distance from where it begins.
  double contact_gap = 0;
  int edge_pixels = 0;      ///< pixels at a true boundary, and all false ones
  int edge_mismatches = 0;  ///< of these, false by kEdgeTexels or more

  [[nodiscard]] double wrong_share() const { return static_cast<double>(false_dark + false_lit) / pixels; }
  [[nodiscard]] double edge_share() const { return 1 - static_cast<double>(edge_mismatches) / edge_pixels; }
};
inline constexpr double kFarTexels = 2, kEdgeTexels = 1.5, kContactTexels = 8, kCoincidentTexels = 0.5;

/// Distance is that in the map's texels, along the receiver, to the nearest place where a true shadow begins. Such places
/// are found in the picture: halfway between neighbouring truth samples of one object of which one is lit, where the
/// pixel's own surface, going on as it is, may reach. And where the picture does not show them, because they lie beyond
/// its rim or behind something, by rays from the pixel's plane, up to kFarTexels about it; what stands within two texels'
/// width of that plane does not count for those.
ShadowErrors find_shadow_errors(const ShadowMasks& masks);

/// For messages.
std::string to_string(const ShadowErrors& errors);

}  // namespace laterna::reference
