// The pixels on which a light falls, where they lie in its shadow map, and which of them are truly lit.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "measure/picture_surface.h"
#include "measure/shadow_rays.h"

namespace laterna::measure {

/// α of each pixel.
using Mask = std::vector<float>;
inline bool is_lit(float alpha) { return alpha >= 0.5F; }

struct LitPixel {
  int face = -1;                ///< of the light's maps; −1: the light does not fall on this pixel
  bool is_turned_away = false;  ///< which then is why
  glm::vec2 texel{0};           ///< in that map; beyond its sides too, where the light is not held to them
  float depth = 0;              ///< metres along the map's axis
  float footprint = 0;          ///< of a texel at that depth, metres
  float slope = 0;              ///< metres of depth from one texel to the next along the surface, at most
};

class LitPixels {
 public:
  /// `renderer`: in which the light is on. All references must outlive this.
  static Result<LitPixels> find(const Renderer& renderer, const PictureSurface& surface,
                                const ShadowRays& rays, const std::string& light);

  [[nodiscard]] const PictureSurface& surface() const { return *surface_; }
  [[nodiscard]] const LitPixel& operator[](std::size_t i) const { return pixels_[i]; }
  [[nodiscard]] bool is_counted(std::size_t i) const { return pixels_[i].face >= 0; }
  [[nodiscard]] std::size_t size() const { return pixels_.size(); }

  /// Where the light's map sees a point.
  [[nodiscard]] glm::dvec2 texel_of(int face, const glm::dvec3& point_ws) const;
  /// The point of the pixel's plane that the light sees some texels beside it.
  [[nodiscard]] glm::dvec3 beside(std::size_t i, const glm::dvec2& texels) const;
  [[nodiscard]] bool is_blocked(const glm::dvec3& point_ws, double near,
                                double far = std::numeric_limits<double>::infinity()) const {
    return rays_->is_blocked(*light_, point_ws, near, far);
  }

 private:
  struct Map {
    View view;
    glm::dmat4 image_from_world, world_from_image;
    glm::dvec2 size;  // texels
  };
  LitPixels(const PictureSurface& surface, const ShadowRays& rays, const frame::PlacedLight& light)
      : surface_(&surface), rays_(&rays), light_(&light) {}
  [[nodiscard]] bool reaches(const glm::dvec3& point_ws) const;
  [[nodiscard]] LitPixel locate(const glm::dvec3& point_ws) const;

  const PictureSurface* surface_;
  const ShadowRays* rays_;
  const frame::PlacedLight* light_;
  std::vector<Map> maps_;
  std::vector<LitPixel> pixels_;
};

}  // namespace laterna::measure
