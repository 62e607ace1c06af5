#include "render/probe_light.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/refuse.h"
#include "light/light_plan.h"
#include "shade/illuminance.h"
#include "shade/illumination.h"
#include "shadow/panes.h"
#include "shadow/ray_traced.h"

namespace laterna::render {

using raster::RasterView;
using shadow::kGroupSize;
using shadow::kMaxSamples;
using shadow::SurfaceSamples;

namespace {

// SurfaceSamples' x, y and q are whatever their ray makes a world point of: here the offsets from `origin` along the
// world's axes, in units so small that a slide is looked up at a point, not over a pixel's footprint.
constexpr double kUnit = 1.0 / (1 << 20);

RasterView::Ray ray_about(const glm::dvec3& origin_ws) {
  return {glm::dvec4(origin_ws, 1), {kUnit, 0, 0, 0}, {0, kUnit, 0, 0}, {0, 0, kUnit, 0}};
}

glm::dvec3 middle_of(std::span<const Probe> probes) {
  glm::dvec3 low = probes.front().position_ws;
  glm::dvec3 high = low;
  for (const Probe& probe : probes) {
    low = glm::min(low, probe.position_ws);
    high = glm::max(high, probe.position_ws);
  }
  return 0.5 * (low + high);
}

// One light, ready to be asked.
struct MeasuredLight {
  shade::BoundLight bound;
  std::unique_ptr<shadow::ShadowTechnique> shadow;  // null: nothing stands in its way
};

std::unique_ptr<shadow::ShadowTechnique> make_shadow(const ProbeContext& context,
                                                     const light::PlannedLight& planned) {
  if (planned.technique == ShadowTechnique::none) return nullptr;
  auto opaque = std::make_unique<shadow::RayTracedShadow>(planned, context.rays);
  if (!context.frame.has_blended_casters) return opaque;
  return std::make_unique<shadow::ShadowThroughPanes>(
      std::move(opaque), std::make_unique<shadow::RayTracedPanes>(planned, context.frame, context.rays),
      context.frame, context.instruction_set);
}

void set_sample(SurfaceSamples& samples, shade::SurfacePoints& points, std::size_t i, const Probe& probe,
                const glm::dvec3& origin_ws) {
  const glm::dvec3 offset = (probe.position_ws - origin_ws) / kUnit;
  samples.x[i] = static_cast<float>(offset.x);
  samples.y[i] = static_cast<float>(offset.y);
  samples.q[i] = static_cast<float>(offset.z);
  samples.id[i] = kNoTriangle;
  samples.dq_dx[i] = samples.dq_dy[i] = 0;
  const glm::dvec3 normal = glm::normalize(probe.normal_ws);
  const auto set = [i](auto& x, auto& y, auto& z, const glm::dvec3& v) {
    x[i] = static_cast<float>(v.x);
    y[i] = static_cast<float>(v.y);
    z[i] = static_cast<float>(v.z);
  };
  set(samples.x_ws, samples.y_ws, samples.z_ws, probe.position_ws);
  set(samples.normal_x_ws, samples.normal_y_ws, samples.normal_z_ws, normal);
  set(points.normal_x_ws, points.normal_y_ws, points.normal_z_ws, normal);
}

// Where rays start: off the plane on which the probes lie.
void lift(SurfaceSamples& samples, std::span<const Probe> probes) {
  for (std::size_t i = 0; i < samples.group_count * kGroupSize; ++i) {
    const Probe& probe = probes[std::min(i, probes.size() - 1)];
    const glm::dvec3 lifted = probe.position_ws + kProbeClearance * glm::normalize(probe.normal_ws);
    samples.x_ws[i] = static_cast<float>(lifted.x);
    samples.y_ws[i] = static_cast<float>(lifted.y);
    samples.z_ws[i] = static_cast<float>(lifted.z);
  }
}

// Up to kMaxSamples probes and what is found of them; one for each thread.
class Batch {
 public:
  void fill(std::span<const Probe> probes, const glm::dvec3& origin_ws) {
    probes_ = probes;
    const std::size_t count = probes.size();
    samples_.ray = ray_about(origin_ws);
    set_count(samples_, count);
    samples_.position_error = 0;
    for (std::size_t i = 0; i < samples_.group_count * kGroupSize; ++i)
      set_sample(samples_, points_, i, probes[std::min(i, count - 1)], origin_ws);
    lifted_ = samples_;
    lift(lifted_, probes);
  }

  void find(const MeasuredLight& light, shade::FindIrradiance find_irradiance) {
    find_irradiance(light.bound, samples_, points_, nullptr, irradiance_);
    arrival_.is_tinted = false;
    arrival_.alpha.fill(1);
    if (light.shadow == nullptr) return;
    const std::span lit(irradiance_.lit);
    light.shadow->find_arrival(lifted_, lit.first(samples_.group_count), arrival_);
  }

  void add_to(ProbeReading& reading, std::size_t i, std::size_t light) const {
    if ((irradiance_.lit[i / kGroupSize] >> (i % kGroupSize) & 1U) == 0) return;
    const glm::vec3 share = arrival_.is_tinted ? glm::vec3(arrival_.r[i], arrival_.g[i], arrival_.b[i])
                                               : glm::vec3(arrival_.alpha[i]);
    reading.lights[light].lux += shade::illuminance(samples_, irradiance_, share, i);
    reading.lights[light].visibility += arrival_.alpha[i];
  }

  [[nodiscard]] std::size_t size() const { return probes_.size(); }

 private:
  std::span<const Probe> probes_;
  SurfaceSamples samples_, lifted_;
  shade::SurfacePoints points_;
  shade::Irradiance irradiance_;
  shadow::Arrival arrival_;
};

// All probes, with lights as they shine from one point of their sources: added to the readings.
void measure_once(const ProbeContext& context, std::span<const Probe> probes, SampleIndex sample,
                  std::span<ProbeReading> readings) {
  light::LightPlan plan =
      light::make_light_plan(context.frame, {ShadowTechnique::raytraced, sample, nullptr});
  const glm::dvec3 origin = middle_of(probes);
  const RasterView::Ray ray = ray_about(origin);
  std::vector<MeasuredLight> lights;
  for (light::PlannedLight& planned : plan.lights) {
    if (planned.technique != ShadowTechnique::none) planned.technique = ShadowTechnique::raytraced;
    lights.push_back(
        {shade::BoundLight(*planned.placed, ray, ShadingModel::pbr, 1), make_shadow(context, planned)});
  }
  const shade::FindIrradiance find_irradiance = shade::find_irradiance_for(context.instruction_set);
  std::vector<std::unique_ptr<Batch>> batches(static_cast<std::size_t>(context.pool.threads()));
  const std::size_t count = (probes.size() + kMaxSamples - 1) / kMaxSamples;
  context.pool.for_each(count, [&](std::size_t number, int worker) {
    if (context.progress.is_cancelled()) return;
    std::unique_ptr<Batch>& batch = batches[static_cast<std::size_t>(worker)];
    if (batch == nullptr) batch = std::make_unique<Batch>();
    const std::size_t first = number * kMaxSamples;
    batch->fill(probes.subspan(first, std::min(kMaxSamples, probes.size() - first)), origin);
    for (std::size_t light = 0; light < lights.size(); ++light) {
      batch->find(lights[light], find_irradiance);
      for (std::size_t i = 0; i < batch->size(); ++i) batch->add_to(readings[first + i], i, light);
    }
    context.progress.advance();
  });
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

Result<void> check_probes(std::span<const Probe> probes, const ProbeSettings& settings) {
  if (settings.accumulate < 1 || settings.accumulate > kMaxAccumulated) {
    return refuse(fmt::format("accumulate: expected 1 to {}, got {}", kMaxAccumulated, settings.accumulate));
  }
  if (probes.size() > kMaxProbes)
    return refuse(fmt::format("{} probes are more than {}", probes.size(), kMaxProbes));
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const Probe& probe = probes[i];
    const double farthest = std::max(
        {std::abs(probe.position_ws.x), std::abs(probe.position_ws.y), std::abs(probe.position_ws.z)});
    if (!is_finite(probe.position_ws) || farthest > kMaxCoordinate) {
      return refuse(
          fmt::format("probes[{}]: expected a position within {:g} m of the origin", i, kMaxCoordinate));
    }
    const double length = glm::length(probe.normal_ws);
    if (!is_finite(probe.normal_ws) || !(length > 0) || !std::isfinite(length))
      return refuse(fmt::format("probes[{}]: expected a normal of some length, and finite", i));
    if (!(probe.area >= 0) || !std::isfinite(probe.area))
      return refuse(fmt::format("probes[{}]: expected an area of at least 0, got {}", i, probe.area));
  }
  return {};
}

std::size_t probe_steps(std::span<const Probe> probes, const ProbeSettings& settings) {
  return (probes.size() + kMaxSamples - 1) / kMaxSamples * static_cast<std::size_t>(settings.accumulate);
}

ProbeReport measure_probes(const ProbeContext& context, std::span<const Probe> probes,
                           const ProbeSettings& settings) {
  ProbeReport report;
  for (const frame::PlacedLight& placed : context.frame.lights) report.lights.push_back(placed.light->name);
  ProbeReading dark;
  dark.lights.resize(report.lights.size());
  report.readings.assign(probes.size(), dark);
  if (probes.empty()) return report;
  const bool has_size = std::any_of(context.frame.lights.begin(), context.frame.lights.end(),
                                    [](const frame::PlacedLight& l) { return light::has_samples(*l.light); });
  const int points = has_size ? settings.accumulate : 1;
  for (int i = 0; i < points && !context.progress.is_cancelled(); ++i)
    measure_once(context, probes, {i, points}, report.readings);
  for (ProbeReading& reading : report.readings) {
    for (std::size_t i = 0; i < reading.lights.size(); ++i) {
      ProbeReading::FromLight& light = reading.lights[i];
      light.lux /= points;
      light.visibility /= points;
      // Others are no light in the world: what they would add by themselves is told, and not counted.
      if (context.frame.lights[i].light->blend == BlendMode::add) reading.lux += light.lux;
    }
  }
  return report;
}

}  // namespace laterna::render
