// Environments of scenes: what is seen all around a point, drawn like any other picture.
#pragma once

#include "laterna/render.h"

namespace laterna {

struct EnvironmentProbe {
  glm::dvec3 position_ws{0};
  int face_size = 256;  ///< pixels, 1 … 8192: N of the chart
  double near = 0.05;   ///< metres: what is nearer to the point than this, along a face's axis, is not seen
};

/// The six faces of EnvironmentChart::cube about the point, R, G, B in linear light: six views of 90°, with the settings of
/// any picture but for its size and layers. Where nothing is, the scene's environment or background, else black.
/// Errors: bad_usage for settings that make no sense; cancelled.
Result<LayeredImage> render_environment(const Renderer& renderer, const EnvironmentProbe& probe,
                                        const RenderSettings& settings = {}, const Progress& progress = {});

}  // namespace laterna
