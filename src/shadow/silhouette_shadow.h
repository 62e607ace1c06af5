// Projected silhouettes: Chen and Tung, Real-time shadow rendering using projective texture.
#pragma once

#include <memory>
#include <vector>

#include "light/silhouette_plan.h"
#include "shadow/shadow_technique.h"
#include "shadow/silhouette_texture.h"

namespace laterna::shadow {

/// Each receiver is darkened by the silhouettes of the objects that may shade it, multiplied. Silhouettes hold no depth:
/// objects are told apart by their distance from the light as a whole, and no object shades itself.
class SilhouetteShadow final : public ShadowTechnique {
 public:
  /// The plan must outlive this, and so must all that `painter` knows.
  SilhouetteShadow(const light::PlannedLight& planned, const frame::Frame& frame,
                   const raster::RasterView::Ray& ray, std::unique_ptr<SilhouettePainter> painter);

  /// Draws the silhouettes that are needed first.
  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;

  [[nodiscard]] std::size_t silhouette_count() const { return textures_.size(); }
  /// Draws one before it is asked for. May be called from several threads at once.
  void draw(std::size_t silhouette) const { textures_[silhouette]->require(*painter_, settings_); }
  [[nodiscard]] DrawnForShadows drawn() const override;

 private:
  struct Batch;
  [[nodiscard]] const SilhouetteTexture* texture_towards(std::size_t occluder, const glm::dvec3& point_ws,
                                                         double& drawing_ms) const;
  void look_up(const light::SilhouetteLookup& lookup, const Batch& batch, std::uint32_t receiver,
               Arrival& arrival, double& drawing_ms) const;
  [[nodiscard]] bool is_behind_box(const light::SilhouetteObject& occluder, const glm::dvec3& point_ws,
                                   double error) const;

  ShadowSettings settings_;
  const frame::Frame& frame_;
  glm::dvec4 light_;
  light::SilhouettePlan plan_;
  std::unique_ptr<SilhouettePainter> painter_;
  std::vector<std::size_t> first_texture_;  // by occluder, and the end
  std::vector<std::unique_ptr<SilhouetteTexture>> textures_;
};

}  // namespace laterna::shadow
