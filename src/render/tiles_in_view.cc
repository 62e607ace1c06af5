#include "render/tiles_in_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace laterna::render {
namespace {

// Rounding and snapping move a sample's triangle by less than a pixel.
constexpr double kMargin = 2;
// Of a distance, for the rounding of single precision.
constexpr double kRounding = 1e-4;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// A box's corners in pixels from the view's origin, homogeneous.
struct Corners {
  std::array<glm::dvec3, 8> xyw;
  Range w;  // perspective: distances along the axis; else 1

  Corners(const raster::RasterView& view, const frame::Bounds& box) {
    for (std::size_t k = 0; k < 8; ++k) {
      const glm::dvec3 corner((k & 1U) != 0 ? box.high.x : box.low.x, (k & 2U) != 0 ? box.high.y : box.low.y,
                              (k & 4U) != 0 ? box.high.z : box.low.z);
      const glm::dvec3 from_eye = corner - view.eye_ws;
      xyw[k] = {glm::dot(view.x_row, from_eye) + view.x_add, glm::dot(view.y_row, from_eye) + view.y_add,
                view.is_orthographic ? 1.0 : glm::dot(view.w_row, from_eye)};
      w.include(xyw[k].z);
    }
  }
};

// Whether all corners lie beyond the same side of the picture, behind the eye too.
bool is_beside(const raster::RasterView& view, const Corners& corners) {
  const double sides[2][2] = {{-view.origin_x - kMargin, view.width - view.origin_x + kMargin},
                              {-view.origin_y - kMargin, view.height - view.origin_y + kMargin}};
  for (int axis = 0; axis < 2; ++axis) {
    const auto beyond = [&](double sign, double side) {
      return std::ranges::all_of(corners.xyw,
                                 [&](const glm::dvec3& c) { return sign * (c[axis] - side * c.z) > 0; });
    };
    if (beyond(-1, sides[axis][0]) || beyond(1, sides[axis][1])) return true;
  }
  return false;
}

}  // namespace

raster::Rect tiles_in_view(const raster::RasterView& view, const frame::Bounds& box) {
  if (box.is_empty) return {};
  const raster::Rect all = {0, 0, raster::tiles_across(view.width), raster::tiles_across(view.height)};
  const Corners corners(view, box);
  if (is_beside(view, corners)) return {};
  const Projection& projection = view.view.projection;
  if (!view.is_orthographic) {
    if (corners.w.low > projection.far * (1 + kRounding)) return {};
    // What passes the eye is seen in every direction.
    if (corners.w.low <= projection.near * kRounding) return all;
  }
  Range x, y;
  for (const glm::dvec3& c : corners.xyw) {
    x.include(c.x / c.z);
    y.include(c.y / c.z);
  }
  const auto tile = [](double pixel, int origin, int tiles) {
    const double number = std::floor((pixel + origin) / raster::kTileSide);
    return static_cast<int>(std::clamp(number, -1.0, static_cast<double>(tiles)));
  };
  const raster::Rect seen = {tile(x.low - kMargin, view.origin_x, all.x_end),
                             tile(y.low - kMargin, view.origin_y, all.y_end),
                             tile(x.high + kMargin, view.origin_x, all.x_end) + 1,
                             tile(y.high + kMargin, view.origin_y, all.y_end) + 1};
  return raster::overlap(seen, all);
}

bool is_clear_between(const raster::RasterView& a, const raster::RasterView& b, const frame::Frame& frame) {
  const auto [nearer, farther] = std::minmax(a.view.projection.near, b.view.projection.near);
  return std::ranges::all_of(frame.clusters, [&](const Cluster& c) {
    if (!is_opaque_caster(c)) return true;
    const frame::Bounds box = {
        {c.low_ws[0], c.low_ws[1], c.low_ws[2]}, {c.high_ws[0], c.high_ws[1], c.high_ws[2]}, false};
    const Corners corners(a, box);
    return corners.w.high < nearer * (1 - kRounding) || corners.w.low > farther * (1 + kRounding) ||
           is_beside(a, corners);
  });
}

}  // namespace laterna::render
