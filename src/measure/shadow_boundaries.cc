#include "measure/shadow_boundaries.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/elementary.h"

namespace laterna::measure {
namespace {

constexpr float kCell = 4;  // texels
// Neighbouring pixels farther apart than this tell too little about where the boundary between them is.
constexpr float kMostBetween = 8;

std::int64_t cell_of(float texel) { return static_cast<std::int64_t>(std::floor(texel / kCell)); }

std::uint64_t key(int object, int face, std::int64_t x, std::int64_t y) {
  constexpr std::uint64_t kLow = 0xFFFF;
  return ((static_cast<std::uint64_t>(object) * 8 + static_cast<std::uint64_t>(face)) << 32U) |
         ((static_cast<std::uint64_t>(x) & kLow) << 16U) | (static_cast<std::uint64_t>(y) & kLow);
}

}  // namespace

ShadowBoundaries::ShadowBoundaries(const LitPixels& pixels, const Mask& truth, const Counts& counts)
    : pixels_(pixels) {
  const PictureSurface& surface = pixels.surface();
  for (int y = 0; y < surface.height; ++y) {
    for (int x = 0; x < surface.width; ++x) {
      const std::size_t here = surface.index(x, y);
      for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}}) {
        if (!surface.contains(x + dx, y + dy)) continue;
        const std::size_t next = surface.index(x + dx, y + dy);
        const bool here_is_lit = pixels.is_counted(here) && is_lit(truth[here]);
        const bool next_is_lit = pixels.is_counted(next) && is_lit(truth[next]);
        if (here_is_lit == next_is_lit) continue;
        const std::size_t dark = here_is_lit ? next : here;
        if (!pixels.is_counted(dark) && !pixels[dark].is_turned_away) continue;
        if (!counts || !pixels.is_counted(dark) || counts(dark)) add(here_is_lit ? here : next, dark);
      }
    }
  }
  std::sort(boundaries_.begin(), boundaries_.end(),
            [](const Boundary& a, const Boundary& b) { return a.cell < b.cell; });
}

void ShadowBoundaries::add(std::size_t lit, std::size_t dark) {
  const PictureSurface& surface = pixels_.surface();
  const LitPixel& first = pixels_[lit];
  LitPixel second = pixels_[dark];
  if (surface.object[lit] != surface.object[dark]) return;
  if (second.is_turned_away) {
    second = first;
    second.texel = glm::vec2(pixels_.texel_of(first.face, glm::dvec3(surface.position_ws[dark])));
  }
  if (first.face != second.face || glm::distance(first.texel, second.texel) > kMostBetween) return;
  const glm::vec2 texel = 0.5F * (first.texel + second.texel);
  boundaries_.push_back({key(surface.object[lit], first.face, cell_of(texel.x), cell_of(texel.y)), texel,
                         0.5F * (first.depth + second.depth)});
}

double ShadowBoundaries::distance_from(std::size_t pixel, double reach) const {
  const LitPixel& from = pixels_[pixel];
  const int object = pixels_.surface().object[pixel];
  const float depth_per_texel = 2 * (from.slope + from.footprint);
  float nearest = std::numeric_limits<float>::infinity();
  const auto rings = static_cast<std::int64_t>(std::ceil(reach / kCell));
  const std::int64_t x = cell_of(from.texel.x);
  const std::int64_t y = cell_of(from.texel.y);
  for (std::int64_t j = y - rings; j <= y + rings; ++j) {
    for (std::int64_t i = x - rings; i <= x + rings; ++i) {
      const std::uint64_t cell = key(object, from.face, i, j);
      auto b = std::lower_bound(boundaries_.begin(), boundaries_.end(), cell,
                                [](const Boundary& boundary, std::uint64_t k) { return boundary.cell < k; });
      for (; b != boundaries_.end() && b->cell == cell; ++b) {
        const float distance = glm::distance(b->texel, from.texel);
        if (std::abs(b->depth - from.depth) <= depth_per_texel * (distance + 1))
          nearest = std::min(nearest, distance);
      }
    }
  }
  return nearest <= reach ? nearest : std::numeric_limits<double>::infinity();
}

bool has_shadow_beside(const LitPixels& pixels, std::size_t pixel, double reach) {
  const LitPixel& from = pixels[pixel];
  const double near = 2.0 * from.footprint + from.slope;
  constexpr int kDirections = 16;
  constexpr double kStep = 0.25;
  for (double radius = kStep; radius <= reach; radius += kStep) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * kPi * i / kDirections;
      const glm::dvec2 texels = radius * glm::dvec2(cosine(angle), sine(angle));
      if (pixels.is_blocked(pixels.beside(pixel, texels), near)) return true;
    }
  }
  return false;
}

}  // namespace laterna::measure
