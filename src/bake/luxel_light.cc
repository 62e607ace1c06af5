#include "bake/luxel_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"
#include "base/sample_sequence.h"
#include "shadow/panes.h"
#include "shadow/ray_traced.h"

namespace laterna::bake {

using raster::RasterView;
using shadow::kGroupSize;
using shadow::kMaxSamples;

namespace {

// As for light meters (render/probe_light): SurfaceSamples' x, y and q are offsets along the world's axes, in units so small
// that a slide is looked up at a point.
constexpr double kUnit = 1.0 / (1 << 20);
constexpr float kRounding = 1.0F / (1 << 22);

RasterView::Ray ray_about(const glm::dvec3& origin_ws) {
  return {glm::dvec4(origin_ws, 1), {kUnit, 0, 0, 0}, {0, kUnit, 0, 0}, {0, 0, kUnit, 0}};
}

std::unique_ptr<shadow::ShadowTechnique> make_shadow(const light::PlannedLight& planned,
                                                     const frame::Frame& frame,
                                                     const std::shared_ptr<const trace::RayScene>& rays,
                                                     InstructionSet set) {
  if (planned.technique == ShadowTechnique::none) return nullptr;
  auto opaque = std::make_unique<shadow::RayTracedShadow>(planned, rays);
  if (!frame.has_blended_casters) return opaque;
  return std::make_unique<shadow::ShadowThroughPanes>(
      std::move(opaque), std::make_unique<shadow::RayTracedPanes>(planned, frame, rays), frame, set);
}

// Any two directions square to n: Duff et al. 2017, Building an orthonormal basis, revisited.
void find_axes(const glm::vec3& n, glm::vec3& u, glm::vec3& v) {
  const float sign = std::copysign(1.0F, n.z);
  const float a = -1 / (sign + n.z), b = n.x * n.y * a;
  u = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  v = {b, sign + n.y * n.y * a, -n.y};
}

}  // namespace

// Up to kMaxSamples receivers and what is found of them; one for each call.
class DirectLight::Batch {
 public:
  Batch(const DirectLight& owner, std::span<const Receiver> receivers, bool of_back)
      : owner_(owner), count_(receivers.size()) {
    samples_.ray = owner.ray_;
    set_count(samples_, count_);
    samples_.position_error = owner.position_error_;
    for (std::size_t i = 0; i < samples_.group_count * kGroupSize; ++i)
      set(i, receivers[std::min(i, count_ - 1)], of_back ? -1.0F : 1.0F);
  }

  void add(const BakedLight& light, std::span<glm::vec3> irradiance) {
    owner_.find_irradiance_(light.bound, samples_, points_, nullptr, irradiance_);
    arrival_.is_tinted = false;
    arrival_.alpha.fill(1);
    const std::size_t groups = samples_.group_count;
    if (light.shadow != nullptr) {
      light.shadow->find_arrival(samples_, std::span(irradiance_.lit).first(groups), arrival_);
      release_non_receivers();
    }
    const shadow::Arrival* seen = &arrival_;
    if (!light.tone.is_physical()) {
      light.tone.apply(arrival_, groups, toned_);
      seen = &toned_;
    }
    const float fill = light.tone.fill();
    for (std::size_t i = 0; i < count_; ++i) {
      if ((irradiance_.lit[i / kGroupSize] >> (i % kGroupSize) & 1U) == 0) continue;
      const glm::vec3 arriving =
          seen->is_tinted ? glm::vec3(seen->r[i], seen->g[i], seen->b[i]) : glm::vec3(seen->alpha[i]);
      const glm::vec3 share = arriving + fill * (glm::vec3(1) - arriving);
      const glm::vec3 unhindered(irradiance_.r[i], irradiance_.g[i], irradiance_.b[i]);
      irradiance[i] += unhindered * share * (irradiance_.cosine[i] * light.share);
    }
  }

 private:
  void set(std::size_t i, const Receiver& receiver, float side) {
    const glm::dvec3 offset = (glm::dvec3(receiver.position_ws) - glm::dvec3(owner_.ray_.ray_0)) / kUnit;
    samples_.x[i] = static_cast<float>(offset.x);
    samples_.y[i] = static_cast<float>(offset.y);
    samples_.q[i] = static_cast<float>(offset.z);
    samples_.id[i] = receiver.id;
    samples_.dq_dx[i] = samples_.dq_dy[i] = 0;
    const auto write = [i](auto& x, auto& y, auto& z, const glm::vec3& v) {
      x[i] = v.x;
      y[i] = v.y;
      z[i] = v.z;
    };
    write(samples_.x_ws, samples_.y_ws, samples_.z_ws, receiver.position_ws);
    write(samples_.normal_x_ws, samples_.normal_y_ws, samples_.normal_z_ws, side * receiver.normal_ws);
    write(points_.normal_x_ws, points_.normal_y_ws, points_.normal_z_ws, side * receiver.shading_normal_ws);
  }

  // Objects that receive no shadow are fully lit.
  void release_non_receivers() {
    if (owner_.frame_.all_receive_shadows) return;
    for (std::size_t i = 0; i < count_; ++i) {
      if ((owner_.frame_.clusters[cluster_of(samples_.id[i])].flags & kReceivesShadow) != 0) continue;
      arrival_.alpha[i] = arrival_.r[i] = arrival_.g[i] = arrival_.b[i] = 1;
    }
  }

  const DirectLight& owner_;
  std::size_t count_;
  shadow::SurfaceSamples samples_;
  shade::SurfacePoints points_;
  shade::Irradiance irradiance_;
  shadow::Arrival arrival_, toned_;
};

DirectLight::DirectLight(const frame::Frame& frame, const std::shared_ptr<const trace::RayScene>& rays,
                         int points, InstructionSet set)
    : frame_(frame),
      ray_(ray_about(0.5 * (glm::dvec3(frame.bounds.low) + glm::dvec3(frame.bounds.high)))),
      find_irradiance_(shade::find_irradiance_for(set)) {
  float farthest = 0;
  for (int k = 0; k < 3; ++k)
    farthest = std::max({farthest, std::abs(frame.bounds.low[k]), std::abs(frame.bounds.high[k])});
  position_error_ = farthest * kRounding;
  if (!std::ranges::any_of(frame.lights,
                           [](const auto& placed) { return light::has_samples(*placed.light); }))
    points = 1;
  plans_.reserve(static_cast<std::size_t>(points));  // lights point into their plans
  for (int i = 0; i < points; ++i)
    plans_.push_back(light::make_light_plan(frame, {ShadowTechnique::raytraced, {i, points}, nullptr}));
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    for (std::size_t k = 0; k < plans_[i].lights.size(); ++k) {
      light::PlannedLight& planned = plans_[i].lights[k];
      const Light& light = *frame.lights[k].light;
      const bool has_samples = light::has_samples(light);
      if (light.blend != BlendMode::add || (i > 0 && !has_samples)) continue;
      if (planned.technique != ShadowTechnique::none) planned.technique = ShadowTechnique::raytraced;
      lights_.push_back({shade::BoundLight(*planned.placed, ray_, ShadingModel::pbr, 1),
                         make_shadow(planned, frame, rays, set), shade::ShadowTone(light.shadow),
                         has_samples ? 1.0F / static_cast<float>(points) : 1.0F});
    }
  }
}

void DirectLight::add(std::span<const Receiver> receivers, bool of_back,
                      std::span<glm::vec3> irradiance) const {
  for (std::size_t first = 0; first < receivers.size(); first += kMaxSamples) {
    const std::size_t count = std::min(kMaxSamples, receivers.size() - first);
    const auto batch = std::make_unique<Batch>(*this, receivers.subspan(first, count), of_back);
    for (const BakedLight& light : lights_) batch->add(light, irradiance.subspan(first, count));
  }
}

OcclusionRays::OcclusionRays(const trace::RayScene& rays, int count, double distance)
    : rays_(rays), distance_(static_cast<float>(distance)) {
  for (int i = 0; i < count; ++i) {
    // Even over a disc, and lifted from it: by the cosine over the hemisphere (Malley's method).
    const LatticePoint point = lattice_point({i, count});
    const double radius = std::sqrt(point.u), angle = 2 * kPi * point.v;
    directions_.emplace_back(radius * cosine(angle), radius * sine(angle), std::sqrt(1 - point.u));
  }
}

float OcclusionRays::openness(std::span<const Receiver> receivers, bool of_back) const {
  const auto shares = static_cast<int>(std::min(receivers.size(), directions_.size()));
  float sum = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i)
    sum += openness(receivers[i], of_back, {static_cast<int>(i) % shares, shares});
  return sum / static_cast<float>(receivers.size());
}

// Every count-th direction: these fill the hemisphere evenly, too.
float OcclusionRays::openness(const Receiver& receiver, bool of_back, SampleIndex share) const {
  const glm::vec3 normal = (of_back ? -1.0F : 1.0F) * receiver.shading_normal_ws;
  const glm::vec3 front = (of_back ? -1.0F : 1.0F) * receiver.normal_ws;
  glm::vec3 u, v;
  find_axes(normal, u, v);
  float farthest = 0;
  for (int k = 0; k < 3; ++k) farthest = std::max(farthest, std::abs(receiver.position_ws[k]));
  const float near = 2 * farthest * kRounding;
  int open = 0, all = 0;
  for (auto i = static_cast<std::size_t>(share.index); i < directions_.size();
       i += static_cast<std::size_t>(share.count)) {
    const glm::vec3& local = directions_[i];
    const glm::vec3 direction = u * local.x + v * local.y + normal * local.z;
    // Smooth normals send some rays below the surface itself: these say nothing.
    if (!(glm::dot(direction, front) > 0)) continue;
    ++all;
    open += rays_.is_blocked(receiver.position_ws, direction, near, distance_, receiver.id) ? 0 : 1;
  }
  return all == 0 ? 1.0F : static_cast<float>(open) / static_cast<float>(all);
}

}  // namespace laterna::bake
