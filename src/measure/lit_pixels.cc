#include "measure/lit_pixels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/elementary.h"
#include "frame/slide_points.h"
#include "light/light_rays.h"

namespace laterna::measure {
namespace {

bool is_in_picture(const frame::PlacedLight& projector, const glm::dvec3& point_ws) {
  const std::optional<glm::dvec2> slide = frame::slide_from_world(projector, point_ws);
  if (!slide || projector.light->outside != Outside::black) return slide.has_value();
  return slide->x >= 0 && slide->x <= 1 && slide->y >= 0 && slide->y <= 1;
}

}  // namespace

Result<LitPixels> LitPixels::find(const Renderer& renderer, const PictureSurface& surface,
                                  const ShadowRays& rays, const std::string& light) {
  const Result<std::vector<ShadowMapView>> views = renderer.depth_map_views(light);
  if (!views) return tl::unexpected(views.error());
  LitPixels found(surface, rays, *rays.find(light));
  for (const ShadowMapView& map : *views) {
    found.maps_.push_back(
        {map.view, map.image_from_world, glm::inverse(map.image_from_world), {map.width, map.height}});
  }
  const light::LightRays to_light(*found.light_);
  found.pixels_.resize(surface.object.size());
  for (std::size_t i = 0; i < found.pixels_.size(); ++i) {
    if (surface.object[i] < 0) continue;
    const glm::dvec3 point_ws(surface.position_ws[i]);
    const double facing = glm::dot(glm::dvec3(surface.normal_ws[i]), to_light.toward_at(point_ws));
    LitPixel& pixel = found.pixels_[i];
    // Light along a surface does not fall on it, and rounding gives it either sign.
    constexpr double kAlong = 1e-5;
    pixel.is_turned_away = facing <= kAlong;
    if (facing <= kAlong || !found.reaches(point_ws)) continue;
    pixel = found.locate(point_ws);
    pixel.slope =
        static_cast<float>(pixel.footprint * std::sqrt(std::max(0.0, 1 - facing * facing)) / facing);
  }
  return found;
}

bool LitPixels::reaches(const glm::dvec3& point_ws) const {
  const Light& light = *light_->light;
  if (light.type == LightType::directional) return true;
  // The beam of a lens that distorts has corners that its picture does not reach.
  if (light_->lens && !is_in_picture(*light_, point_ws)) return false;
  const glm::dvec3 from_light = point_ws - light_->pose.position_ws;
  const double distance = glm::length(from_light);
  const double along = glm::dot(from_light, light_->pose.forward_ws());
  if (light.type == LightType::spot && along < distance * cosine(light.outer_cone.in_radians())) return false;
  if (light.attenuation == Attenuation::gltf_windowed) return distance < light.range;
  if (light.attenuation == Attenuation::linear)
    return (light.type == LightType::point ? distance : along) < light.range;
  return distance > 0;
}

LitPixel LitPixels::locate(const glm::dvec3& point_ws) const {
  const bool may_leave = light_->light->type == LightType::directional && light_->light->fit;
  for (std::size_t face = 0; face < maps_.size(); ++face) {
    const Map& map = maps_[face];
    const glm::dvec4 q = map.image_from_world * glm::dvec4(point_ws, 1);
    if (q.w <= 0) continue;
    const glm::dvec3 std = glm::dvec3(q) / q.w;
    const auto in_unit = [](double v) { return v >= 0 && v <= 1; };
    if (!may_leave && !(in_unit(std.x) && in_unit(std.y))) continue;
    if (has_frustum(*light_->light) && !in_unit(std.z)) continue;
    LitPixel pixel;
    pixel.face = static_cast<int>(face);
    pixel.texel = glm::vec2(glm::dvec2(std) * map.size);
    const double depth = -(map.view.view_from_world() * glm::dvec4(point_ws, 1)).z;
    const double side = (map.view.projection.right - map.view.projection.left) / map.size.x;
    pixel.depth = static_cast<float>(depth);
    pixel.footprint = static_cast<float>(map.view.projection.is_orthographic ? side : side * depth);
    return pixel;
  }
  return {};
}

glm::dvec2 LitPixels::texel_of(int face, const glm::dvec3& point_ws) const {
  const Map& map = maps_[static_cast<std::size_t>(face)];
  const glm::dvec4 q = map.image_from_world * glm::dvec4(point_ws, 1);
  return glm::dvec2(q) / q.w * map.size;
}

glm::dvec3 LitPixels::beside(std::size_t i, const glm::dvec2& texels) const {
  const LitPixel& pixel = pixels_[i];
  const Map& map = maps_[static_cast<std::size_t>(pixel.face)];
  const glm::dvec2 st = (glm::dvec2(pixel.texel) + texels) / map.size;
  const auto at_depth = [&](double depth) {
    const glm::dvec4 q = map.world_from_image * glm::dvec4(st, depth, 1);
    return glm::dvec3(q) / q.w;
  };
  // Depth 1 of an endless map lies infinitely far.
  const glm::dvec3 start = at_depth(0);
  const glm::dvec3 direction = at_depth(0.5) - start;
  const glm::dvec3 normal(surface_->normal_ws[i]);
  const glm::dvec3 to_plane = glm::dvec3(surface_->position_ws[i]) - start;
  return start + direction * (glm::dot(normal, to_plane) / glm::dot(normal, direction));
}

}  // namespace laterna::measure
