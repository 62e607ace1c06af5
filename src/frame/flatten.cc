#include "frame/flatten.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace laterna::frame {
namespace {

/// One instance of a primitive, with its place in the frame's arrays.
struct PlacedPart {
  const Primitive* primitive;
  const ClusteredPrimitive* clustered;
  glm::dmat4 world_from_object;
  std::uint32_t object;
  std::uint32_t surface;
  std::uint32_t flags;
  std::uint32_t first_cluster = 0, first_vertex = 0;
  ClusterStreams streams;
};

std::uint32_t material_flags(const Scene& scene, int material) {
  if (material < 0) return 0;
  const Material& m = scene.materials[static_cast<std::size_t>(material)];
  std::uint32_t flags = m.double_sided ? kDoubleSided : 0U;
  if (m.alpha_mode == AlphaMode::mask) flags |= kAlphaMask;
  if (m.alpha_mode == AlphaMode::blend) flags |= kAlphaBlend;
  return flags;
}

std::uint32_t node_flags(const Node& node) {
  return (node.casts_shadow ? kCastsShadow : 0U) | (node.receives_shadow ? kReceivesShadow : 0U) |
         (node.visible ? kVisible : 0U);
}

std::vector<PlacedPart> place_parts(const Scene& scene, const ClusteredMeshes& meshes,
                                    const std::vector<glm::dmat4>& world_from_node, Frame& frame) {
  const auto default_surface = static_cast<std::uint32_t>(scene.materials.size());
  std::vector<PlacedPart> placed;
  for_each_object(
      scene, world_from_node,
      [&](const Node& node, std::size_t instance, const glm::dmat4& world_from_object) {
        const auto object = static_cast<std::uint32_t>(frame.object_names.size());
        const auto mesh = static_cast<std::size_t>(node.mesh);
        std::string name = node.name.empty() ? scene.meshes[mesh].name : node.name;
        if (!node.node_from_instance.empty()) name += "[" + std::to_string(instance) + "]";
        frame.object_names.push_back(std::move(name));
        for (std::size_t p = 0; p < meshes[mesh].size(); ++p) {
          const Primitive& primitive = scene.meshes[mesh].primitives[p];
          placed.push_back(
              {&primitive,
               &meshes[mesh][p],
               world_from_object,
               object,
               primitive.material < 0 ? default_surface : static_cast<std::uint32_t>(primitive.material),
               node_flags(node) | material_flags(scene, primitive.material),
               0,
               0,
               {}});
        }
      });
  return placed;
}

// Gives every placed part its run of clusters and vertices, and sizes the arrays.
void lay_out(std::vector<PlacedPart>& placed, Frame& frame) {
  std::size_t clusters = 0;
  std::size_t vertices = 0;
  std::size_t normals = 0, uvs[2] = {0, 0}, colors = 0, tangents = 0;
  const auto take = [](std::size_t& next, std::size_t count, bool present) {
    if (!present) return kNoStream;
    const auto first = static_cast<std::uint32_t>(next);
    next += count;
    return first;
  };
  for (PlacedPart& p : placed) {
    const Primitive& primitive = *p.primitive;
    const std::size_t count = p.clustered->source_vertices.size();
    p.first_cluster = static_cast<std::uint32_t>(clusters);
    p.first_vertex = static_cast<std::uint32_t>(vertices);
    clusters += p.clustered->clusters.size();
    vertices += count;
    p.streams.normal = take(normals, count, !primitive.normals.empty());
    for (std::size_t set = 0; set < 2; ++set)
      p.streams.uv[set] = take(uvs[set], count, !primitive.uv[set].empty());
    p.streams.color = take(colors, count, !primitive.colors.empty());
    p.streams.tangent = take(tangents, count, !primitive.tangents.empty());
  }
  // Kernels load whole vectors, and lanes without a stream read its first cluster's worth.
  constexpr std::size_t kReadable = kVerticesPerCluster + 16;
  const auto size = [](std::initializer_list<AlignedVector<float>*> arrays, std::size_t count) {
    for (AlignedVector<float>* array : arrays) {
      array->resize(count + kReadable);
      std::fill(array->end() - kReadable, array->end(), 0.0F);
    }
  };
  size({&frame.x_ws, &frame.y_ws, &frame.z_ws}, vertices);
  size({&frame.normal_x_ws, &frame.normal_y_ws, &frame.normal_z_ws}, normals);
  for (std::size_t set = 0; set < 2; ++set) size({&frame.uv_u[set], &frame.uv_v[set]}, uvs[set]);
  size({&frame.color_r, &frame.color_g, &frame.color_b, &frame.color_a}, colors);
  size({&frame.tangent_x_ws, &frame.tangent_y_ws, &frame.tangent_z_ws, &frame.tangent_sign}, tangents);
  frame.clusters.resize(clusters);
  frame.streams.resize(clusters);
  frame.corners.resize(clusters * kTrianglesPerCluster);
}

class PartWriter {
 public:
  PartWriter(const PlacedPart& placed, Frame& frame)
      : placed_(placed),
        frame_(frame),
        normal_matrix_(glm::transpose(glm::inverse(glm::dmat3(placed.world_from_object)))),
        is_mirrored_(is_mirroring(placed.world_from_object)) {}

  void write() {
    write_vertices();
    write_clusters();
  }

 private:
  void write_vertices() {
    const Primitive& primitive = *placed_.primitive;
    const std::vector<std::uint32_t>& source = placed_.clustered->source_vertices;
    const glm::dmat3 linear(placed_.world_from_object);
    const glm::dvec3 offset(placed_.world_from_object[3]);
    for (std::size_t i = 0; i < source.size(); ++i) {
      const glm::dvec3 p = linear * glm::dvec3(primitive.positions[source[i]]) + offset;
      put(frame_.x_ws, frame_.y_ws, frame_.z_ws, placed_.first_vertex + i, p);
    }
    if (placed_.streams.normal != kNoStream) {
      for (std::size_t i = 0; i < source.size(); ++i) {
        put(frame_.normal_x_ws, frame_.normal_y_ws, frame_.normal_z_ws, placed_.streams.normal + i,
            unit(normal_matrix_ * glm::dvec3(primitive.normals[source[i]])));
      }
    }
    for (std::size_t set = 0; set < 2; ++set) {
      if (placed_.streams.uv[set] == kNoStream) continue;
      for (std::size_t i = 0; i < source.size(); ++i) {
        frame_.uv_u[set][placed_.streams.uv[set] + i] = primitive.uv[set][source[i]].x;
        frame_.uv_v[set][placed_.streams.uv[set] + i] = primitive.uv[set][source[i]].y;
      }
    }
    if (placed_.streams.color != kNoStream) write_colors(source);
    if (placed_.streams.tangent != kNoStream) write_tangents(source, linear);
  }

  void write_colors(const std::vector<std::uint32_t>& source) {
    for (std::size_t i = 0; i < source.size(); ++i) {
      const glm::vec4& c = placed_.primitive->colors[source[i]];
      const std::size_t at = placed_.streams.color + i;
      frame_.color_r[at] = c.r, frame_.color_g[at] = c.g, frame_.color_b[at] = c.b, frame_.color_a[at] = c.a;
    }
  }

  void write_tangents(const std::vector<std::uint32_t>& source, const glm::dmat3& linear) {
    for (std::size_t i = 0; i < source.size(); ++i) {
      const glm::vec4& t = placed_.primitive->tangents[source[i]];
      const std::size_t at = placed_.streams.tangent + i;
      put(frame_.tangent_x_ws, frame_.tangent_y_ws, frame_.tangent_z_ws, at, unit(linear * glm::dvec3(t)));
      // The bitangent is sign · cross(normal, tangent); a mirrored instance turns the cross product round.
      frame_.tangent_sign[at] = is_mirrored_ ? -t.w : t.w;
    }
  }

  void write_clusters() {
    const ClusteredPrimitive& clustered = *placed_.clustered;
    for (std::size_t c = 0; c < clustered.clusters.size(); ++c) {
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
    const AlignedVector<float>* axes[3] = {&frame_.x_ws, &frame_.y_ws, &frame_.z_ws};
    for (int k = 0; k < 3; ++k) {
      const float* first = axes[k]->data() + cluster.first_vertex;
      const auto [low, high] = std::minmax_element(first, first + cluster.vertex_count);
      cluster.low_ws[k] = *low;
      cluster.high_ws[k] = *high;
    }
  }

  static glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0, 0, 0);
  }

  static void put(AlignedVector<float>& x, AlignedVector<float>& y, AlignedVector<float>& z, std::size_t i,
                  const glm::dvec3& v) {
    x[i] = static_cast<float>(v.x);
    y[i] = static_cast<float>(v.y);
    z[i] = static_cast<float>(v.z);
  }

  const PlacedPart& placed_;
  Frame& frame_;
  glm::dmat3 normal_matrix_;
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
  std::vector<PlacedPart> placed = place_parts(scene, meshes, world_from_node, frame);
  lay_out(placed, frame);
  pool.for_each(placed.size(), [&](std::size_t i, int) { PartWriter(placed[i], frame).write(); });
  frame.bounds = bounds_of(frame.clusters);
  frame.has_environment = scene.environment.has_value();
  frame.has_blending = std::any_of(frame.clusters.begin(), frame.clusters.end(),
                                   [](const Cluster& c) { return (c.flags & kAlphaBlend) != 0; });
  frame.has_blended_casters = std::any_of(frame.clusters.begin(), frame.clusters.end(), is_blended_caster);
  frame.all_receive_shadows = std::all_of(frame.clusters.begin(), frame.clusters.end(),
                                          [](const Cluster& c) { return (c.flags & kReceivesShadow) != 0; });
}

}  // namespace laterna::frame
