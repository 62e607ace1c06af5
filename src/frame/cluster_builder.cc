#include "frame/cluster_builder.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>

#include "base/triangle_clusters.h"

namespace laterna::frame {
namespace {

constexpr std::uint32_t kMortonBits = 10;  // per axis

// Puts two zero bits between the bits of a 10-bit number.
std::uint32_t spread_bits(std::uint32_t v) {
  v = (v | v << 16U) & 0x030000FFU;
  v = (v | v << 8U) & 0x0300F00FU;
  v = (v | v << 4U) & 0x030C30C3U;
  v = (v | v << 2U) & 0x09249249U;
  return v;
}

struct Keyed {
  std::uint32_t code, triangle;
};

// Least significant digit first, stable: equal codes stay in the order of the file.
void radix_sort(std::vector<Keyed>& items) {
  std::vector<Keyed> other(items.size());
  for (std::uint32_t shift = 0; shift < 3 * kMortonBits; shift += kMortonBits) {
    std::array<std::uint32_t, (1U << kMortonBits) + 1> start{};
    const auto digit = [&](const Keyed& item) { return item.code >> shift & ((1U << kMortonBits) - 1); };
    for (const Keyed& item : items) ++start[digit(item) + 1];
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    for (const Keyed& item : items) other[start[digit(item)]++] = item;
    items.swap(other);
  }
}

using Corners = std::array<std::uint32_t, 3>;

class TriangleList {
 public:
  TriangleList(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices)
      : indices_(indices), count_((indices.empty() ? positions.size() : indices.size()) / 3) {}
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] Corners operator[](std::size_t i) const {
    const auto at = [&](std::size_t k) {
      return indices_.empty() ? static_cast<std::uint32_t>(k) : indices_[k];
    };
    return {at(3 * i), at(3 * i + 1), at(3 * i + 2)};
  }

 private:
  std::span<const std::uint32_t> indices_;
  std::size_t count_;
};

// Triangles along a Morton curve through their centroids: neighbours in the list are neighbours in space, so runs of
// it make compact clusters (Morton, A computer oriented geodetic data base, 1966).
std::vector<Keyed> order_in_space(std::span<const glm::vec3> positions, const TriangleList& triangles) {
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(std::numeric_limits<float>::lowest());
  for (const glm::vec3& p : positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::vec3 extent = high - low;
  // One scale for all axes, so that cells are cubes.
  const float largest = std::max({extent.x, extent.y, extent.z, 1e-30F});
  const float scale = static_cast<float>((1U << kMortonBits) - 1) / (3 * largest);
  std::vector<Keyed> order;
  order.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Corners c = triangles[i];
    if (c[0] == c[1] || c[1] == c[2] || c[0] == c[2]) continue;
    const glm::vec3 sum = (positions[c[0]] - low) + (positions[c[1]] - low) + (positions[c[2]] - low);
    const auto cell = [&](float s) { return spread_bits(static_cast<std::uint32_t>(s * scale)); };
    order.push_back({cell(sum.x) | cell(sum.y) << 1U | cell(sum.z) << 2U, i});
  }
  radix_sort(order);
  return order;
}

class ClusterFiller {
 public:
  ClusterFiller(ClusteredPrimitive& out, std::size_t vertices)
      : out_(out), local_(vertices), stamp_(vertices, 0) {}

  void add(const Corners& corners) {
    std::uint32_t fresh = 0;
    for (const std::uint32_t v : corners) fresh += static_cast<std::uint32_t>(stamp_[v] != current_);
    if (current_ == 0 || extent().triangle_count == kTrianglesPerCluster ||
        extent().vertex_count + fresh > kVerticesPerCluster) {
      open();
    }
    const std::uint32_t packed = local(corners[0]) | local(corners[1]) << 8U | local(corners[2]) << 16U;
    out_.corners[(out_.clusters.size() - 1) * kTrianglesPerCluster + extent().triangle_count] = packed;
    ++extent().triangle_count;
  }

 private:
  ClusteredPrimitive::Extent& extent() { return out_.clusters.back(); }

  void open() {
    out_.clusters.push_back({static_cast<std::uint32_t>(out_.source_vertices.size()), 0, 0});
    out_.corners.resize(out_.clusters.size() * kTrianglesPerCluster, 0);
    ++current_;
  }

  std::uint32_t local(std::uint32_t vertex) {
    if (stamp_[vertex] != current_) {
      stamp_[vertex] = current_;
      local_[vertex] = static_cast<std::uint8_t>(extent().vertex_count++);
      out_.source_vertices.push_back(vertex);
    }
    return local_[vertex];
  }

  ClusteredPrimitive& out_;
  std::vector<std::uint8_t> local_;   // index within the open cluster, where
  std::vector<std::uint32_t> stamp_;  // this is the open cluster's number
  std::uint32_t current_ = 0;
};

}  // namespace

ClusteredPrimitive build_clusters(std::span<const glm::vec3> positions,
                                  std::span<const std::uint32_t> indices) {
  const TriangleList triangles(positions, indices);
  ClusteredPrimitive out;
  ClusterFiller filler(out, positions.size());
  for (const Keyed& item : order_in_space(positions, triangles)) filler.add(triangles[item.triangle]);
  return out;
}

ClusteredMeshes build_clusters(const Scene& scene, const TaskPool& pool) {
  MeshClustering clustering(scene);
  pool.for_each(clustering.task_count(), [&](std::size_t task, int) { clustering.run(task); });
  return clustering.take();
}

MeshClustering::MeshClustering(const Scene& scene) : scene_(scene), meshes_(scene.meshes.size()) {
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    meshes_[m].resize(scene.meshes[m].primitives.size());
    for (std::size_t p = 0; p < meshes_[m].size(); ++p) primitives_.push_back({m, p});
  }
}

void MeshClustering::run(std::size_t task) {
  const auto [mesh, part] = primitives_[task];
  const Primitive& primitive = scene_.meshes[mesh].primitives[part];
  meshes_[mesh][part] = build_clusters(primitive.positions, primitive.indices);
}

}  // namespace laterna::frame
