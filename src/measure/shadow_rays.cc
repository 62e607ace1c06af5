#include "measure/shadow_rays.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace laterna::measure {
namespace {

struct Ray {
  glm::vec3 direction_ws{0};
  float length = 0;
};

// As far as the light, or its near plane: what is nearer to a projector casts nothing.
Ray ray_to(const frame::PlacedLight& light, const glm::dvec3& point_ws) {
  const glm::dvec3 direction = direction_to(light, point_ws);
  const glm::dvec3 from_light = point_ws - light.pose.position_ws;
  const double along = glm::dot(from_light, light.pose.forward_ws());
  double length = is_parallel(light) ? std::numeric_limits<double>::infinity() : glm::length(from_light);
  const bool has_frustum = light.light->type == LightType::projector ||
                           (light.light->type == LightType::directional && !light.light->fit);
  if (has_frustum) {
    const double near =
        light.light->type == LightType::projector ? light.view.projection.near : light.light->projection.near;
    if (is_parallel(light)) {
      length = along - near;
    } else {
      length = along > near ? length * (1 - near / along) : 0;
    }
  }
  return {glm::vec3(direction), static_cast<float>(length)};
}

}  // namespace

bool is_parallel(const frame::PlacedLight& light) {
  return light.light->type == LightType::directional ||
         (light.light->type == LightType::projector && light.view.projection.is_orthographic);
}

glm::dvec3 direction_to(const frame::PlacedLight& light, const glm::dvec3& point_ws) {
  if (is_parallel(light)) return -light.pose.forward_ws();
  const glm::dvec3 way = light.pose.position_ws - point_ws;
  const double length = glm::length(way);
  return length > 0 ? way / length : glm::dvec3(0);
}

Result<std::unique_ptr<const ShadowRays>> ShadowRays::create(Scene scene, const TaskPool& pool) {
  std::unique_ptr<ShadowRays> made(new ShadowRays(std::move(scene)));
  Result<frame::TextureLibrary> textures = frame::TextureLibrary::load(made->scene_, pool);
  if (!textures) return tl::unexpected(std::move(textures.error()));
  auto shared = std::make_shared<const frame::TextureLibrary>(std::move(*textures));
  Result<frame::Frame> built =
      frame::Frame::build(made->scene_, std::move(shared), frame::build_clusters(made->scene_, pool), pool);
  if (!built) return tl::unexpected(std::move(built.error()));
  made->frame_ = std::move(*built);
  made->rays_ = std::make_unique<trace::RayScene>(made->frame_);
  return made;
}

const frame::PlacedLight* ShadowRays::find(const std::string& light) const {
  for (const frame::PlacedLight& placed : frame_.lights) {
    if (placed.light->name == light) return &placed;
  }
  return nullptr;
}

bool ShadowRays::is_blocked(const frame::PlacedLight& light, const glm::dvec3& point_ws, double near,
                            double far) const {
  const Ray ray = ray_to(light, point_ws);
  const auto start = static_cast<float>(near);
  const float end = std::min(ray.length, static_cast<float>(far));
  return end > start && rays_->is_blocked(glm::vec3(point_ws), ray.direction_ws, start, end, kNoTriangle);
}

}  // namespace laterna::measure
