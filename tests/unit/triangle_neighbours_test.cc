// Neighbours of triangles against a search through all pairs, and on meshes whose neighbours are plain to see.
#include "frame/triangle_neighbours.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "reference/shapes.h"

namespace laterna::frame {
namespace {

struct Built {
  reference::OwnedFrame owned;
  TriangleNeighbours neighbours;
};

Built build(Scene scene) {
  const TaskPool pool(2);
  const ClusteredMeshes meshes = build_clusters(scene, pool);
  auto of_meshes = std::make_shared<const MeshNeighbours>(find_mesh_neighbours(scene, meshes, pool));
  TriangleNeighbours neighbours = place_neighbours(of_meshes, scene, meshes);
  return {reference::make_frame(std::move(scene)), std::move(neighbours)};
}

using Place = std::array<float, 3>;

std::array<Place, 3> corners_of(const Frame& frame, TriangleId id) {
  std::array<Place, 3> corners;
  for (unsigned k = 0; k < 3; ++k) {
    const std::size_t v = frame.clusters[cluster_of(id)].first_vertex + (frame.corners[id] >> (8 * k) & 255U);
    const glm::vec3& p = frame.positions_ws[v];
    corners[k] = {p.x, p.y, p.z};
  }
  return corners;
}

// Across edge k of the triangle as the frame has it; the triangle itself where there is none.
TriangleId across(const TriangleNeighbours& neighbours, TriangleId id, unsigned edge) {
  const auto source = static_cast<std::size_t>(neighbours.sources[cluster_of(id)]);
  const std::size_t triangle = (source >> 1U) * kTrianglesPerCluster + id % kTrianglesPerCluster;
  const unsigned stored = source % 2 == 0 ? edge : 2 - edge;
  return id + static_cast<TriangleId>(neighbours.meshes->steps[triangle][static_cast<int>(stored)]);
}

std::vector<TriangleId> triangles_of(const Frame& frame) {
  std::vector<TriangleId> ids;
  for (std::uint32_t c = 0; c < frame.clusters.size(); ++c) {
    for (std::uint32_t t = 0; t < frame.clusters[c].triangle_count; ++t)
      ids.push_back(c << kTriangleBits | t);
  }
  return ids;
}

std::set<Place> edge_of(const std::array<Place, 3>& corners, unsigned k) {
  return {corners[k], corners[(k + 1) % 3]};
}

// All triangles of the same object and material with this edge, the triangle itself left out.
std::set<TriangleId> sharers(const Frame& frame, const std::vector<TriangleId>& ids, TriangleId id,
                             unsigned k) {
  const std::set<Place> edge = edge_of(corners_of(frame, id), k);
  const Cluster& own = frame.clusters[cluster_of(id)];
  std::set<TriangleId> found;
  for (const TriangleId other : ids) {
    const Cluster& cluster = frame.clusters[cluster_of(other)];
    if (other == id || cluster.object != own.object || cluster.material != own.material) continue;
    const auto corners = corners_of(frame, other);
    for (unsigned j = 0; j < 3; ++j) {
      if (edge_of(corners, j) == edge) found.insert(other);
    }
  }
  return found;
}

void expect_all_pairs(const Built& built) {
  const Frame& frame = built.owned.frame;
  const std::vector<TriangleId> ids = triangles_of(frame);
  ASSERT_EQ(built.neighbours.sources.size(), frame.clusters.size());
  for (const TriangleId id : ids) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::set<TriangleId> expected = sharers(frame, ids, id, k);
      const TriangleId got = across(built.neighbours, id, k);
      if (expected.empty()) {
        EXPECT_EQ(got, id) << "triangle " << id << " edge " << k;
      } else {
        EXPECT_EQ(expected.count(got), 1U) << "triangle " << id << " edge " << k << " leads to " << got;
      }
    }
  }
}

TEST(TriangleNeighbours, AreThoseThatShareAnEdgesPlaces) {
  Scene scene;
  // Seams, poles and several clusters; flat faces, whose corners are stored once for each.
  reference::add_object(scene, "ball", reference::sphere({0, 0, 0}, 1, 12));
  reference::add_object(scene, "box", reference::box({3, 0, 0}, {1, 1, 1}));
  reference::add_object(scene, "ring", reference::torus({0, 3, 0}, 2, 0.5F, 16));
  expect_all_pairs(build(std::move(scene)));
}

TEST(TriangleNeighbours, OfInstancesAlsoWhereTheyAreMirrored) {
  Scene scene;
  const int node = reference::add_object(scene, "ball", reference::sphere({0, 0, 0}, 1, 12));
  for (const double x : {1.0, -1.0}) {
    Node copy = scene.nodes[static_cast<std::size_t>(node)];
    copy.parent_from_node = glm::dmat4(1);
    copy.parent_from_node[0][0] = x;
    copy.parent_from_node[3] = glm::dvec4(4 * x, 0, 0, 1);
    scene.nodes.push_back(copy);
  }
  const Built built = build(std::move(scene));
  EXPECT_EQ(built.neighbours.sources.back() % 2, 1);
  expect_all_pairs(built);
}

TEST(TriangleNeighbours, OnEdgesOfManyTrianglesFormARing) {
  reference::Mesher mesher;
  const glm::vec3 low(0, 0, 0);
  const glm::vec3 high(0, 1, 0);
  for (int i = 0; i < 5; ++i) mesher.triangle(low, high, {1, 0.5F, static_cast<float>(i)});
  Scene scene;
  reference::add_object(scene, "book", mesher.primitive);
  const Built built = build(std::move(scene));
  std::set<TriangleId> visited;
  TriangleId id = 0;
  for (int i = 0; i < 5; ++i) {
    visited.insert(id);
    const auto corners = corners_of(built.owned.frame, id);
    for (unsigned k = 0; k < 3; ++k) {
      if (edge_of(corners, k) == std::set<Place>{{0, 0, 0}, {0, 1, 0}}) {
        id = across(built.neighbours, id, k);
        break;
      }
    }
  }
  EXPECT_EQ(visited.size(), 5U);
  EXPECT_EQ(id, 0U) << "back at the first";
}

TEST(TriangleNeighbours, LookThroughTrianglesWithoutWidth) {
  // Between two triangles lies one whose corners fall together in place, though not in number.
  reference::Mesher mesher;
  mesher.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesher.triangle({1, 0, 0}, {0, 1, 0}, {0, 1, 0});
  mesher.triangle({1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  Scene scene;
  reference::add_object(scene, "seam", mesher.primitive);
  const Built built = build(std::move(scene));
  std::set<std::pair<TriangleId, TriangleId>> pairs;
  for (const TriangleId id : triangles_of(built.owned.frame)) {
    for (unsigned k = 0; k < 3; ++k) {
      const TriangleId other = across(built.neighbours, id, k);
      if (other != id) pairs.insert({id, other});
    }
  }
  ASSERT_EQ(pairs.size(), 2U) << "one edge, seen from both sides";
  const auto [a, b] = *pairs.begin();
  EXPECT_EQ(pairs.count({b, a}), 1U);
}

TEST(TriangleNeighbours, DoNotDependOnTheNumberOfThreads) {
  Scene scene;
  for (int i = 0; i < 6; ++i) reference::add_object(scene, "ball", reference::sphere({0, 0, 0}, 1, 8 + i));
  const ClusteredMeshes meshes = build_clusters(scene, TaskPool(1));
  EXPECT_EQ(find_mesh_neighbours(scene, meshes, TaskPool(1)).steps,
            find_mesh_neighbours(scene, meshes, TaskPool(4)).steps);
}

}  // namespace
}  // namespace laterna::frame
