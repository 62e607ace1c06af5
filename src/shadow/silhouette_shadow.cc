#include "shadow/silhouette_shadow.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/stopwatch.h"
#include "light/light_rays.h"

namespace laterna::shadow {

using light::SilhouetteObject;

namespace {

// Where point + t way is in a box: from `enters` to `leaves`.
struct Stretch {
  double enters, leaves;
  [[nodiscard]] bool is_empty() const { return !(enters <= leaves); }
};

Stretch stretch_in_box(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& point,
                       const glm::dvec3& way, double end) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  Stretch stretch = {-kEndless, end};
  for (int k = 0; k < 3; ++k) {
    const double to_low = low[k] - point[k];
    const double to_high = high[k] - point[k];
    if (way[k] == 0) {
      if (to_low > 0 || to_high < 0) return {kEndless, -kEndless};
      continue;
    }
    const double a = to_low / way[k];
    const double b = to_high / way[k];
    stretch.enters = std::max(stretch.enters, std::min(a, b));
    stretch.leaves = std::min(stretch.leaves, std::max(a, b));
  }
  return stretch;
}

}  // namespace

/// The samples that are asked about, with a sphere around them.
struct SilhouetteShadow::Batch {
  const SurfaceSamples& samples;
  std::array<std::uint16_t, kMaxSamples> indices;
  std::array<std::uint32_t, kMaxSamples> object;
  std::size_t count = 0;
  light::BoundingSphere sphere;

  Batch(const SurfaceSamples& s, std::span<const std::uint16_t> wanted, const frame::Frame& frame)
      : samples(s) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-std::numeric_limits<double>::infinity());
    for_each_sample(s, wanted, [&](std::size_t i) {
      indices[count] = static_cast<std::uint16_t>(i);
      object[count] = frame.clusters[cluster_of(s.id[i])].object;
      ++count;
      low = glm::min(low, point(i));
      high = glm::max(high, point(i));
    });
    if (count == 0) return;
    sphere.centre = 0.5 * (low + high);
    sphere.radius = 0.5 * glm::length(high - low) + static_cast<double>(s.position_error);
  }

  [[nodiscard]] glm::dvec3 point(std::size_t i) const {
    return {samples.x_ws[i], samples.y_ws[i], samples.z_ws[i]};
  }
};

SilhouetteShadow::SilhouetteShadow(const light::PlannedLight& planned, const frame::Frame& frame,
                                   const raster::RasterView::Ray& ray,
                                   std::unique_ptr<SilhouettePainter> painter)
    : settings_(planned.settings),
      frame_(frame),
      light_(light::homogeneous_light(*planned.placed)),
      plan_(light::make_silhouette_plan(planned, frame)),
      painter_(std::move(painter)) {
  for (const light::SilhouetteOccluder& occluder : plan_.occluders) {
    first_texture_.push_back(textures_.size());
    for (const light::ShadowView& view : occluder.views)
      textures_.push_back(std::make_unique<SilhouetteTexture>(view, occluder.object, ray));
  }
  first_texture_.push_back(textures_.size());
}

// Of six views the one along whose axis the point lies farthest.
const SilhouetteTexture* SilhouetteShadow::texture_towards(std::size_t occluder, const glm::dvec3& point_ws,
                                                           double& drawing_ms) const {
  std::size_t best = first_texture_[occluder];
  double farthest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = best;
       first_texture_[occluder + 1] - first_texture_[occluder] > 1 && i < first_texture_[occluder + 1]; ++i) {
    const View& view = textures_[i]->view().view;
    const double along = glm::dot(view.pose.forward_ws(), point_ws - view.pose.position_ws);
    if (along <= farthest) continue;
    farthest = along;
    best = i;
  }
  SilhouetteTexture& texture = *textures_[best];
  if (!texture.is_drawn()) {
    Stopwatch watch;
    watch.start();
    texture.require(*painter_, settings_);
    drawing_ms += watch.lap_ms();
  }
  return &texture;
}

// Whether the way to the light meets the occluder's box. Where two objects overlap in distance, such as a ball and the
// floor under it, this tells which of their points can be shaded at all: nothing on the floor is in the floor's shadow.
bool SilhouetteShadow::is_behind_box(const SilhouetteObject& occluder, const glm::dvec3& point_ws,
                                     double error) const {
  const bool is_parallel = light_.w == 0;
  const glm::dvec3 way = is_parallel ? glm::dvec3(light_) : glm::dvec3(light_) - point_ws;
  const double length = glm::length(way);
  if (length == 0) return false;
  const double end = is_parallel ? std::numeric_limits<double>::infinity() : 1;
  // Touching it at the start alone is rounding.
  if (const Stretch in_box = stretch_in_box(occluder.low_ws, occluder.high_ws, point_ws, way, end);
      !in_box.is_empty())
    return in_box.leaves > 2 * error / length;
  // A silhouette's soft rim reaches a little farther than the box, to the sides as the light sees it. What is in it has
  // the box before or behind it.
  const double rim = light::silhouette_spread(settings_) * occluder.sphere.radius;
  glm::dvec3 wider(0);
  for (int k = 0; k < 3; ++k)
    wider[k] = rim * std::sqrt(std::max(0.0, 1 - way[k] * way[k] / (length * length)));
  const Stretch in_rim =
      stretch_in_box(occluder.low_ws - wider, occluder.high_ws + wider, point_ws, way, end);
  return !in_rim.is_empty() && in_rim.enters + in_rim.leaves > 0;
}

void SilhouetteShadow::look_up(const light::SilhouetteLookup& lookup, const Batch& batch,
                               std::uint32_t receiver, Arrival& arrival, double& drawing_ms) const {
  const light::SilhouetteOccluder& occluder = plan_.occluders[lookup.occluder];
  const SilhouetteObject& object = plan_.objects[occluder.object];
  const SurfaceSamples& s = batch.samples;
  for (std::size_t k = 0; k < batch.count; ++k) {
    if (batch.object[k] != receiver) continue;
    const std::size_t i = batch.indices[k];
    if (arrival.alpha[i] == 0) continue;
    const glm::dvec3 point = batch.point(i);
    if (!lookup.is_ordered && !is_behind_box(object, point, static_cast<double>(s.position_error))) continue;
    const SilhouetteTexture& texture = *texture_towards(lookup.occluder, point, drawing_ms);
    const SilhouetteTexture::Place place = texture.place_of(s.x[i], s.y[i], s.q[i]);
    arrival.alpha[i] *=
        settings_.filter == ShadowFilter::nearest ? texture.nearest(place) : texture.bilinear(place);
  }
}

double SilhouetteShadow::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                      Arrival& arrival) const {
  arrival.is_tinted = false;
  std::fill_n(arrival.alpha.data(), samples.group_count * kGroupSize, 1.0F);
  const Batch batch(samples, wanted, frame_);
  if (batch.count == 0) return 0;
  // A receiver as large as a floor has pairs with all that stands on it, but few of them concern these samples.
  const light::SphereOutline here(batch.sphere, light_);
  const double spread = 1 + light::silhouette_spread(settings_);
  double drawing_ms = 0;
  std::vector<std::uint32_t> seen;
  for (std::size_t k = 0; k < batch.count; ++k) {
    const std::uint32_t receiver = batch.object[k];
    if (std::find(seen.begin(), seen.end(), receiver) != seen.end()) continue;
    seen.push_back(receiver);
    for (const light::SilhouetteLookup& lookup : plan_.lookups[receiver]) {
      light::BoundingSphere sphere = plan_.objects[plan_.occluders[lookup.occluder].object].sphere;
      sphere.radius *= spread;
      if (settings_.culls_occluders && !light::SphereOutline(sphere, light_).overlaps(here)) continue;
      look_up(lookup, batch, receiver, arrival, drawing_ms);
    }
  }
  return drawing_ms;
}

DrawnForShadows SilhouetteShadow::drawn() const {
  DrawnForShadows drawn;
  for (const SilhouetteObject& object : plan_.objects)
    drawn.objects += object.casts || object.receives ? 1 : 0;
  drawn.pairs = plan_.pairs;
  drawn.silhouettes = textures_.size();
  for (const auto& texture : textures_) {
    if (!texture->is_drawn()) continue;
    ++drawn.silhouettes_drawn;
    drawn.bytes += texture->memory_bytes();
  }
  return drawn;
}

}  // namespace laterna::shadow
