#include "shadow/shadow_map.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/stopwatch.h"

namespace laterna::shadow {
namespace {

void copy(const glm::dvec3& from, float* to) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

BoundDepthMap bind(const DepthMap& map, const raster::RasterView::Ray& ray) {
  const raster::RasterView& view = map.view();
  const PixelRows rows(view);
  BoundDepthMap bound;
  bound.map = &map;
  bound.position = {ProjectedRow(rows.x, ray), ProjectedRow(rows.y, ray), ProjectedRow(rows.w, ray)};
  bound.homogeneous = bound.divisor = homogeneous_row(ray);
  bound.is_orthographic = view.is_orthographic;
  copy(view.eye_ws, bound.eye_ws);
  copy(view.direction_x, bound.direction_x_ws);
  copy(view.direction_y, bound.direction_y_ws);
  copy(view.axis_ws, bound.axis_ws);
  const double x = glm::length(view.direction_x);
  const double y = glm::length(view.direction_y);
  bound.texel_size = static_cast<float>(x > y ? x : y);
  return bound;
}

// A warped map is an orthographic one of the warped world: rows over points of that are rows over points of the world
// times the warp.
void apply(const light::Warp& warp, const raster::RasterView::Ray& ray, BoundDepthMap& bound) {
  const raster::RasterView& view = bound.map->view();
  const PixelRows rows(view);
  const auto in_world = [&](const glm::dvec4& row) {
    return ProjectedRow(row * warp.warped_from_world, ray);
  };
  bound.position = {in_world(rows.x), in_world(rows.y), in_world(rows.w)};
  bound.divisor = in_world(glm::dvec4(0, 0, 0, 1));
  const glm::dmat4 world_from_warped = glm::inverse(warp.warped_from_world);
  const glm::dvec4 step_x = world_from_warped * glm::dvec4(view.direction_x, 0);
  const glm::dvec4 step_y = world_from_warped * glm::dvec4(view.direction_y, 0);
  copy(glm::dvec3(step_x), bound.direction_x_ws);
  copy(glm::dvec3(step_y), bound.direction_y_ws);
  bound.direction_x_h = static_cast<float>(step_x.w);
  bound.direction_y_h = static_cast<float>(step_y.w);
  copy(-warp.light_view.pose.forward_ws(), bound.axis_ws);
  bound.is_warped = true;
}

}  // namespace

ShadowFilter filter_of(const ShadowSettings& settings) {
  const bool is_plain = settings.constant_bias || settings.slope_bias || settings.soft_edge > 0;
  return is_plain && settings.filter == ShadowFilter::refined ? ShadowFilter::bilinear : settings.filter;
}

ShadowBias bias_of(const ShadowSettings& settings) {
  if (!settings.constant_bias && !settings.slope_bias) return {};
  ShadowBias bias;
  bias.uses_receiver_plane = false;
  bias.texels = 0;
  bias.metres = static_cast<float>(settings.constant_bias.value_or(0));
  bias.slope = static_cast<float>(settings.slope_bias.value_or(0));
  return bias;
}

ShadowMapTest make_shadow_map_test(const light::PlannedLight& planned,
                                   std::span<const std::shared_ptr<DepthMap>> maps, const frame::Frame& frame,
                                   const frame::TriangleNeighbours* neighbours,
                                   const raster::RasterView::Ray& ray, int samples_per_pixel,
                                   InstructionSet set) {
  ShadowMapTest test;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    test.maps.push_back(bind(*maps[i], ray));
    const bool is_warped = i < planned.shadow_views.size() && planned.shadow_views[i].warp;
    if (is_warped) apply(*planned.shadow_views[i].warp, ray, test.maps.back());
  }
  if (maps.size() > 1) {
    test.choice =
        planned.technique == laterna::ShadowTechnique::cascades ? MapChoice::finest : MapChoice::face;
  }
  test.bias = bias_of(planned.settings);
  test.filter = filter_of(planned.settings);
  test.frame = &frame;
  // Where only some faces cast shadows, the map knows which; their neighbours may be of the other kind.
  if (neighbours != nullptr && !neighbours->sources.empty() &&
      planned.settings.caster_faces == CasterFaces::both) {
    test.neighbours = neighbours;
  }
  // Several samples per pixel antialias shadows' edges by themselves.
  test.positions = samples_per_pixel > 1 ? 1 : 5;
  for (int i = 0; i < 4; ++i) {
    test.ray_x[i] = static_cast<float>(ray.ray_x[i]);
    test.ray_y[i] = static_cast<float>(ray.ray_y[i]);
    test.q_term[i] = static_cast<float>(ray.q_term[i]);
  }
  test.kernel = planned.settings.kernel;
  test.outside_is_lit = planned.settings.outside_is_lit;
  // Parallel light has no distance.
  test.is_radial = planned.settings.depth == ShadowDepth::radial && !test.maps[0].is_orthographic;
  test.soft_edge = static_cast<float>(planned.settings.soft_edge);
  test.instruction_set = set;
  return test;
}

ShadowMap::ShadowMap(const light::PlannedLight& planned, std::span<const std::shared_ptr<DepthMap>> maps,
                     const frame::Frame& frame, const frame::TriangleNeighbours* neighbours,
                     const raster::RasterView::Ray& ray, int samples_per_pixel, InstructionSet set,
                     std::function<bool()> asks_to_stop)
    : maps_(maps.begin(), maps.end()),
      test_(make_shadow_map_test(planned, maps, frame, neighbours, ray, samples_per_pixel, set)),
      asks_to_stop_(std::move(asks_to_stop)) {}

double ShadowMap::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                               Arrival& arrival) const {
  arrival.is_tinted = false;
  std::vector<MapTile> missing;
  find_missing_tiles_for(test_.instruction_set)(test_, samples, wanted, missing);
  Stopwatch watch;
  if (!missing.empty()) watch.start();
  for (const MapTile& tile : missing) {
    if (asks_to_stop_ && asks_to_stop_()) {
      std::fill_n(arrival.alpha.data(), samples.group_count * kGroupSize, 0.0F);
      return watch.lap_ms();
    }
    maps_[tile.map]->require(tile.x, tile.y);
  }
  const double drawing_ms = missing.empty() ? 0 : watch.lap_ms();
  look_up_shadow_map_for(test_.instruction_set)(test_, samples, wanted, arrival.alpha.data());
  return drawing_ms;
}

}  // namespace laterna::shadow
