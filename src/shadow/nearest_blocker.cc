#include "shadow/nearest_blocker.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "raster/triangle_bins.h"

namespace laterna::shadow {

float nearest_blocker(const SurfaceSamples& s, std::size_t i) {
  const raster::RasterView::Ray& ray = s.ray;
  // The point is the homogeneous ray's first three coordinates over its fourth.
  const double h = ray.ray_0.w + ray.ray_x.w * s.x[i] + ray.ray_y.w * s.y[i] + ray.q_term.w * s.q[i];
  const glm::dvec3 position(s.x_ws[i], s.y_ws[i], s.z_ws[i]);
  const auto pixel_side = [&](const glm::dvec4& along, float dq) {
    const glm::dvec4 step = along + ray.q_term * static_cast<double>(dq);
    return glm::length(glm::dvec3(step) - position * step.w) / h;
  };
  const double pixel = pixel_side(ray.ray_x, s.dq_dx[i]) + pixel_side(ray.ray_y, s.dq_dy[i]);
  return 2 * s.position_error + static_cast<float>(pixel / raster::kSubpixels);
}

}  // namespace laterna::shadow
