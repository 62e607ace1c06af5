// One instant of a scene, flat: every instance in world space, an array for each thing that vertices have. What every later stage reads.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/aligned_vector.h"
#include "base/task_pool.h"
#include "base/triangle_clusters.h"
#include "frame/cluster_builder.h"
#include "frame/slide_lens.h"
#include "frame/texture_library.h"
#include "frame/vertex_pose.h"
#include "laterna/scene.h"

namespace laterna::frame {

struct LampTable;     // frame/lamp_table.h
struct ReliefField;   // frame/relief_field.h
struct SurfaceLobes;  // frame/surface_lobes.h

/// A picture as a material uses it.
struct TextureBinding {
  const image::MipChain* chain = nullptr;  ///< null: no texture
  Sampler sampler;
  int uv_set = 0;
  std::array<float, 6> uv_from_mesh_uv = {1, 0, 0, 0, 1, 0};

  /// Whether both lie at the same place of a surface, as a material's pictures mostly do.
  [[nodiscard]] bool lies_like(const TextureBinding& other) const {
    return uv_set == other.uv_set && uv_from_mesh_uv == other.uv_from_mesh_uv;
  }
};

TextureBinding bind(const Texture& texture, image::MipUse use, const TextureLibrary& library);

/// A SurfaceLayer with its picture found.
struct LayerBinding {
  TextureBinding texture;
  bool once = false;
  int decal = -1;  ///< index into Frame::decals
  bool occluded = true;
  std::array<float, 3> color = {1, 1, 1};
  float opacity = 1;
  BlendMode blend = BlendMode::over;
};

/// A LightMap with its pictures found.
struct LightMapBinding {
  TextureBinding front, back;
  float intensity = 1;
};

/// A Relief with its heights found.
struct ReliefBinding {
  const ReliefField* field = nullptr;  ///< null: flat
  int uv_set = 0;
  std::array<float, 6> uv_from_mesh_uv = {1, 0, 0, 0, 1, 0};
  float depth = 0;  ///< metres
  bool self_shadow = true, cut_edges = false;
};

/// A Material with its pictures found.
struct Surface {
  std::array<float, 4> base_color = {1, 1, 1, 1};
  std::array<float, 3> emissive = {0, 0, 0};
  float metallic = 1, roughness = 1, normal_scale = 1, occlusion_strength = 1, alpha_cutoff = 0.5F;
  AlphaMode alpha_mode = AlphaMode::opaque;
  bool double_sided = false, unlit = false;
  TextureBinding base_color_texture, metallic_roughness_texture, normal_texture, occlusion_texture,
      emissive_texture;
  std::vector<LayerBinding> layers;
  LightMapBinding light_map;
  std::shared_ptr<const SurfaceLobes> lobes;  ///< null: none
  ReliefBinding relief;
  std::shared_ptr<const Mirror> mirror;  ///< null: none
};

/// A light where it stands. Colour and intensity stay in the scene's Light.
struct PlacedLight {
  const Light* light = nullptr;
  int node = -1;
  Pose pose;
  View view;                      ///< projector: its frustum, with the slide's aspect; with a lens its beam
  std::optional<SlideLens> lens;  ///< of a projector with distortion
  double intensity = 0;  ///< candela on the axis (lamps: at their peak), or lux: what `lumens` comes to
  const image::MipChain* slide = nullptr;  ///< null: plain white
  const LampTable* lamp = nullptr;         ///< null: no measured lamp
};

struct PlacedCamera {
  const Camera* camera = nullptr;
  int node = -1;
  Pose pose;
};

/// A photograph with its picture found.
struct PlacedPhotograph {
  const Photograph* photograph = nullptr;
  const image::MipChain* picture = nullptr;
};

/// Streams that not every cluster has; kNoStream where it is missing, otherwise the index of its first vertex.
struct ClusterStreams {
  std::uint32_t normal = 0, uv[2] = {0, 0}, color = 0, tangent = 0;
};
inline constexpr std::uint32_t kNoStream = 0xFFFFFFFFU;

/// A rectangle in a picture.
struct TextureRectangle {
  float low_u = 0, low_v = 0, high_u = 0, high_v = 0;
};

/// Triangle ids are cluster · 128 + triangle, and kernels gather with 32-bit signed indices.
inline constexpr std::size_t kMaxClusters = std::size_t{1} << 24U;

struct Bounds {
  glm::vec3 low{0}, high{0};
  bool is_empty = true;
};

/// An instance of a primitive that may move: what it was made of, its pose, and its place in the frame's arrays.
struct PlacedPart {
  const Primitive* primitive = nullptr;
  const ClusteredPrimitive* clustered = nullptr;
  std::shared_ptr<const MeshPose> pose;  ///< shared by the primitives of an object
  std::uint32_t object = 0, surface = 0, flags = 0;
  std::uint32_t first_cluster = 0, first_vertex = 0;
  ClusterStreams streams;
};

/// What a change of poses has made anew.
struct Reposed {
  std::size_t parts = 0, vertices = 0;
  bool moves_casters = false;
};

class Frame {
 public:
  /// The scene must have passed validate(), and outlive the frame. `textures` and `meshes` are the scene's.
  /// Error: an instance lies farther out than kMaxCoordinate, or there are more than kMaxClusters clusters.
  static Result<Frame> build(const Scene& scene, std::shared_ptr<const TextureLibrary> textures,
                             const ClusteredMeshes& meshes, const TaskPool& pool);

  /// Takes the scene's nodes and morph weights as they are now: instances whose pose is another than before get new vertices
  /// and bounds; everything else stays. The result is the frame that build() would make. Error: as build(); the frame then
  /// holds the new pose all the same.
  Result<Reposed> repose(const Scene& scene, const TaskPool& pool);

  /// Materials as the scene has them now.
  void make_surfaces(const Scene& scene);

  /// Puts lights and cameras where the scene has them now; the rest of the frame stays.
  void place_lights_and_cameras(const Scene& scene);

  [[nodiscard]] TriangleClusters geometry() const { return {positions_ws.data(), corners.data(), clusters}; }
  [[nodiscard]] std::size_t triangle_count() const;
  /// Corner 0, 1 or 2 of a triangle.
  [[nodiscard]] glm::vec3 corner_ws(TriangleId id, unsigned corner) const {
    return positions_ws[clusters[cluster_of(id)].first_vertex + (corners[id] >> (8 * corner) & 255U)];
  }

  // Vertices, one entry per cluster vertex, readable 16 entries beyond the last. Kernels read them one by one, at corners of
  // triangles all over: what belongs together lies together.
  AlignedVector<glm::vec3> positions_ws, normals_ws;
  AlignedVector<glm::vec2> uvs[2];
  AlignedVector<glm::vec4> colors;       // linear r, g, b, alpha
  AlignedVector<glm::vec4> tangents_ws;  // w: the bitangent is w · cross(normal, tangent)

  AlignedVector<std::uint32_t> corners;  // kTrianglesPerCluster per cluster
  std::vector<Cluster> clusters;
  std::vector<ClusterStreams> streams;  // one per cluster
  // One per cluster: what of its relief's picture the primitive's instance spans. Empty: no surface has a relief.
  std::vector<TextureRectangle> relief_charts;

  std::vector<Surface> surfaces;          // scene materials, then glTF's default
  std::vector<std::string> object_names;  // one per instance of a mesh
  std::vector<float> object_scales;       // metres per unit of the mesh, the mean of all directions
  std::vector<PlacedLight> lights;
  // What lights refer to; one per distribution, however many lights have it.
  std::map<std::shared_ptr<const LightDistribution>, std::shared_ptr<const LampTable>> lamps;
  std::vector<PlacedCamera> cameras;
  std::vector<PlacedPhotograph> photographs;
  std::vector<PlacedLight> decals;  // projectors whose slides layers show: slides with alpha
  Bounds bounds;
  std::vector<PlacedPart> moving_parts;  // of nodes that clips move; in the order of objects
  bool has_blending = false;
  bool has_blended_casters = false;
  bool all_receive_shadows = true;
  bool has_environment = false;
  bool has_transmission = false;
  bool has_mirrors = false;
  std::shared_ptr<const TextureLibrary> textures;
};

}  // namespace laterna::frame
