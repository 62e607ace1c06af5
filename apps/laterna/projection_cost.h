// What projecting a slide costs beside texturing the same surfaces (Segal et al. 1992, section 5: the same).
#pragma once

#include "frame_costs.h"

namespace laterna::app {

struct ProjectionCost {
  struct Rate {
    double ms = 0;          ///< a frame, median
    double mtri_per_s = 0;  ///< triangles considered
    double mpix_per_s = 0;  ///< of the whole picture
  };
  Rate textured, projected;
  [[nodiscard]] double ratio() const { return projected.ms / textured.ms; }
};
/// The subject's scene twice, in the papers' model, one picture look-up per pixel: each surface with a texture of its own,
/// or all of them under a projector that stands where the camera is, without shadows.
Result<ProjectionCost> measure_projection(const Subject& subject, const FrameSeries& series);

}  // namespace laterna::app
