#include "render/warped_casters.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <limits>

namespace laterna::render {
namespace {

// How far in front of the warp's eye a vertex must lie, in units of the distance at which texels have their own size.
// The plan leaves more than this.
constexpr double kNearestToEye = 1.0 / 256;

// Entries that kernels may read beyond the last vertex.
constexpr std::size_t kPadding = 16;

std::size_t vertex_count(const TriangleClusters& geometry) {
  std::size_t count = 0;
  for (const Cluster& c : geometry.clusters)
    count = std::max<std::size_t>(count, c.first_vertex + c.vertex_count);
  return count;
}

// Rows of an orthographic view over homogeneous points of its space: pixel x, y and reversed depth, and 1.
glm::dmat4 pixel_from_space(const raster::RasterView& view) {
  const auto row = [&](const glm::dvec3& form, double add) {
    return glm::dvec4(form, add - glm::dot(form, view.eye_ws));
  };
  return glm::transpose(glm::dmat4(row(view.x_row, view.x_add), row(view.y_row, view.y_add),
                                   row(view.w_row, view.w_add), glm::dvec4(0, 0, 0, 1)));
}

}  // namespace

WarpedCasters::WarpedCasters(const TriangleClusters& geometry, const light::Warp& warp, const TaskPool& pool)
    : clusters_(geometry.clusters.begin(), geometry.clusters.end()), corners_(geometry.corners) {
  const std::size_t count = vertex_count(geometry) + kPadding;
  positions_.resize(count, glm::vec3(0));
  constexpr std::size_t kClustersPerTask = 64;
  pool.for_each((clusters_.size() + kClustersPerTask - 1) / kClustersPerTask, [&](std::size_t task, int) {
    const std::size_t end = std::min(clusters_.size(), (task + 1) * kClustersPerTask);
    for (std::size_t i = task * kClustersPerTask; i < end; ++i) warp_cluster(geometry, warp, clusters_[i]);
  });
}

void WarpedCasters::warp_cluster(const TriangleClusters& from, const light::Warp& warp, Cluster& cluster) {
  if ((cluster.flags & kCastsShadow) == 0) return;
  std::fill_n(cluster.low_ws, 3, std::numeric_limits<float>::max());
  std::fill_n(cluster.high_ws, 3, std::numeric_limits<float>::lowest());
  for (std::size_t v = cluster.first_vertex; v < cluster.first_vertex + std::size_t{cluster.vertex_count};
       ++v) {
    const glm::dvec4 p = warp.warped_from_world * glm::dvec4(from.positions_ws[v], 1);
    if (!(p.w >= kNearestToEye)) {
      cluster.flags = 0;
      return;
    }
    const glm::vec3 at = glm::vec3(glm::dvec3(p) / p.w);
    positions_[v] = at;
    for (int k = 0; k < 3; ++k) {
      cluster.low_ws[k] = std::min(cluster.low_ws[k], at[k]);
      cluster.high_ws[k] = std::max(cluster.high_ws[k], at[k]);
    }
  }
}

TriangleClusters WarpedCasters::geometry() const { return {positions_.data(), corners_, clusters_}; }

WarpedCut::WarpedCut(const raster::AlphaCut& cut, const light::Warp& warp, const raster::RasterView& warped,
                     const raster::RasterView& unwarped)
    : cut_(cut),
      unwarped_from_warped_(pixel_from_space(unwarped) * glm::inverse(warp.warped_from_world) *
                            glm::inverse(pixel_from_space(warped))) {}

void WarpedCut::keep(TriangleId id, raster::CutSamples& samples, std::uint16_t* kept) const {
  raster::CutSamples moved;
  moved.count = samples.count;
  for (std::size_t i = 0; i < 16 * samples.groups(); ++i) {
    const glm::dvec4 p =
        unwarped_from_warped_ * glm::dvec4(samples.x[i], samples.y[i], samples.reversed_depth[i], 1);
    moved.x[i] = static_cast<float>(p.x / p.w);
    moved.y[i] = static_cast<float>(p.y / p.w);
    moved.reversed_depth[i] = static_cast<float>(p.z / p.w);
  }
  cut_.keep(id, moved, kept);
}

}  // namespace laterna::render
