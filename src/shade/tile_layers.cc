#include "shade/tile_layers.h"

#include <limits>

#include "shade/illuminance.h"
#include "shade/scatter.h"

namespace laterna::shade {

using shadow::Arrival;
using shadow::kGroupSize;
using shadow::SampleArray;
using shadow::SurfaceSamples;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

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
  if (wanted.pixel_density) {
    result_.pixel_density.resize(lights);
    for (const frame::PlacedLight& placed : frame.lights)
      pixel_densities_.push_back(PixelDensity::of(placed));
  }
  if (wanted.photographs) {
    result_.photograph_share.resize(frame.photographs.size());
    result_.photograph_color.resize(frame.photographs.size());
  }
  if (!wanted.slide_uv) return;
  result_.slide_s.resize(lights);
  result_.slide_t.resize(lights);
}

void TileLayers::start_tile() {
  for (TilePlane& plane : result_.visibility) plane.fill(0);
  if (wanted_.lux) result_.lux.fill(0);
  for (TilePlane& plane : result_.pixel_density) plane.fill(0);
  for (TilePlane& plane : result_.slide_s) plane.fill(kNaN);
  for (TilePlane& plane : result_.slide_t) plane.fill(kNaN);
  if (wanted_.geometry) {
    result_.depth.fill(kInfinity);
    fill(result_.position, 0, 0, 0);
    fill(result_.normal, 0, 0, 0);
    result_.object.fill(kNoObject);
  }
  if (wanted_.albedo) fill(result_.albedo, 0, 0, 0);
  if (!wanted_.photographs) return;
  result_.photographs_seen.fill(-1);
  for (TilePlane& plane : result_.photograph_share) plane.fill(0);
  for (TileColor& color : result_.photograph_color) {
    for (TilePlane* plane : {&color.r, &color.g, &color.b}) plane->fill(kNaN);
  }
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

void TileLayers::store_photographs(const SurfaceSamples& s, const PhotographPainter& painter) {
  scatter(s, painter.sums().seen.data(), result_.photographs_seen.data());
  const SampleArray<float>& all = painter.sums().weight;
  for (std::size_t p = 0; p < painter.colors().size(); ++p) {
    const PhotographColor& color = painter.colors()[p];
    TileColor& target = result_.photograph_color[p];
    for (std::size_t group = 0; group < s.group_count; ++group) {
      for (unsigned mask = s.active[group]; mask != 0; mask &= mask - 1) {
        const std::size_t i = group * kGroupSize + static_cast<std::size_t>(__builtin_ctz(mask));
        if (color.weight[i] <= 0) continue;
        result_.photograph_share[p][s.pixel[i]] = color.weight[i] / all[i];
        target.r[s.pixel[i]] = color.r[i];
        target.g[s.pixel[i]] = color.g[i];
        target.b[s.pixel[i]] = color.b[i];
      }
    }
  }
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
    return illuminance(s, e, {share.r[i], share.g[i], share.b[i]}, i);
  });
}

void TileLayers::store_pixel_density(std::size_t light, const SurfaceSamples& s) {
  if (!pixel_densities_[light]) return;
  const PixelDensity& density = *pixel_densities_[light];
  add_to(result_.pixel_density[light], s, [&](std::size_t i) {
    return density.at({s.x_ws[i], s.y_ws[i], s.z_ws[i]},
                      {s.normal_x_ws[i], s.normal_y_ws[i], s.normal_z_ws[i]});
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
