#include "trace/ray_scene.h"

#include <embree3/rtcore.h>

#include <array>
#include <limits>
#include <vector>

#include "frame/surface_alpha.h"

namespace laterna::trace {
namespace {

// Embree hands its context to filters; ours says which triangle the ray leaves.
struct Context {
  RTCIntersectContext embree;
  TriangleId own;
};

}  // namespace

struct RayScene::Implementation {
  explicit Implementation(const frame::Frame& f)
      : frame(f), device(rtcNewDevice("isa=sse4.2")), scene(rtcNewScene(device)) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    add_triangles();
    rtcCommitScene(scene);
  }
  ~Implementation() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void add_triangles() {
    const std::size_t vertex_count = frame.x_ws.size();
    std::vector<std::uint32_t> indices;
    for (std::uint32_t c = 0; c < frame.clusters.size(); ++c) {
      const Cluster& cluster = frame.clusters[c];
      if ((cluster.flags & kCastsShadow) == 0) continue;
      for (std::uint32_t t = 0; t < cluster.triangle_count; ++t) {
        const TriangleId id = c << kTriangleBits | t;
        const std::uint32_t packed = frame.corners[id];
        for (unsigned k = 0; k < 3; ++k) indices.push_back(cluster.first_vertex + (packed >> (8 * k) & 255U));
        ids.push_back(id);
      }
    }
    if (ids.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertex_count));
    auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), ids.size()));
    for (std::size_t i = 0; i < vertex_count; ++i) {
      vertices[3 * i] = frame.x_ws[i];
      vertices[3 * i + 1] = frame.y_ws[i];
      vertices[3 * i + 2] = frame.z_ws[i];
    }
    std::copy(indices.begin(), indices.end(), corners);
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryOccludedFilterFunction(geometry, &filter_hits);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }

  // Takes back hits on the ray's own triangle and in the holes of cut-outs.
  static void filter_hits(const RTCFilterFunctionNArguments* arguments) {
    const auto& self = *static_cast<const Implementation*>(arguments->geometryUserPtr);
    const TriangleId own = reinterpret_cast<const Context*>(arguments->context)->own;
    for (unsigned i = 0; i < arguments->N; ++i) {
      if (arguments->valid[i] == 0) continue;
      const TriangleId id = self.ids[RTCHitN_primID(arguments->hit, arguments->N, i)];
      const float u = RTCHitN_u(arguments->hit, arguments->N, i);
      const float v = RTCHitN_v(arguments->hit, arguments->N, i);
      if (id == own || self.is_hole(id, u, v)) arguments->valid[i] = 0;
    }
  }

  [[nodiscard]] bool is_hole(TriangleId id, float b, float c) const {
    const Cluster& cluster = frame.clusters[cluster_of(id)];
    if ((cluster.flags & (kAlphaMask | kAlphaBlend)) == 0) return false;
    return frame::alpha_at(frame, id, b, c) < frame::cutoff_of(frame.surfaces[cluster.material]);
  }

  const frame::Frame& frame;
  RTCDevice device;
  RTCScene scene;
  std::vector<TriangleId> ids;  // by Embree's primitive
};

RayScene::RayScene(const frame::Frame& frame) : implementation_(std::make_unique<Implementation>(frame)) {}
RayScene::~RayScene() = default;

bool RayScene::is_blocked(const glm::vec3& origin_ws, const glm::vec3& direction_ws, float near, float far,
                          TriangleId own) const {
  Context context;
  rtcInitIntersectContext(&context.embree);
  context.own = own;
  RTCRay ray{};
  ray.org_x = origin_ws.x, ray.org_y = origin_ws.y, ray.org_z = origin_ws.z;
  ray.dir_x = direction_ws.x, ray.dir_y = direction_ws.y, ray.dir_z = direction_ws.z;
  ray.tnear = near;
  ray.tfar = far;
  ray.mask = 0xFFFFFFFFU;
  rtcOccluded1(implementation_->scene, &context.embree, &ray);
  return ray.tfar == -std::numeric_limits<float>::infinity();
}

RayScene::Hit RayScene::nearest(const glm::vec3& origin_ws, const glm::vec3& direction_ws, float near,
                                float far) const {
  Context context;
  rtcInitIntersectContext(&context.embree);
  context.own = kNoTriangle;
  RTCRayHit hit{};
  hit.ray.org_x = origin_ws.x, hit.ray.org_y = origin_ws.y, hit.ray.org_z = origin_ws.z;
  hit.ray.dir_x = direction_ws.x, hit.ray.dir_y = direction_ws.y, hit.ray.dir_z = direction_ws.z;
  hit.ray.tnear = near;
  hit.ray.tfar = far;
  hit.ray.mask = 0xFFFFFFFFU;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(implementation_->scene, &context.embree, &hit);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {implementation_->ids[hit.hit.primID], hit.ray.tfar};
}

}  // namespace laterna::trace
