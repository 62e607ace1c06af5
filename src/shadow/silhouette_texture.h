// A silhouette as a texture: one occluder drawn black on white from the light, thrown onto whatever is looked up. Segal et
// al., Fast shadows and lighting effects using texture mapping, 1992; Chen and Tung, Real-time shadow rendering using
// projective texture.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "light/light_plan.h"
#include "shadow/projected_view.h"
#include "shadow/smooth_texels.h"

namespace laterna::shadow {

/// Draws silhouettes. Calls may come from several threads at once.
class SilhouettePainter {
 public:
  SilhouettePainter() = default;
  virtual ~SilhouettePainter() = default;
  SilhouettePainter(const SilhouettePainter&) = delete;
  SilhouettePainter& operator=(const SilhouettePainter&) = delete;
  /// Sets to 0 what the object covers of a picture that is all 1.
  virtual void paint(std::uint32_t object, const raster::RasterView& view, ArrivingLight& picture) const = 0;
};

class SilhouetteTexture {
 public:
  SilhouetteTexture(const light::ShadowView& view, std::uint32_t object, const raster::RasterView::Ray& ray);

  /// Draws it unless that is done. Returns whether this call did.
  bool require(const SilhouettePainter& painter, const ShadowSettings& settings);
  [[nodiscard]] bool is_drawn() const { return is_drawn_.load(std::memory_order_acquire); }
  [[nodiscard]] const raster::RasterView& view() const { return view_; }
  [[nodiscard]] std::size_t memory_bytes() const { return texels_.size() * sizeof(std::uint16_t); }

  /// Where a sample of the rays lies in the texture, by equation 6, and whether it lies before the light.
  struct Place {
    float x, y;
    bool is_ahead;
  };
  [[nodiscard]] Place place_of(float x, float y, float q) const;

  /// How much passes at a place: 1 beside the texture. Drawn before.
  [[nodiscard]] float nearest(const Place& place) const;
  [[nodiscard]] float bilinear(const Place& place) const;

 private:
  [[nodiscard]] float texel(int x, int y) const;

  raster::RasterView view_;
  std::uint32_t object_;
  ProjectedView position_;
  ProjectedRow homogeneous_;
  std::once_flag once_;
  std::atomic<bool> is_drawn_ = false;
  // In 1/32768: eighths of eighths, as smoothing makes them, are exact for five passes.
  std::vector<std::uint16_t> texels_;
};

}  // namespace laterna::shadow
