#include "shade/pixel_density.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace laterna::shade {

std::optional<PixelDensity> PixelDensity::of(const frame::PlacedLight& placed) {
  const Light& light = *placed.light;
  if (light.type != LightType::projector) return std::nullopt;
  PixelDensity density;
  density.width_ = light.panel_width;
  density.height_ = light.panel_height;
  if (light.panel_width == 0) {
    if (placed.slide == nullptr) return std::nullopt;
    density.width_ = placed.slide->width();
    density.height_ = placed.slide->height();
  }
  const glm::dmat4 rows = glm::transpose(placed.view.image_from_world());
  density.s_row_ = rows[0];
  density.t_row_ = rows[1];
  density.w_row_ = rows[3];
  density.lens_ = placed.lens;
  density.position_ws_ = placed.pose.position_ws;
  density.forward_ws_ = placed.pose.forward_ws();
  density.is_parallel_ = placed.view.projection.is_orthographic;
  // As the shading has it: parallel light comes from the lens, or from where its frustum begins behind it.
  density.nearest_ = density.is_parallel_ ? std::min(placed.view.projection.near, 0.0) : 0.0;
  return density;
}

float PixelDensity::at(const glm::dvec3& point_ws, const glm::dvec3& normal_ws) const {
  const glm::dvec3 from_light = point_ws - position_ws_;
  if (!(glm::dot(from_light, forward_ws_) > nearest_)) return 0;
  if (!(glm::dot(is_parallel_ ? forward_ws_ : from_light, normal_ws) < 0)) return 0;
  const glm::dvec4 point(point_ws, 1);
  const double w = glm::dot(w_row_, point);
  const glm::dvec2 image(glm::dot(s_row_, point) / w, glm::dot(t_row_, point) / w);
  const std::optional<glm::dvec2> slide = lens_ ? lens_->slide_from_beam(image) : image;
  if (!slide || !(slide->x >= 0 && slide->x <= 1 && slide->y >= 0 && slide->y <= 1)) return 0;
  // d(s, t)/dP of the quotients along the surface.
  const auto along_surface = [&](const glm::dvec4& row, double value) {
    const glm::dvec3 gradient = glm::dvec3(row - value * w_row_) / w;
    return gradient - normal_ws * glm::dot(gradient, normal_ws);
  };
  const glm::dvec3 by_s = along_surface(s_row_, image.x);
  const glm::dvec3 by_t = along_surface(t_row_, image.y);
  const glm::dmat2 bend = lens_ ? lens_->slide_by_beam(image) : glm::dmat2(1.0);
  const glm::dvec3 across = (bend[0].x * by_s + bend[1].x * by_t) * width_;
  const glm::dvec3 down = (bend[0].y * by_s + bend[1].y * by_t) * height_;
  // Eigenvalues of J Jᵀ; their product is its determinant, which keeps the smaller one's digits.
  const double a = glm::dot(across, across);
  const double b = glm::dot(across, down);
  const double c = glm::dot(down, down);
  const double largest = (a + c) / 2 + std::sqrt((a - c) * (a - c) / 4 + b * b);
  const double determinant = std::max(a * c - b * b, 0.0);
  return largest > 0 ? static_cast<float>(std::sqrt(determinant / largest)) : 0.0F;
}

}  // namespace laterna::shade
