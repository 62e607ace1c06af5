// Where true shadows begin, and how far a pixel lies from there, in texels of the light's shadow map.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "measure/lit_pixels.h"

namespace laterna::measure {

/// The boundaries that a picture shows: halfway between neighbouring pixels of one object of which one is lit and the other
/// in shadow or turned away from the light.
class ShadowBoundaries {
 public:
  /// `counts`: asked of the pixel in shadow of each; all count without it.
  using Counts = std::function<bool(std::size_t dark_pixel)>;
  ShadowBoundaries(const LitPixels& pixels, const Mask& truth, const Counts& counts = {});
  /// Texels from the pixel to the nearest boundary that its surface, going on as it is or twice as steep, would meet;
  /// infinity beyond `reach`.
  [[nodiscard]] double distance_from(std::size_t pixel, double reach) const;

 private:
  struct Boundary {
    std::uint64_t cell = 0;
    glm::vec2 texel{0};
    float depth = 0;
  };
  void add(std::size_t lit, std::size_t dark);
  const LitPixels& pixels_;
  std::vector<Boundary> boundaries_;  // sorted by cell
};

/// Whether a lit pixel has a true shadow within `reach` texels on its plane, found by rays: the picture does not show what
/// lies beyond its rim or behind something. What stands within two texels' width of the plane does not count, nor does
/// what the surface itself, where it bends, puts in the way.
bool has_shadow_beside(const LitPixels& pixels, std::size_t pixel, double reach);

}  // namespace laterna::measure
