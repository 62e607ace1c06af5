#include "trace/ray_scene.h"

#include <embree3/rtcore.h>

#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

#include "frame/surface_alpha.h"

namespace laterna::trace {
namespace {

// Embree hands its context to filters; ours says which triangle the ray leaves, and where panes are noted.
struct Context {
  RTCIntersectContext embree;
  TriangleId own;
  std::vector<RayScene::Pane>* panes;
};

// Some of a frame's triangles as Embree sees them.
class EmbreeScene {
 public:
  EmbreeScene(RTCDevice device, const frame::Frame& frame, bool blended)
      : frame_(frame), blended_(blended), scene_(rtcNewScene(device)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    add_triangles(device);
    rtcCommitScene(scene_);
  }
  ~EmbreeScene() { rtcReleaseScene(scene_); }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // Whether anything stops the ray. Panes are noted and stop nothing.
  [[nodiscard]] bool stops(RTCRay& ray, TriangleId own, std::vector<RayScene::Pane>* panes) const {
    Context context;
    rtcInitIntersectContext(&context.embree);
    context.own = own;
    context.panes = panes;
    rtcOccluded1(scene_, &context.embree, &ray);
    return ray.tfar == -std::numeric_limits<float>::infinity();
  }

  [[nodiscard]] std::optional<RayScene::Hit> find_nearest(const RTCRay& ray, TriangleId own) const {
    Context context;
    rtcInitIntersectContext(&context.embree);
    context.own = own;
    context.panes = nullptr;
    RTCRayHit query{};
    query.ray = ray;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context.embree, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return RayScene::Hit{ids_[query.hit.primID], query.hit.u, query.hit.v, query.ray.tfar};
  }

 private:
  void add_triangles(RTCDevice device) {
    const std::size_t vertex_count = frame_.positions_ws.size();
    std::vector<std::uint32_t> indices;
    for (std::uint32_t c = 0; c < frame_.clusters.size(); ++c) {
      const Cluster& cluster = frame_.clusters[c];
      if (!(blended_ ? is_blended_caster(cluster) : is_opaque_caster(cluster))) continue;
      for (std::uint32_t t = 0; t < cluster.triangle_count; ++t) {
        const TriangleId id = c << kTriangleBits | t;
        const std::uint32_t packed = frame_.corners[id];
        for (unsigned k = 0; k < 3; ++k) indices.push_back(cluster.first_vertex + (packed >> (8 * k) & 255U));
        ids_.push_back(id);
      }
    }
    if (ids_.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), vertex_count));
    auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), ids_.size()));
    std::copy(frame_.positions_ws.begin(), frame_.positions_ws.end(), vertices);
    std::copy(indices.begin(), indices.end(), corners);
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryOccludedFilterFunction(geometry, &filter_hits);
    rtcSetGeometryIntersectFilterFunction(geometry, &filter_hits);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

  // Takes back hits on the ray's own triangle, in the holes of cut-outs, and on panes.
  static void filter_hits(const RTCFilterFunctionNArguments* arguments) {
    const auto& self = *static_cast<const EmbreeScene*>(arguments->geometryUserPtr);
    const auto& context = *reinterpret_cast<const Context*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
      if (arguments->valid[i] == 0) continue;
      const TriangleId id = self.ids_[RTCHitN_primID(arguments->hit, arguments->N, i)];
      const float u = RTCHitN_u(arguments->hit, arguments->N, i);
      const float v = RTCHitN_v(arguments->hit, arguments->N, i);
      if (self.blended_ && id != context.own) context.panes->push_back({id, u, v});
      if (self.blended_ || id == context.own || frame::is_hole(self.frame_, id, u, v))
        arguments->valid[i] = 0;
    }
  }

  const frame::Frame& frame_;
  bool blended_;
  RTCScene scene_;
  std::vector<TriangleId> ids_;  // by Embree's primitive
};

RTCRay make_ray(const glm::vec3& origin, const glm::vec3& direction, float near, float far) {
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tnear = near;
  ray.tfar = far;
  ray.mask = 0xFFFFFFFFU;
  return ray;
}

}  // namespace

struct RayScene::Implementation {
  explicit Implementation(const frame::Frame& frame)
      : device(rtcNewDevice("isa=sse4.2")),
        opaque(device.get(), frame, false),
        blended(device.get(), frame, true) {}

  struct Release {
    void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
  };
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device;
  EmbreeScene opaque, blended;
};

RayScene::RayScene(const frame::Frame& frame) : implementation_(std::make_unique<Implementation>(frame)) {}
RayScene::~RayScene() = default;

bool RayScene::is_blocked(const glm::vec3& origin_ws, const glm::vec3& direction_ws, float near, float far,
                          TriangleId own) const {
  RTCRay ray = make_ray(origin_ws, direction_ws, near, far);
  return implementation_->opaque.stops(ray, own, nullptr);
}

std::optional<RayScene::Hit> RayScene::find_nearest(const glm::vec3& origin_ws, const glm::vec3& direction_ws,
                                                    float near, float far, TriangleId own) const {
  return implementation_->opaque.find_nearest(make_ray(origin_ws, direction_ws, near, far), own);
}

void RayScene::find_panes(const glm::vec3& origin_ws, const glm::vec3& direction_ws, float near, float far,
                          TriangleId own, std::vector<Pane>& panes) const {
  RTCRay ray = make_ray(origin_ws, direction_ws, near, far);
  static_cast<void>(implementation_->blended.stops(ray, own, &panes));
}

}  // namespace laterna::trace
