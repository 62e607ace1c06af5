#include <cmath>
#include <optional>

#include "laterna/measure.h"
#include "measure/depth_ramp.h"
#include "measure/seen_geometry.h"

namespace laterna {
namespace {

// A light's maps with the matrices they were drawn by: one, or six faces.
struct LightMaps {
  std::vector<glm::dmat4> image_from_world;
  std::vector<LayeredImage> maps;
};

Result<LightMaps> draw_maps(const Renderer& renderer, const std::string& light) {
  LightMaps all;
  const Result<std::vector<ShadowMapView>> views = renderer.depth_map_views(light);
  if (!views) return tl::unexpected(views.error());
  for (std::size_t face = 0; face < views->size(); ++face) {
    Result<LayeredImage> map = renderer.depth_map(light, static_cast<int>(face));
    if (!map) return tl::unexpected(map.error());
    all.maps.push_back(std::move(*map));
    all.image_from_world.push_back((*views)[face].image_from_world);
  }
  return all;
}

// What the maps hold for a point; none where no map sees it.
std::optional<float> stored_depth(const LightMaps& light, const glm::dvec3& point_ws) {
  for (std::size_t i = 0; i < light.maps.size(); ++i) {
    const glm::dvec4 q = light.image_from_world[i] * glm::dvec4(point_ws, 1);
    if (q.w <= 0) continue;
    const LayeredImage& map = light.maps[i];
    const double x = std::floor(q.x / q.w * map.width);
    const double y = std::floor(q.y / q.w * map.height);
    if (x < 0 || y < 0 || x >= map.width || y >= map.height) continue;
    return map.channels[0].values[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                                  static_cast<std::size_t>(x)];
  }
  return std::nullopt;
}

}  // namespace

Result<LayeredImage> projected_depth(const Renderer& renderer, const View& camera,
                                     const RenderSettings& settings, const std::string& light) {
  const Result<LightMaps> maps = draw_maps(renderer, light);
  if (!maps) return tl::unexpected(maps.error());
  const Result<measure::SeenGeometry> seen = measure::draw_geometry(renderer, camera, settings);
  if (!seen) return tl::unexpected(seen.error());

  std::vector<float> all;
  for (const LayeredImage& map : maps->maps)
    all.insert(all.end(), map.channels[0].values.begin(), map.channels[0].values.end());
  const measure::DepthRamp ramp(all);
  LayeredImage picture;
  picture.width = settings.width;
  picture.height = settings.height;
  for (const char* name : {"R", "G", "B"})
    picture.channels.push_back({name, seen->unshadowed.find(name)->values});
  for (std::size_t i = 0; i < seen->object.size(); ++i) {
    if (seen->object[i] < 0) continue;
    const std::optional<float> stored = stored_depth(*maps, seen->position_ws[i]);
    const float grey = stored ? ramp.grey(*stored) : 0.0F;
    for (Channel& channel : picture.channels) channel.values[i] = grey;
  }
  return picture;
}

}  // namespace laterna
