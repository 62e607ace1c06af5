#include "measure/picture_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "measure/seen_geometry.h"

namespace laterna::measure {
namespace {

// Normals of triangles, seen through the same cut-outs, and nothing that only colours them.
Scene with_flat_normals(Scene scene) {
  scene.clips.clear();  // it is posed as it is seen
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& primitive : mesh.primitives) {
      primitive.normals.clear();
      primitive.tangents.clear();
    }
  }
  for (Material& material : scene.materials) {
    material.normal_texture = material.metallic_roughness_texture = material.occlusion_texture = {};
    material.emissive_texture = {};
    material.lobes = nullptr;
    if (material.alpha_mode == AlphaMode::opaque) material.base_color_texture = {};
  }
  for (Light& light : scene.lights) light.enabled = false;
  scene.warnings.clear();
  return scene;
}

// Surfaces seen edge-on have pixels infinitely far apart: their steepness is held to this.
constexpr float kLeastFacing = 0.1F;

}  // namespace

bool PictureSurface::is_continuous(std::size_t a, std::size_t b) const {
  if (object[a] < 0 || object[a] != object[b]) return false;
  constexpr float kMostBent = 0.7F;  // cosine
  if (glm::dot(normal_ws[a], normal_ws[b]) < kMostBent) return false;
  const glm::vec3 step = position_ws[b] - position_ws[a];
  const float length = glm::length(step);
  constexpr float kMostApart = 3;   // of what a flat surface's pixels would be
  constexpr float kMostOff = 0.4F;  // the planes, as a share of the step
  return length <= kMostApart * (spacing[a] + spacing[b]) &&
         std::abs(glm::dot(step, normal_ws[a])) <= kMostOff * length &&
         std::abs(glm::dot(step, normal_ws[b])) <= kMostOff * length;
}

Result<PictureSurface> draw_picture_surface(const Renderer& renderer, const View& view,
                                            const RenderSettings& settings) {
  const Result<Renderer> flat = Renderer::create(
      with_flat_normals(renderer.scene()), {renderer.threads(), renderer.instruction_set(), renderer.time()});
  if (!flat) return tl::unexpected(flat.error());
  const Result<SeenGeometry> seen = draw_geometry(renderer, view, settings);
  if (!seen) return tl::unexpected(seen.error());
  Result<SeenGeometry> drawn = draw_geometry(*flat, view, settings);
  if (!drawn) return tl::unexpected(std::move(drawn.error()));

  PictureSurface surface;
  surface.width = settings.width;
  surface.height = settings.height;
  const std::size_t count = drawn->object.size();
  surface.object.assign(count, -1);
  surface.spacing.assign(count, 0);
  surface.facing.assign(count, 0);
  const glm::dvec3 forward = view.pose.forward_ws();
  const Projection& projection = view.projection;
  const double pixel = std::max((projection.right - projection.left) / settings.width,
                                (projection.top - projection.bottom) / settings.height);
  for (std::size_t i = 0; i < count; ++i) {
    if (seen->object[i] < 0 || seen->object[i] != drawn->object[i]) continue;
    const glm::dvec3 from_eye = glm::dvec3(drawn->position_ws[i]) - view.pose.position_ws;
    const double along = glm::dot(from_eye, forward);
    const double side = projection.is_orthographic ? pixel : pixel * along;
    const glm::dvec3 gaze = projection.is_orthographic ? forward : glm::normalize(from_eye);
    surface.facing[i] = static_cast<float>(-glm::dot(glm::dvec3(drawn->normal_ws[i]), gaze));
    surface.spacing[i] = static_cast<float>(side) / std::max(surface.facing[i], kLeastFacing);
    if (glm::distance(seen->position_ws[i], drawn->position_ws[i]) > 0.1F * surface.spacing[i]) continue;
    surface.object[i] = static_cast<int>(drawn->object[i]);
  }
  surface.position_ws = std::move(drawn->position_ws);
  surface.normal_ws = std::move(drawn->normal_ws);
  return surface;
}

}  // namespace laterna::measure
