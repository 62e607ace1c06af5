#include "shadow/volume_surface.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace laterna::shadow {
namespace {

struct Position {
  float x, y, z;
  std::uint32_t vertex;

  [[nodiscard]] bool is_before(const Position& o) const {
    if (x != o.x) return x < o.x;
    if (y != o.y) return y < o.y;
    return z < o.z;
  }
};

}  // namespace

class VolumeSurface::Builder {
 public:
  Builder(const frame::Frame& frame, const light::LightRays& light, VolumeSurface& surface)
      : frame_(frame), light_(light), surface_(surface) {}

  void build() {
    join_vertices();
    for (std::uint32_t c = 0; c < frame_.clusters.size(); ++c) {
      const Cluster& cluster = frame_.clusters[c];
      if (!is_opaque_caster(cluster)) continue;
      const bool is_cutout = (cluster.flags & kAlphaMask) != 0;
      for (std::uint32_t t = 0; t < cluster.triangle_count; ++t)
        add_caster(c << kTriangleBits | t, cluster.first_vertex, is_cutout);
    }
    add_walls();
  }

 private:
  // Clusters keep their own copies of the vertices on their borders. Points of equal position become one.
  void join_vertices() {
    std::vector<Position> positions;
    for (const Cluster& cluster : frame_.clusters) {
      if (!is_opaque_caster(cluster)) continue;
      for (std::uint32_t v = cluster.first_vertex; v < cluster.first_vertex + cluster.vertex_count; ++v)
        positions.push_back(
            {frame_.positions_ws[v].x, frame_.positions_ws[v].y, frame_.positions_ws[v].z, v});
    }
    std::sort(positions.begin(), positions.end(),
              [](const Position& a, const Position& b) { return a.is_before(b); });
    point_of_vertex_.resize(frame_.positions_ws.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Position& p = positions[i];
      if (i == 0 || positions[i - 1].is_before(p)) surface_.points_ws_.emplace_back(p.x, p.y, p.z);
      point_of_vertex_[p.vertex] = static_cast<std::uint32_t>(surface_.points_ws_.size() - 1);
    }
  }

  void add_caster(TriangleId id, std::uint32_t first_vertex, bool is_cutout) {
    const std::uint32_t packed = frame_.corners[id];
    Corners corners{};
    for (unsigned k = 0; k < 3; ++k) corners[k] = point_of_vertex_[first_vertex + (packed >> (8 * k) & 255U)];
    const std::array<bool, 3> is_beyond = {is_beyond_near(corners[0]), is_beyond_near(corners[1]),
                                           is_beyond_near(corners[2])};
    if (!is_beyond[0] && !is_beyond[1] && !is_beyond[2]) return;
    if (is_cutout) {
      add_prism(id, corners);
    } else if (is_beyond[0] && is_beyond[1] && is_beyond[2]) {
      add_triangle(corners);
    } else {
      add_clipped(corners, is_beyond);
    }
  }

  [[nodiscard]] bool is_beyond_near(std::uint32_t point) const {
    return light_.beyond_near(surface_.points_ws_[point]) >= 0;
  }

  void add_clipped(const Corners& corners, const std::array<bool, 3>& is_beyond) {
    std::vector<std::uint32_t> kept;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (is_beyond[k]) kept.push_back(corners[k]);
      if (is_beyond[k] != is_beyond[next]) kept.push_back(point_at_near(corners[k], corners[next]));
    }
    for (std::size_t k = 2; k < kept.size(); ++k) add_triangle({kept[0], kept[k - 1], kept[k]});
  }

  // Where an edge passes the near plane: one point for all triangles that share the edge.
  std::uint32_t point_at_near(std::uint32_t a, std::uint32_t b) {
    const std::pair<std::uint32_t, std::uint32_t> edge = std::minmax(a, b);
    const auto next = static_cast<std::uint32_t>(surface_.points_ws_.size());
    const auto [found, is_new] = near_points_.try_emplace(edge, next);
    if (is_new) {
      const glm::dvec3 from = surface_.points_ws_[edge.first];
      const glm::dvec3 to = surface_.points_ws_[edge.second];
      const double at_from = light_.beyond_near(from);
      const double at_to = light_.beyond_near(to);
      surface_.points_ws_.push_back(from + (to - from) * (at_from / (at_from - at_to)));
    }
    return found->second;
  }

  // Turned so that the light sees it counter-clockwise. False: it sees it edge-on, and nothing is cast.
  [[nodiscard]] bool face_light(Corners& corners) const {
    const glm::dvec3& a = surface_.points_ws_[corners[0]];
    const glm::dvec3 normal =
        glm::cross(surface_.points_ws_[corners[1]] - a, surface_.points_ws_[corners[2]] - a);
    const double away = glm::dot(normal, light_.away_at(a));
    if (away > 0) std::swap(corners[1], corners[2]);
    return away != 0;
  }

  // Whole: what is nearer than the near plane is left out where the light's way is looked at.
  void add_prism(TriangleId id, Corners corners) {
    if (face_light(corners)) surface_.prisms_.push_back({corners, id});
  }

  void add_triangle(Corners corners) {
    if (!face_light(corners)) return;
    surface_.append_ends(corners, surface_.triangles_);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[k];
      const std::uint32_t to = corners[(k + 1) % 3];
      if (from < to) {
        edges_.push_back({from, to, 1});
      } else {
        edges_.push_back({to, from, -1});
      }
    }
  }

  void add_walls() {
    std::sort(edges_.begin(), edges_.end(),
              [](const Edge& a, const Edge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
    for (std::size_t first = 0; first < edges_.size();) {
      const Edge& edge = edges_[first];
      std::int32_t sum = 0;
      std::size_t end = first;
      for (; end < edges_.size() && edges_[end].low == edge.low && edges_[end].high == edge.high; ++end)
        sum += edges_[end].count;
      if (sum > 0) surface_.append_wall(edge.low, edge.high, sum, surface_.triangles_);
      if (sum < 0) surface_.append_wall(edge.high, edge.low, -sum, surface_.triangles_);
      surface_.silhouette_edges_ += sum != 0 ? 1 : 0;
      first = end;
    }
  }

  struct Edge {
    std::uint32_t low, high;
    std::int32_t count;  // +1 from low to high, −1 back
  };

  const frame::Frame& frame_;
  const light::LightRays& light_;
  VolumeSurface& surface_;
  std::vector<std::uint32_t> point_of_vertex_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> near_points_;
  std::vector<Edge> edges_;
};

// Where a shadow begins, and where it ends. All rays of a parallel light end in one point.
void VolumeSurface::append_ends(const Corners& c, std::vector<VolumeTriangle>& triangles) const {
  triangles.push_back({{{c[0], false}, {c[1], false}, {c[2], false}}, 1, VolumePart::cap});
  if (!is_parallel_) triangles.push_back({{{c[0], true}, {c[2], true}, {c[1], true}}, 1, VolumePart::end});
}

// Below an edge that a triangle toward the light runs along from → to, the triangle on its left.
void VolumeSurface::append_wall(std::uint32_t from, std::uint32_t to, std::int32_t count,
                                std::vector<VolumeTriangle>& triangles) const {
  const VolumeCorner from_end = {is_parallel_ ? 0 : from, true};
  const VolumeCorner to_end = {is_parallel_ ? 0 : to, true};
  triangles.push_back({{{to, false}, {from, false}, from_end}, count, VolumePart::side});
  if (!is_parallel_) triangles.push_back({{{to, false}, from_end, to_end}, count, VolumePart::side});
}

std::vector<VolumeTriangle> VolumeSurface::surface_of(const VolumePrism& prism) const {
  std::vector<VolumeTriangle> triangles;
  append_ends(prism.point, triangles);
  for (std::size_t k = 0; k < 3; ++k) append_wall(prism.point[k], prism.point[(k + 1) % 3], 1, triangles);
  return triangles;
}

VolumeSurface::VolumeSurface(const frame::Frame& frame, const light::LightRays& light)
    : is_parallel_(light.is_parallel) {
  Builder(frame, light, *this).build();
}

std::size_t VolumeSurface::memory_bytes() const {
  return points_ws_.capacity() * sizeof(glm::dvec3) + triangles_.capacity() * sizeof(VolumeTriangle) +
         prisms_.capacity() * sizeof(VolumePrism);
}

}  // namespace laterna::shadow
