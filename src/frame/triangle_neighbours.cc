#include "frame/triangle_neighbours.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/vec3.hpp>
#include <limits>

#include "base/triangle_clusters.h"
#include "frame/flatten.h"

namespace laterna::frame {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;
// Of the triangles about an edge's end so many are looked at. A fan may have any number; its edges' other ends do not.
constexpr std::uint32_t kMostCandidates = 64;

std::uint32_t hash_of(const glm::vec3& p) {
  // −0 and 0 are one place.
  const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v + 0.0F); };
  std::uint64_t h = bits(p.x) * 0x9E3779B97F4A7C15ULL;
  h = (h ^ h >> 29U ^ bits(p.y)) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ h >> 32U ^ bits(p.z)) * 0x94D049BB133111EBULL;
  return static_cast<std::uint32_t>(h >> 32U);
}

/// For each vertex the first one at the same position.
std::vector<std::uint32_t> join_positions(std::span<const glm::vec3> positions) {
  const std::size_t size = std::bit_ceil(2 * positions.size() + 1);
  std::vector<std::uint32_t> table(size, kNone);
  std::vector<std::uint32_t> joined(positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    std::size_t slot = hash_of(positions[v]) & (size - 1);
    while (table[slot] != kNone && positions[table[slot]] != positions[v]) slot = (slot + 1) & (size - 1);
    if (table[slot] == kNone) table[slot] = v;
    joined[v] = table[slot];
  }
  return joined;
}

using Corners = std::array<std::uint32_t, 3>;

// One primitive's triangles by their joined corners, numbered as its clusters have them.
class JoinedTriangles {
 public:
  JoinedTriangles(const ClusteredPrimitive& clustered, std::span<const glm::vec3> positions)
      : clustered_(clustered), joined_(join_positions(positions)), first_(positions.size() + 1) {
    // Counted, then sorted by corner.
    for_each([&](std::uint32_t, const Corners& corners) {
      for (const std::uint32_t v : corners) ++first_[v + 1];
    });
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    about_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for_each([&](std::uint32_t id, const Corners& corners) {
      for (const std::uint32_t v : corners) about_[next[v]++] = id;
    });
  }

  // Those with three corners apart.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::uint32_t c = 0; c < clustered_.clusters.size(); ++c) {
      for (std::uint32_t t = 0; t < clustered_.clusters[c].triangle_count; ++t) {
        const std::uint32_t id = c << kTriangleBits | t;
        const Corners corners = corners_of(id);
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
          visit(id, corners);
      }
    }
  }

  // The next triangle with an edge between these corners, in the ring of all that have it; `id` where there is none.
  [[nodiscard]] std::uint32_t across(std::uint32_t id, std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t end = count_about(a) <= count_about(b) ? a : b;
    const std::uint32_t other = end == a ? b : a;
    const std::uint32_t count = std::min(count_about(end), kMostCandidates);
    const std::uint32_t* candidates = about_.data() + first_[end];
    std::uint32_t earlier = id;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t candidate = candidates[i];
      if (candidate == id || (candidate < id && earlier != id)) continue;
      const Corners corners = corners_of(candidate);
      if (std::find(corners.begin(), corners.end(), other) == corners.end()) continue;
      if (candidate > id) return candidate;
      earlier = candidate;
    }
    return earlier;
  }

 private:
  [[nodiscard]] Corners corners_of(std::uint32_t id) const {
    const std::uint32_t packed = clustered_.corners[id];
    const std::uint32_t* source =
        clustered_.source_vertices.data() + clustered_.clusters[id >> kTriangleBits].first_vertex;
    return {joined_[source[packed & 255U]], joined_[source[packed >> 8U & 255U]],
            joined_[source[packed >> 16U & 255U]]};
  }
  [[nodiscard]] std::uint32_t count_about(std::uint32_t vertex) const {
    return first_[vertex + 1] - first_[vertex];
  }

  const ClusteredPrimitive& clustered_;
  std::vector<std::uint32_t> joined_;
  std::vector<std::uint32_t> first_;  // by vertex, into about_
  std::vector<std::uint32_t> about_;  // triangles about it, in order
};

void write_steps(const ClusteredPrimitive& clustered, std::span<const glm::vec3> positions,
                 std::int32_t* steps) {
  const JoinedTriangles triangles(clustered, positions);
  triangles.for_each([&](std::uint32_t id, const Corners& corners) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const std::uint32_t neighbour = triangles.across(id, corners[edge], corners[(edge + 1) % 3]);
      steps[3 * std::size_t{id} + edge] = static_cast<std::int32_t>(neighbour - id);
    }
  });
}

// Where each primitive's clusters start among those of all.
std::vector<std::vector<std::size_t>> first_clusters(const ClusteredMeshes& meshes, std::size_t& count) {
  std::vector<std::vector<std::size_t>> first(meshes.size());
  count = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const ClusteredPrimitive& part : meshes[m]) {
      first[m].push_back(count);
      count += part.clusters.size();
    }
  }
  return first;
}

}  // namespace

MeshNeighbours find_mesh_neighbours(const Scene& scene, const ClusteredMeshes& meshes, const TaskPool& pool) {
  std::size_t clusters = 0;
  const std::vector<std::vector<std::size_t>> first = first_clusters(meshes, clusters);
  MeshNeighbours neighbours;
  constexpr std::size_t kStepsPerCluster = 3 * kTrianglesPerCluster;
  if (clusters > std::numeric_limits<std::int32_t>::max() / kStepsPerCluster) return neighbours;
  neighbours.steps.resize(clusters * kStepsPerCluster);
  struct Part {
    std::size_t mesh, part;
  };
  std::vector<Part> parts;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (std::size_t p = 0; p < meshes[m].size(); ++p) parts.push_back({m, p});
  }
  pool.for_each(parts.size(), [&](std::size_t i, int) {
    const auto [m, p] = parts[i];
    std::int32_t* steps = neighbours.steps.data() + first[m][p] * kStepsPerCluster;
    std::fill_n(steps, meshes[m][p].clusters.size() * kStepsPerCluster, 0);
    write_steps(meshes[m][p], scene.meshes[m].primitives[p].positions, steps);
  });
  return neighbours;
}

TriangleNeighbours place_neighbours(std::shared_ptr<const MeshNeighbours> neighbours, const Scene& scene,
                                    const ClusteredMeshes& meshes) {
  TriangleNeighbours placed;
  placed.meshes = std::move(neighbours);
  if (placed.meshes->steps.empty()) return placed;
  std::size_t clusters = 0;
  const std::vector<std::vector<std::size_t>> first = first_clusters(meshes, clusters);
  for_each_object(
      scene, world_from_nodes(scene),
      [&](const Node& node, std::size_t, const glm::dmat4& world_from_object) {
        const auto mesh = static_cast<std::size_t>(node.mesh);
        const std::size_t mirrored = is_mirroring(world_from_object) ? 1 : 0;
        for (std::size_t p = 0; p < meshes[mesh].size(); ++p) {
          for (std::size_t c = 0; c < meshes[mesh][p].clusters.size(); ++c)
            placed.sources.push_back(static_cast<std::int32_t>(2 * (first[mesh][p] + c) + mirrored));
        }
      });
  return placed;
}

}  // namespace laterna::frame
