#include "measure/shadow_rays.h"

#include <algorithm>

#include "light/light_rays.h"

namespace laterna::measure {

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
  const light::LightRays to_light(light);
  const auto start = static_cast<float>(near);
  const float end = static_cast<float>(std::min(to_light.length_at(point_ws), far));
  return end > start && rays_->is_blocked(glm::vec3(point_ws), glm::vec3(to_light.toward_at(point_ws)), start,
                                          end, kNoTriangle);
}

}  // namespace laterna::measure
