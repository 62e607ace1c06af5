// How right a shadow is: every technique held against ray-traced truth, on any scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "laterna/render.h"

namespace laterna {

struct AccuracySettings {
  /// Size, shading and so on. `shadows` and `layers` count for nothing; one sample per pixel is looked at.
  RenderSettings picture;
  std::vector<ShadowTechnique> techniques;  ///< empty: all of list_techniques()
  std::vector<std::string> lights;          ///< empty: all that are on
  int resolution = 0;                       ///< of shadow maps; 0: each light's own
  /// Masks are compared on a grid this many times finer than the picture, 1…8. Edges' distances are still in pixels of
  /// the picture.
  int subpixels = 1;
  int frames = 3;  ///< of which `ms` is the median, after one that does not count
  bool keep_verdicts = false;
};

/// What became of a pixel.
enum class ShadowVerdict : std::uint8_t {
  not_counted,  ///< nothing is there, or the light does not fall on it
  lit,
  dark,
  false_lit,
  false_dark,
  acne,  ///< false dark, far from every true edge
};

/// One technique's shadows of one light. Shares are of `pixels`.
struct ShadowAccuracy {
  ShadowTechnique technique = ShadowTechnique::none;
  std::string light;
  std::size_t pixels = 0;  ///< whose triangle faces the light, within its cone, frame and range
  double false_lit = 0;    ///< α ≥ ½ where the ray to the light is blocked
  double false_dark = 0;   ///< and the reverse; acne is a part of it
  double acne = 0;         ///< false dark farther than 2 texels of the light's shadow map from any true edge
  double gap_texels = 0;   ///< the largest stretch of false light that begins where caster and receiver touch
  std::size_t edge_pixels = 0;  ///< places where one of the two masks has an edge
  /// From each such place to the other mask's nearest edge, in pixels, at most kFarthestEdge; 0 without edges.
  double edge_px_median = 0, edge_px_p99 = 0, edge_px_mean = 0;
  double mean_error = 0;  ///< |α − truth|
  double ms = 0;  ///< of a frame, for these shadows: preparing, drawing maps, and asking; summed over threads
  double mb = 0;  ///< 2^20 bytes, of maps and the like
  std::vector<ShadowVerdict> verdicts;  ///< of each pixel of the grid, where they are to be kept
};
inline constexpr double kFarTexels = 2;      ///< acne is farther than this from true edges
inline constexpr double kFarthestEdge = 32;  ///< pixels: an edge without its like counts as this far off

/// A technique that cannot serve a light.
struct SkippedAccuracy {
  ShadowTechnique technique = ShadowTechnique::none;
  std::string light, reason;
};

struct AccuracyReport {
  int width = 0, height = 0;             ///< of the grid
  std::vector<float> grey;               ///< of the grid: the scene in light from the eye, linear
  std::vector<ShadowAccuracy> measured;  ///< by light, then technique
  std::vector<SkippedAccuracy> skipped;
};

/// Draws the scene light by light with each technique and with `raytraced`, which is the truth. Texels are those of the
/// shadow map that the light has or would have, for every technique.
/// Error: no light of a name that was asked for, no light at all, settings that make no picture.
Result<AccuracyReport> measure_accuracy(const Renderer& renderer, const View& view,
                                        const AccuracySettings& settings, const Progress& progress = {});

/// What `ms` is made of: what a frame spent on shadows.
double shadow_cost_ms(const RenderStatistics& statistics);

/// The verdicts as a picture: the scene in grey, true shadows darker, what is not counted darkest; false light yellow,
/// false shadow blue, acne red; a legend below tells this. A block for each light under its name, in it a picture for each
/// technique, at most five side by side, in the report's order, under the technique's name and how much is wrong; what was
/// skipped is black. Where all pictures together are wider or higher than 8192 pixels they are scaled down, and errors stay
/// visible.
/// Error: the report has no verdicts.
Result<LayeredImage> accuracy_picture(const AccuracyReport& report);

/// Lights by a fixed rule, for scenes that have none or to measure all scenes alike: "auto sun", 45° high; "auto spot"
/// and "auto point", within the bounds of what is to be seen. Other lights are turned off.
/// Error: the scene has no surface.
Result<Scene> with_standard_lights(Scene scene);

}  // namespace laterna
