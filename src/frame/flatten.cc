#include "frame/flatten.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <memory>
#include <type_traits>

#include "base/elementary.h"
#include "frame/surface_lobes.h"
#include "frame/vertex_pose.h"
#include "scene/scene_pose.h"

namespace laterna::frame {
namespace {

std::uint32_t material_flags(const Scene& scene, int material) {
  if (material < 0) return 0;
  const Material& m = scene.materials[static_cast<std::size_t>(material)];
  std::uint32_t flags = m.double_sided ? kDoubleSided : 0U;
  if (m.alpha_mode == AlphaMode::mask) flags |= kAlphaMask;
  if (m.alpha_mode == AlphaMode::blend) flags |= kAlphaBlend;
  if (may_show(scene, material, AnimatedProperty::transmission)) flags |= kTransmissive;
  if (has_relief(m)) flags |= kRelief;
  return flags;
}

// Metres per unit: the cube root of how volumes grow.
float scale_of(const glm::dmat4& world_from_object) {
  return static_cast<float>(power(std::abs(glm::determinant(glm::dmat3(world_from_object))), 1.0 / 3));
}

std::uint32_t node_flags(const Node& node) {
  return (node.casts_shadow ? kCastsShadow : 0U) | (node.receives_shadow ? kReceivesShadow : 0U) |
         (node.visible ? kVisible : 0U);
}

std::shared_ptr<const MeshPose> pose_of(const Scene& scene, const Node& node,
                                        const glm::dmat4& world_from_object,
                                        const std::vector<glm::dmat4>& world_from_node) {
  MeshPose pose{world_from_object, {}, node.weights};
  if (node.skin >= 0)
    pose.world_from_bind = joint_matrices(scene.skins[static_cast<std::size_t>(node.skin)], world_from_node);
  return std::make_shared<const MeshPose>(std::move(pose));
}

// Every instance of every primitive.
struct PlacedParts {
  std::vector<PlacedPart> parts;
  std::vector<std::size_t> nodes;  // of each
};

PlacedParts place_parts(const Scene& scene, const ClusteredMeshes& meshes,
                        const std::vector<glm::dmat4>& world_from_node) {
  const auto default_surface = static_cast<std::uint32_t>(scene.materials.size());
  PlacedParts placed;
  std::uint32_t object = 0;
  for_each_object(scene, world_from_node,
                  [&](const Node& node, std::size_t /*instance*/, const glm::dmat4& world_from_object) {
                    const auto mesh = static_cast<std::size_t>(node.mesh);
                    const auto pose = pose_of(scene, node, world_from_object, world_from_node);
                    for (std::size_t p = 0; p < meshes[mesh].size(); ++p) {
                      const Primitive& primitive = scene.meshes[mesh].primitives[p];
                      PlacedPart part;
                      part.primitive = &primitive;
                      part.clustered = &meshes[mesh][p];
                      part.pose = pose;
                      part.object = object;
                      part.surface = primitive.material < 0 ? default_surface
                                                            : static_cast<std::uint32_t>(primitive.material);
                      part.flags = node_flags(node) | material_flags(scene, primitive.material);
                      placed.parts.push_back(std::move(part));
                      placed.nodes.push_back(static_cast<std::size_t>(&node - scene.nodes.data()));
                    }
                    ++object;
                  });
  return placed;
}

void name_objects(const Scene& scene, const std::vector<glm::dmat4>& world_from_node, Frame& frame) {
  for_each_object(scene, world_from_node,
                  [&](const Node& node, std::size_t instance, const glm::dmat4& world_from_object) {
                    std::string name = node.name.empty()
                                           ? scene.meshes[static_cast<std::size_t>(node.mesh)].name
                                           : node.name;
                    if (!node.node_from_instance.empty()) name += "[" + std::to_string(instance) + "]";
                    frame.object_names.push_back(std::move(name));
                    frame.object_scales.push_back(scale_of(world_from_object));
                  });
}

// Numbers of all that placed parts have.
struct Layout {
  std::size_t clusters = 0, vertices = 0, normals = 0, uvs[2] = {0, 0}, colors = 0, tangents = 0;
};

// Gives every placed part its run of clusters and vertices.
Layout lay_out(std::vector<PlacedPart>& placed) {
  Layout all;
  const auto take = [](std::size_t& next, std::size_t count, bool present) {
    if (!present) return kNoStream;
    const auto first = static_cast<std::uint32_t>(next);
    next += count;
    return first;
  };
  for (PlacedPart& p : placed) {
    const Primitive& primitive = *p.primitive;
    const std::size_t count = p.clustered->source_vertices.size();
    p.first_cluster = static_cast<std::uint32_t>(all.clusters);
    p.first_vertex = static_cast<std::uint32_t>(all.vertices);
    all.clusters += p.clustered->clusters.size();
    all.vertices += count;
    p.streams.normal = take(all.normals, count, !primitive.normals.empty());
    for (std::size_t set = 0; set < 2; ++set)
      p.streams.uv[set] = take(all.uvs[set], count, !primitive.uv[set].empty());
    p.streams.color = take(all.colors, count, !primitive.colors.empty());
    p.streams.tangent = take(all.tangents, count, !primitive.tangents.empty());
  }
  return all;
}

void size_arrays(const Layout& all, Frame& frame) {
  // Kernels load whole vectors, and lanes without a stream read its first cluster's worth.
  constexpr std::size_t kReadable = kVerticesPerCluster + 16;
  const auto size = [](auto& values, std::size_t count) {
    using Value = typename std::remove_reference_t<decltype(values)>::value_type;
    values.resize(count + kReadable);
    std::fill(values.end() - kReadable, values.end(), Value(0));
  };
  size(frame.positions_ws, all.vertices);
  size(frame.normals_ws, all.normals);
  for (std::size_t set = 0; set < 2; ++set) size(frame.uvs[set], all.uvs[set]);
  size(frame.colors, all.colors);
  size(frame.tangents_ws, all.tangents);
  frame.clusters.resize(all.clusters);
  frame.streams.resize(all.clusters);
  frame.corners.resize(all.clusters * kTrianglesPerCluster);
}

// A run of a part's clusters and the vertices that are theirs: what one thread writes at a time, so that one large skin is
// posed by all of them.
struct PartRange {
  const PlacedPart* part;
  std::size_t first_cluster, cluster_count;
};

std::vector<PartRange> split(const std::vector<const PlacedPart*>& parts) {
  constexpr std::size_t kClusters = 16;
  std::vector<PartRange> ranges;
  for (const PlacedPart* part : parts) {
    const std::size_t clusters = part->clustered->clusters.size();
    for (std::size_t first = 0; first < clusters; first += kClusters)
      ranges.push_back({part, first, std::min(kClusters, clusters - first)});
  }
  return ranges;
}

// Of reliefs: what each instance spans of their pictures.
void find_relief_charts(const std::vector<PlacedPart>& placed, Frame& frame) {
  for (const PlacedPart& part : placed) {
    if ((part.flags & kRelief) == 0) continue;
    frame.relief_charts.resize(frame.clusters.size());
    const ReliefBinding& relief = frame.surfaces[part.surface].relief;
    const std::array<float, 6>& m = relief.uv_from_mesh_uv;
    constexpr float kEndless = std::numeric_limits<float>::infinity();
    TextureRectangle chart = {kEndless, kEndless, -kEndless, -kEndless};
    for (const glm::vec2& uv : part.primitive->uv[static_cast<std::size_t>(relief.uv_set)]) {
      const float u = m[0] * uv.x + m[1] * uv.y + m[2], v = m[3] * uv.x + m[4] * uv.y + m[5];
      chart = {std::min(chart.low_u, u), std::min(chart.low_v, v), std::max(chart.high_u, u),
               std::max(chart.high_v, v)};
    }
    std::fill_n(frame.relief_charts.begin() + part.first_cluster, part.clustered->clusters.size(), chart);
  }
}

class PartWriter {
 public:
  PartWriter(const PartRange& range, Frame& frame)
      : placed_(*range.part),
        first_cluster_(range.first_cluster),
        cluster_count_(range.cluster_count),
        frame_(frame),
        is_mirrored_(is_mirroring(placed_.pose->world_from_object)) {
    const std::vector<ClusteredPrimitive::Extent>& clusters = placed_.clustered->clusters;
    const ClusteredPrimitive::Extent& last = clusters[first_cluster_ + cluster_count_ - 1];
    first_vertex_ = clusters[first_cluster_].first_vertex;
    end_vertex_ = std::size_t{last.first_vertex} + last.vertex_count;
  }

  void write() {
    write_vertices();
    write_attributes();
    write_clusters();
  }
  /// What another pose changes.
  void rewrite() {
    write_vertices();
    write_clusters();
  }

 private:
  void write_vertices() {
    const Primitive& primitive = *placed_.primitive;
    const std::vector<std::uint32_t>& source = placed_.clustered->source_vertices;
    VertexPoser poser(primitive, *placed_.pose);
    const bool has_normals = placed_.streams.normal != kNoStream;
    const bool has_tangents = placed_.streams.tangent != kNoStream;
    for (std::size_t i = first_vertex_; i < end_vertex_; ++i) {
      poser.select(source[i]);
      frame_.positions_ws[placed_.first_vertex + i] = glm::vec3(poser.position_ws());
      if (has_normals) frame_.normals_ws[placed_.streams.normal + i] = glm::vec3(poser.normal_ws());
      if (!has_tangents) continue;
      // The bitangent is sign · cross(normal, tangent); a mirrored instance turns the cross product round.
      const float sign = primitive.tangents[source[i]].w;
      frame_.tangents_ws[placed_.streams.tangent + i] =
          glm::vec4(glm::vec3(poser.tangent_ws()), is_mirrored_ ? -sign : sign);
    }
  }

  void write_attributes() {
    const Primitive& primitive = *placed_.primitive;
    const std::vector<std::uint32_t>& source = placed_.clustered->source_vertices;
    for (std::size_t set = 0; set < 2; ++set) {
      if (placed_.streams.uv[set] == kNoStream) continue;
      for (std::size_t i = first_vertex_; i < end_vertex_; ++i)
        frame_.uvs[set][placed_.streams.uv[set] + i] = primitive.uv[set][source[i]];
    }
    if (placed_.streams.color == kNoStream) return;
    for (std::size_t i = first_vertex_; i < end_vertex_; ++i)
      frame_.colors[placed_.streams.color + i] = primitive.colors[source[i]];
  }

  void write_clusters() {
    const ClusteredPrimitive& clustered = *placed_.clustered;
    for (std::size_t c = first_cluster_; c < first_cluster_ + cluster_count_; ++c) {
      const ClusteredPrimitive::Extent& extent = clustered.clusters[c];
      const std::size_t at = placed_.first_cluster + c;
      Cluster& cluster = frame_.clusters[at];
      cluster.first_vertex = placed_.first_vertex + extent.first_vertex;
      cluster.vertex_count = extent.vertex_count;
      cluster.triangle_count = extent.triangle_count;
      cluster.flags = placed_.flags;
      cluster.material = placed_.surface;
      cluster.object = placed_.object;
      find_bounds(cluster);
      const auto shifted = [&](std::uint32_t first) {
        return first == kNoStream ? first : first + extent.first_vertex;
      };
      frame_.streams[at] = {shifted(placed_.streams.normal),
                            {shifted(placed_.streams.uv[0]), shifted(placed_.streams.uv[1])},
                            shifted(placed_.streams.color),
                            shifted(placed_.streams.tangent)};
      const std::uint32_t* from = clustered.corners.data() + c * kTrianglesPerCluster;
      std::uint32_t* to = frame_.corners.data() + at * kTrianglesPerCluster;
      // A mirroring instance would turn its triangles' fronts to the back.
      const auto turned = [](std::uint32_t k) {
        return (k & 0xFFU) | (k >> 8U & 0xFF00U) | (k & 0xFF00U) << 8U;
      };
      for (std::uint32_t t = 0; t < kTrianglesPerCluster; ++t)
        to[t] = is_mirrored_ ? turned(from[t]) : from[t];
    }
  }

  void find_bounds(Cluster& cluster) const {
    const glm::vec3* first = frame_.positions_ws.data() + cluster.first_vertex;
    glm::vec3 low = *first, high = *first;
    for (std::size_t i = 1; i < cluster.vertex_count; ++i) {
      low = glm::min(low, first[i]);
      high = glm::max(high, first[i]);
    }
    for (int k = 0; k < 3; ++k) cluster.low_ws[k] = low[k], cluster.high_ws[k] = high[k];
  }

  const PlacedPart& placed_;
  std::size_t first_cluster_, cluster_count_;
  std::size_t first_vertex_, end_vertex_;  // of the clustered primitive
  Frame& frame_;
  bool is_mirrored_;
};

Bounds bounds_of(const std::vector<Cluster>& clusters) {
  Bounds bounds;
  for (const Cluster& c : clusters) {
    const glm::vec3 low(c.low_ws[0], c.low_ws[1], c.low_ws[2]);
    const glm::vec3 high(c.high_ws[0], c.high_ws[1], c.high_ws[2]);
    bounds.low = bounds.is_empty ? low : glm::min(bounds.low, low);
    bounds.high = bounds.is_empty ? high : glm::max(bounds.high, high);
    bounds.is_empty = false;
  }
  return bounds;
}

}  // namespace

namespace {

// Whether a skin has a hold on it.
bool is_pulled(const Mesh& mesh) {
  return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                     [](const Primitive& primitive) { return primitive.influences > 0; });
}

}  // namespace

std::size_t count_clusters(const Scene& scene, const ClusteredMeshes& meshes) {
  std::size_t count = 0;
  for (const Node& node : scene.nodes) {
    if (node.mesh < 0) continue;
    std::size_t of_mesh = 0;
    for (const ClusteredPrimitive& part : meshes[static_cast<std::size_t>(node.mesh)])
      of_mesh += part.clusters.size();
    count += of_mesh * std::max<std::size_t>(node.node_from_instance.size(), 1);
  }
  return count;
}

void for_each_object(const Scene& scene, const std::vector<glm::dmat4>& world_from_node,
                     const std::function<void(const Node& node, std::size_t instance,
                                              const glm::dmat4& world_from_object)>& visit) {
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    const Node& node = scene.nodes[n];
    if (node.mesh < 0) continue;
    if (node.skin >= 0 && is_pulled(scene.meshes[static_cast<std::size_t>(node.mesh)])) {
      const Skin& skin = scene.skins[static_cast<std::size_t>(node.skin)];
      visit(node, 0,
            world_from_node[static_cast<std::size_t>(skin.joints.front())] * skin.joint_from_bind.front());
      continue;
    }
    if (node.node_from_instance.empty()) visit(node, 0, world_from_node[n]);
    for (std::size_t k = 0; k < node.node_from_instance.size(); ++k)
      visit(node, k, world_from_node[n] * node.node_from_instance[k]);
  }
}

bool is_mirroring(const glm::dmat4& world_from_object) {
  return glm::determinant(glm::dmat3(world_from_object)) < 0;
}

void flatten_meshes(const Scene& scene, const ClusteredMeshes& meshes,
                    const std::vector<glm::dmat4>& world_from_node, const TaskPool& pool, Frame& frame) {
  PlacedParts placed = place_parts(scene, meshes, world_from_node);
  name_objects(scene, world_from_node, frame);
  size_arrays(lay_out(placed.parts), frame);
  std::vector<const PlacedPart*> parts;
  for (const PlacedPart& part : placed.parts) parts.push_back(&part);
  const std::vector<PartRange> ranges = split(parts);
  pool.for_each(ranges.size(), [&](std::size_t i, int) { PartWriter(ranges[i], frame).write(); });
  find_relief_charts(placed.parts, frame);
  frame.bounds = bounds_of(frame.clusters);
  frame.has_environment = scene.environment.has_value();
  frame.has_blending = std::any_of(frame.clusters.begin(), frame.clusters.end(),
                                   [](const Cluster& c) { return (c.flags & kAlphaBlend) != 0; });
  frame.has_transmission = std::any_of(frame.clusters.begin(), frame.clusters.end(), [](const Cluster& c) {
    return (c.flags & kTransmissive) != 0 && (c.flags & kVisible) != 0;
  });
  frame.has_blended_casters = std::any_of(frame.clusters.begin(), frame.clusters.end(), is_blended_caster);
  frame.all_receive_shadows = std::all_of(frame.clusters.begin(), frame.clusters.end(),
                                          [](const Cluster& c) { return (c.flags & kReceivesShadow) != 0; });
  const std::vector<bool> moves = moving_nodes(scene);
  for (std::size_t i = 0; i < placed.parts.size() && !moves.empty(); ++i) {
    if (moves[placed.nodes[i]]) frame.moving_parts.push_back(std::move(placed.parts[i]));
  }
}

void let_move(const Scene& scene, const ClusteredMeshes& meshes, const std::vector<bool>& moves,
              Frame& frame) {
  PlacedParts placed = place_parts(scene, meshes, world_from_nodes(scene));
  lay_out(placed.parts);
  std::vector<PlacedPart> moving;
  auto known = frame.moving_parts.begin();
  for (std::size_t i = 0; i < placed.parts.size(); ++i) {
    PlacedPart& part = placed.parts[i];
    if (known != frame.moving_parts.end() && known->object == part.object) {
      moving.push_back(std::move(*known++));
    } else if (moves[placed.nodes[i]]) {
      // What is noted about its clusters holds when they are written anew.
      if (!part.clustered->clusters.empty()) part.flags = frame.clusters[part.first_cluster].flags;
      moving.push_back(std::move(part));
    }
  }
  frame.moving_parts = std::move(moving);
}

Reposed repose_meshes(const Scene& scene, const std::vector<glm::dmat4>& world_from_node,
                      const TaskPool& pool, Frame& frame) {
  std::vector<const PlacedPart*> moved;
  if (frame.moving_parts.empty()) return {};
  auto part = frame.moving_parts.begin();
  std::uint32_t object = 0;
  for_each_object(scene, world_from_node,
                  [&](const Node& node, std::size_t /*instance*/, const glm::dmat4& world_from_object) {
                    if (part == frame.moving_parts.end() || part->object != object++) return;
                    const auto pose = pose_of(scene, node, world_from_object, world_from_node);
                    frame.object_scales[part->object] = scale_of(world_from_object);
                    const std::size_t parts =
                        scene.meshes[static_cast<std::size_t>(node.mesh)].primitives.size();
                    for (std::size_t p = 0; p < parts; ++p, ++part) {
                      if (*part->pose == *pose) continue;
                      part->pose = pose;
                      moved.push_back(&*part);
                    }
                  });
  const std::vector<PartRange> ranges = split(moved);
  pool.for_each(ranges.size(), [&](std::size_t i, int) { PartWriter(ranges[i], frame).rewrite(); });
  Reposed reposed;
  reposed.parts = moved.size();
  for (const PlacedPart* rewritten : moved) {
    reposed.vertices += rewritten->clustered->source_vertices.size();
    reposed.moves_casters |= (rewritten->flags & kCastsShadow) != 0;
  }
  if (!moved.empty()) frame.bounds = bounds_of(frame.clusters);
  return reposed;
}

}  // namespace laterna::frame
