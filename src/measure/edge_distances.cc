#include "measure/edge_distances.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "laterna/accuracy.h"

namespace laterna::measure {
namespace {

enum Side : std::uint8_t { kRight = 1, kBelow = 2 };
constexpr Side kSides[] = {kRight, kBelow};

// Which pixels differ from the one to the right and the one below.
class Edges {
 public:
  Edges(const LitPixels& pixels, const Mask& mask) : surface_(pixels.surface()), sides_(mask.size()) {
    for (int y = 0; y < surface_.height; ++y) {
      for (int x = 0; x < surface_.width; ++x) {
        const std::size_t here = surface_.index(x, y);
        if (!pixels.is_counted(here)) continue;
        for (const Side side : kSides) {
          const int nx = x + (side == kRight ? 1 : 0);
          const int ny = y + (side == kBelow ? 1 : 0);
          if (!surface_.contains(nx, ny)) continue;
          const std::size_t next = surface_.index(nx, ny);
          if (!pixels.is_counted(next) || is_lit(mask[here]) == is_lit(mask[next])) continue;
          if (surface_.is_continuous(here, next)) sides_[here] |= side;
        }
      }
    }
  }

  [[nodiscard]] bool has(std::size_t pixel, Side side) const { return (sides_[pixel] & side) != 0; }

  // Pixels of the grid from the middle of a side of a pixel to the nearest edge on the same object.
  [[nodiscard]] float distance_from(int x, int y, Side side, int reach) const {
    if (has(surface_.index(x, y), side)) return 0;
    auto nearest = static_cast<float>(reach);
    for (int ring = 0; ring <= reach && static_cast<float>(ring - 1) < nearest; ++ring) {
      for (int j = -ring; j <= ring; ++j) {
        const bool is_whole_row = std::abs(j) == ring;
        for (int i = -ring; i <= ring; i += is_whole_row || ring == 0 ? 1 : 2 * ring)
          nearest = std::min(nearest, distance_to(x, y, side, x + i, y + j));
      }
    }
    return nearest;
  }

  template <class Visit>
  void for_each(Visit visit) const {
    for (int y = 0; y < surface_.height; ++y) {
      for (int x = 0; x < surface_.width; ++x) {
        for (const Side side : kSides) {
          if (has(surface_.index(x, y), side)) visit(x, y, side);
        }
      }
    }
  }

 private:
  // To whichever edge pixel (to_x, to_y) has; infinity where it has none.
  [[nodiscard]] float distance_to(int x, int y, Side side, int to_x, int to_y) const {
    float nearest = std::numeric_limits<float>::infinity();
    if (!surface_.contains(to_x, to_y)) return nearest;
    const std::size_t to = surface_.index(to_x, to_y);
    if (sides_[to] == 0 || surface_.object[to] != surface_.object[surface_.index(x, y)]) return nearest;
    for (const Side other : kSides) {
      if (!has(to, other)) continue;
      // The middle of a right side lies half a pixel to the right, that of a lower side half a pixel down.
      const float half = other == side ? 0.0F : (side == kRight ? -0.5F : 0.5F);
      nearest = std::min(
          nearest, std::hypot(static_cast<float>(to_x - x) + half, static_cast<float>(to_y - y) - half));
    }
    return nearest;
  }

  const PictureSurface& surface_;
  std::vector<std::uint8_t> sides_;
};

float quantile(std::vector<float>& values, double share) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::floor(share * last + 0.5));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

EdgeDistances find_edge_distances(const LitPixels& pixels, const Mask& truth, const Mask& mask,
                                  int subpixels) {
  const Edges true_edges(pixels, truth);
  const Edges edges(pixels, mask);
  const int reach = static_cast<int>(kFarthestEdge) * subpixels;
  std::vector<float> distances;
  const auto measure = [&](const Edges& from, const Edges& to) {
    from.for_each([&](int x, int y, Side side) {
      distances.push_back(to.distance_from(x, y, side, reach) / static_cast<float>(subpixels));
    });
  };
  measure(edges, true_edges);
  measure(true_edges, edges);
  if (distances.empty()) return {};
  EdgeDistances found;
  found.edges = distances.size();
  found.mean = std::accumulate(distances.begin(), distances.end(), 0.0) / static_cast<double>(found.edges);
  found.median = static_cast<double>(quantile(distances, 0.5));
  found.p99 = static_cast<double>(quantile(distances, 0.99));
  return found;
}

}  // namespace laterna::measure
