#include "shade/tile_layers.h"

#include <limits>

#include "shade/scatter.h"

namespace laterna::shade {

using shadow::Arrival;
using shadow::kGroupSize;
using shadow::SampleArray;
using shadow::SurfaceSamples;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

void clear(TileColor& color) {
  for (TilePlane* plane : {&color.r, &color.g, &color.b}) plane->fill(0);
}

/// plane[pixel of sample i] += value(i), for the samples that count.
template <class Value>
void add_to(TilePlane& plane, const SurfaceSamples& s, Value value) {
  for_each_sample(s, s.active, [&](std::size_t i) { plane[s.pixel[i]] += value(i); });
}

// The fraction of each channel that arrives, tinted or not.
struct ArrivingShares {
  const SampleArray<float>&r, &g, &b;
  explicit ArrivingShares(const Arrival& arrival)
      : r(arrival.is_tinted ? arrival.r : arrival.alpha),
        g(arrival.is_tinted ? arrival.g : arrival.alpha),
        b(arrival.is_tinted ? arrival.b : arrival.alpha) {}
};

bool is_lit(const Irradiance& e, std::size_t i) {
  return (e.lit[i / kGroupSize] >> (i % kGroupSize) & 1U) != 0;
}

}  // namespace

TileLayers::TileLayers(const frame::Frame& frame, const raster::RasterView& view, const WantedLayers& wanted,
                       TileResult& result)
    : frame_(frame), view_(view), wanted_(wanted), result_(result) {
  const std::size_t lights = frame.lights.size();
  if (wanted.visibility) result_.visibility.resize(lights);
  if (!wanted.slide_uv) return;
  result_.slide_s.resize(lights);
  result_.slide_t.resize(lights);
}

void TileLayers::start_tile() {
  for (TilePlane& plane : result_.visibility) plane.fill(0);
  if (wanted_.lux) result_.lux.fill(0);
  for (TilePlane& plane : result_.slide_s) plane.fill(kNaN);
  for (TilePlane& plane : result_.slide_t) plane.fill(kNaN);
  if (wanted_.geometry) {
    result_.depth.fill(kInfinity);
    clear(result_.position);
    clear(result_.normal);
    result_.object.fill(kNoObject);
  }
  if (wanted_.albedo) clear(result_.albedo);
}

void TileLayers::store_geometry(const SurfaceSamples& s, const SurfacePoints& points) {
  if (wanted_.albedo) {
    scatter(s, points.base_r.data(), result_.albedo.r.data());
    scatter(s, points.base_g.data(), result_.albedo.g.data());
    scatter(s, points.base_b.data(), result_.albedo.b.data());
  }
  if (!wanted_.geometry) return;
  scatter(s, s.x_ws.data(), result_.position.r.data());
  scatter(s, s.y_ws.data(), result_.position.g.data());
  scatter(s, s.z_ws.data(), result_.position.b.data());
  scatter(s, points.normal_x_ws.data(), result_.normal.r.data());
  scatter(s, points.normal_y_ws.data(), result_.normal.g.data());
  scatter(s, points.normal_z_ws.data(), result_.normal.b.data());
  for_each_sample(s, s.active, [&](std::size_t i) {
    result_.depth[s.pixel[i]] = static_cast<float>(view_.distance_from_reversed(s.q[i]));
    result_.object[s.pixel[i]] = frame_.clusters[cluster_of(s.id[i])].object;
  });
}

void TileLayers::add_visibility(std::size_t light, const SurfaceSamples& s, const Arrival& arrival) {
  add_to(result_.visibility[light], s, [&](std::size_t i) { return arrival.alpha[i]; });
}

void TileLayers::store_slide_coordinates(std::size_t light, const SurfaceSamples& s,
                                         const Irradiance& irradiance) {
  scatter(s, irradiance.slide_s.data(), result_.slide_s[light].data());
  scatter(s, irradiance.slide_t.data(), result_.slide_t[light].data());
}

void TileLayers::add_lux(const SurfaceSamples& s, const Irradiance& e, const Arrival& arrival) {
  const ArrivingShares share(arrival);
  add_to(result_.lux, s, [&](std::size_t i) {
    if (!is_lit(e, i)) return 0.0F;
    if (!arrival.is_tinted)
      return (0.2126F * e.r[i] + 0.7152F * e.g[i] + 0.0722F * e.b[i]) * e.cosine[i] * arrival.alpha[i];
    return (0.2126F * e.r[i] * share.r[i] + 0.7152F * e.g[i] * share.g[i] + 0.0722F * e.b[i] * share.b[i]) *
           e.cosine[i];
  });
}

void TileLayers::add_illumination(const SurfaceSamples& s, const Irradiance& e, const Arrival& arrival,
                                  TileColor& sum) {
  const ArrivingShares share(arrival);
  const auto arriving = [&](std::size_t i, const SampleArray<float>& value, const SampleArray<float>& part) {
    return is_lit(e, i) ? value[i] * part[i] : 0.0F;
  };
  add_to(sum.r, s, [&](std::size_t i) { return arriving(i, e.r, share.r); });
  add_to(sum.g, s, [&](std::size_t i) { return arriving(i, e.g, share.g); });
  add_to(sum.b, s, [&](std::size_t i) { return arriving(i, e.b, share.b); });
}

}  // namespace laterna::shade
