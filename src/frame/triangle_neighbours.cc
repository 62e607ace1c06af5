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

// Calls visit(id, corners) for one primitive's triangles, with their joined corners, numbered as its clusters have them.
// Triangles without three places to their corners are left out: their neighbours share an edge with each other.
template <class Visit>
void for_each_triangle(const ClusteredPrimitive& clustered, const std::vector<std::uint32_t>& joined,
                       const Visit& visit) {
  for (std::uint32_t c = 0; c < clustered.clusters.size(); ++c) {
    const ClusteredPrimitive::Extent& extent = clustered.clusters[c];
    const std::uint32_t* source = clustered.source_vertices.data() + extent.first_vertex;
    for (std::uint32_t t = 0; t < extent.triangle_count; ++t) {
      const std::uint32_t id = c << kTriangleBits | t;
      const std::uint32_t packed = clustered.corners[id];
      const Corners corners = {joined[source[packed & 255U]], joined[source[packed >> 8U & 255U]],
                               joined[source[packed >> 16U & 255U]]};
      if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
        visit(id, corners);
    }
  }
}

// A triangle's edge, listed at the lower of its two ends.
struct ListedEdge {
  std::uint32_t other_end;
  std::uint32_t edge;  // 4 · triangle + edge
  bool operator<(const ListedEdge& b) const {
    return other_end != b.other_end ? other_end < b.other_end : edge < b.edge;
  }
};

// Edges between the same two ends form a ring.
void link(std::span<const ListedEdge> ring, glm::ivec3* steps) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::uint32_t from = ring[i].edge;
    const std::uint32_t to = ring[i + 1 < ring.size() ? i + 1 : 0].edge;
    steps[from >> 2U][static_cast<int>(from & 3U)] = static_cast<std::int32_t>((to >> 2U) - (from >> 2U));
  }
}

void write_steps(const ClusteredPrimitive& clustered, std::span<const glm::vec3> positions,
                 glm::ivec3* steps) {
  const std::vector<std::uint32_t> joined = join_positions(positions);
  const auto for_each_edge = [&](auto visit) {
    for_each_triangle(clustered, joined, [&](std::uint32_t id, const Corners& corners) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(corners[k], corners[k == 2 ? 0 : k + 1]);
        visit(low, ListedEdge{high, id << 2U | k});
      }
    });
  };
  // Counted, put in the lists of their ends, and each list sorted by the other end.
  std::vector<std::uint32_t> end_of_list(positions.size() + 1, 0);
  for_each_edge([&](std::uint32_t low, const ListedEdge&) { ++end_of_list[low + 1]; });
  for (std::size_t v = 1; v < end_of_list.size(); ++v) end_of_list[v] += end_of_list[v - 1];
  std::vector<ListedEdge> edges(end_of_list.back());
  // What is a list's start becomes its end while it is filled.
  for_each_edge([&](std::uint32_t low, const ListedEdge& edge) { edges[end_of_list[low]++] = edge; });
  std::size_t first = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const std::size_t end = end_of_list[v];
    std::sort(edges.begin() + static_cast<std::ptrdiff_t>(first),
              edges.begin() + static_cast<std::ptrdiff_t>(end));
    for (std::size_t next = first; first < end; first = next) {
      while (next < end && edges[next].other_end == edges[first].other_end) ++next;
      link(std::span(edges).subspan(first, next - first), steps);
    }
  }
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
  // Kernels find triangles by 32-bit indices.
  if (clusters > std::numeric_limits<std::int32_t>::max() / kTrianglesPerCluster) return neighbours;
  neighbours.steps.resize(clusters * kTrianglesPerCluster + 1);
  neighbours.steps.back() = glm::ivec3(0);
  struct Part {
    std::size_t mesh, part;
  };
  std::vector<Part> parts;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (std::size_t p = 0; p < meshes[m].size(); ++p) parts.push_back({m, p});
  }
  pool.for_each(parts.size(), [&](std::size_t i, int) {
    const auto [m, p] = parts[i];
    glm::ivec3* steps = neighbours.steps.data() + first[m][p] * kTrianglesPerCluster;
    std::fill_n(steps, meshes[m][p].clusters.size() * kTrianglesPerCluster, glm::ivec3(0));
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
