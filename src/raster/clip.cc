#include "raster/clip.h"

namespace laterna::raster {
namespace {

// Signed distance to plane 0…5, linear in the homogeneous position, ≥ 0 inside.
double distance(const ClipVertex& v, int plane, double guard_band) {
  switch (plane) {
    case 0:
      return v.near_side;
    case 1:
      return guard_band * v.w + v.x;
    case 2:
      return guard_band * v.w - v.x;
    case 3:
      return guard_band * v.w + v.y;
    case 4:
      return guard_band * v.w - v.y;
    default:
      return v.cut_side;
  }
}

// Always computed from the inside point to the outside one, so that two triangles sharing the edge, which walk it in
// opposite directions, get the same bits and no gap opens.
ClipVertex intersect(const ClipVertex& inside, double d_inside, const ClipVertex& outside, double d_outside) {
  const double t = d_inside / (d_inside - d_outside);
  return {inside.x + t * (outside.x - inside.x), inside.y + t * (outside.y - inside.y),
          inside.w + t * (outside.w - inside.w),
          inside.near_side + t * (outside.near_side - inside.near_side),
          inside.cut_side + t * (outside.cut_side - inside.cut_side)};
}

bool is_inside(const ClippedPolygon& polygon, int plane, double guard_band) {
  for (std::size_t i = 0; i < polygon.count; ++i) {
    if (!(distance(polygon.vertices[i], plane, guard_band) >= 0)) return false;
  }
  return true;
}

void append(ClippedPolygon& polygon, const ClipVertex& vertex, int corner) {
  polygon.vertices[polygon.count] = vertex;
  polygon.corner[polygon.count] = corner;
  ++polygon.count;
}

}  // namespace

// Sutherland and Hodgman, Reentrant polygon clipping, 1974.
ClippedPolygon clip_triangle(const std::array<ClipVertex, 3>& triangle, double guard_band, bool is_cut) {
  const int planes = is_cut ? 6 : 5;
  ClippedPolygon polygon;
  for (int i = 0; i < 3; ++i) append(polygon, triangle[static_cast<std::size_t>(i)], i);
  for (int plane = 0; plane < planes && polygon.count >= 3; ++plane) {
    if (is_inside(polygon, plane, guard_band)) continue;
    ClippedPolygon cut;
    for (std::size_t i = 0; i < polygon.count; ++i) {
      const std::size_t j = i + 1 == polygon.count ? 0 : i + 1;
      const ClipVertex& a = polygon.vertices[i];
      const ClipVertex& b = polygon.vertices[j];
      const double d_a = distance(a, plane, guard_band);
      const double d_b = distance(b, plane, guard_band);
      if (d_a >= 0) append(cut, a, polygon.corner[i]);
      if (d_a >= 0 && d_b < 0) append(cut, intersect(a, d_a, b, d_b), -1);
      if (d_a < 0 && d_b >= 0) append(cut, intersect(b, d_b, a, d_a), -1);
    }
    polygon = cut;
  }
  if (polygon.count < 3) polygon.count = 0;
  return polygon;
}

}  // namespace laterna::raster
