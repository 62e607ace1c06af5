#include "bake/luxel_surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "light/decal_plan.h"
#include "shade/layer_painter.h"
#include "shade/surface_points.h"
#include "shadow/ray_traced.h"

namespace laterna::bake {

using shadow::kGroupSize;
using shadow::kMaxSamples;

namespace {

constexpr float kPi32 = 3.14159265F;
// Levels of mip chains are means of squares, and soft: half a level finer is as sharp as can be shown.
constexpr double kPixelOfSide = 0.7071067811865476;
// By so much one side of a pixel is longer than the other on a surface that is seen the least squarely: √3, from a corner.
constexpr int kAnisotropy = 2;

// The side that a normal looks to: that of its largest part.
std::size_t facing_side(const glm::vec3& normal_ws) {
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(normal_ws[k]) > std::abs(normal_ws[axis])) axis = k;
  }
  return static_cast<std::size_t>(2 * axis + (normal_ws[axis] < 0 ? 1 : 0));
}

// From outside the scene, along an axis. Nothing is cut off at the rims, so that two pixels make as good a picture as many.
raster::RasterView look_from(std::size_t side, const frame::Bounds& bounds, double pixel_side) {
  const glm::dvec3 low(bounds.low), high(bounds.high);
  const double radius = glm::length(high - low) + pixel_side;
  const auto axis = static_cast<int>(side / 2);
  glm::dvec3 toward(0), up(0);
  toward[axis] = side % 2 == 0 ? 1 : -1;
  up[(axis + 1) % 3] = 1;
  const glm::dvec3 middle = 0.5 * (low + high);
  View view;
  view.pose = *Pose::look_at(middle + radius * toward, middle, up);
  view.projection = Projection::orthographic(pixel_side, pixel_side, 0, 2 * radius);
  return {view, 2, 2};
}

}  // namespace

// What all receivers that are seen from one side share.
class LuxelSurfaces::Side {
 public:
  Side(const frame::Frame& frame, const std::vector<light::PlannedLight>& decal_plan,
       const std::shared_ptr<const trace::RayScene>& rays, const raster::RasterView& from)
      : view(from), source{&frame, &view, Interpolation::perspective, kAnisotropy} {
    for (const light::PlannedLight& planned : decal_plan) {
      std::unique_ptr<shadow::ShadowTechnique> visibility;
      if (planned.technique != ShadowTechnique::none)
        visibility = std::make_unique<shadow::RayTracedShadow>(planned, rays);
      decals.push_back(
          {shade::BoundLight(*planned.placed, view.homogeneous_ray(), ShadingModel::papers, kAnisotropy),
           shade::LightReach(*planned.placed, ShadingModel::papers), std::move(visibility)});
    }
  }
  ~Side() = default;
  Side(const Side&) = delete;
  Side& operator=(const Side&) = delete;

  const raster::RasterView view;
  const shade::PointSource source;
  std::vector<shade::ShaderDecal> decals;
};

// Up to kMaxSamples receivers of one surface, seen from one side.
class LuxelSurfaces::Batch {
 public:
  Batch(const Side& side, InstructionSet set)
      : side_(side),
        painter_(side.source, side.decals, set),
        find_surface_points_(shade::find_surface_points_for(set)) {
    samples_.ray = side.view.homogeneous_ray();
  }

  void find(const frame::Surface& surface, std::span<const Receiver> receivers,
            std::span<const std::uint32_t> which) {
    set_count(samples_, which.size());
    for (std::size_t i = 0; i < samples_.group_count * kGroupSize; ++i)
      place(i, receivers[which[std::min(i, which.size() - 1)]]);
    has_occlusion_ = surface.occlusion_texture.chain != nullptr;
    find_surface_points_(side_.source, surface, samples_, points_);
    for (const frame::LayerBinding& layer : surface.layers) painter_.paint(surface, layer, samples_, points_);
  }

  [[nodiscard]] MattSurface at(std::size_t i) const {
    const glm::vec3 base(points_.base_r[i], points_.base_g[i], points_.base_b[i]);
    return {glm::clamp(base * (1 - points_.metallic[i]), 0.0F, 1.0F),
            kPi32 * glm::vec3(points_.emissive_r[i], points_.emissive_g[i], points_.emissive_b[i]),
            {points_.normal_x_ws[i], points_.normal_y_ws[i], points_.normal_z_ws[i]},
            has_occlusion_ ? std::optional(points_.occlusion[i]) : std::nullopt};
  }

 private:
  void place(std::size_t i, const Receiver& receiver) {
    const raster::RasterView& view = side_.view;
    const glm::dvec3 from_eye = glm::dvec3(receiver.position_ws) - view.eye_ws;
    samples_.x[i] = static_cast<float>(glm::dot(view.x_row, from_eye) + view.x_add);
    samples_.y[i] = static_cast<float>(glm::dot(view.y_row, from_eye) + view.y_add);
    samples_.q[i] = static_cast<float>(glm::dot(view.w_row, from_eye) + view.w_add);
    samples_.id[i] = receiver.id;
  }

  const Side& side_;
  shade::LayerPainter painter_;
  shade::FindSurfacePoints find_surface_points_;
  shadow::SurfaceSamples samples_;
  shade::SurfacePoints points_;
  bool has_occlusion_ = false;
};

LuxelSurfaces::LuxelSurfaces(const frame::Frame& frame, const std::shared_ptr<const trace::RayScene>& rays,
                             double receiver_side, InstructionSet set)
    : frame_(frame), set_(set), decals_(light::make_decal_plan(frame, ShadowTechnique::raytraced)) {
  for (std::size_t side = 0; side < sides_.size(); ++side)
    sides_[side] = std::make_unique<const Side>(frame, decals_, rays,
                                                look_from(side, frame.bounds, kPixelOfSide * receiver_side));
}

LuxelSurfaces::~LuxelSurfaces() = default;

std::vector<MattSurface> LuxelSurfaces::find(std::span<const Receiver> receivers, bool of_back) const {
  const auto material_of = [&](std::uint32_t i) {
    return frame_.clusters[cluster_of(receivers[i].id)].material;
  };
  const auto seen_from = [&](std::uint32_t i) {
    return facing_side(of_back ? -receivers[i].normal_ws : receivers[i].normal_ws);
  };
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < receivers.size(); ++i) {
    if (receivers[i].id != kNoTriangle) order.push_back(i);
  }
  std::ranges::stable_sort(
      order, {}, [&](std::uint32_t i) { return std::pair(seen_from(i), std::uint32_t{material_of(i)}); });
  std::vector<MattSurface> found(receivers.size());
  std::unique_ptr<Batch> batch;
  std::size_t side = sides_.size();
  for (std::size_t first = 0; first < order.size();) {
    const std::size_t next_side = seen_from(order[first]);
    const auto material = material_of(order[first]);
    std::size_t end = first + 1;
    while (end < order.size() && end - first < kMaxSamples && material_of(order[end]) == material &&
           seen_from(order[end]) == next_side)
      ++end;
    if (next_side != side) batch = std::make_unique<Batch>(*sides_[next_side], set_);
    side = next_side;
    const std::span<const std::uint32_t> which = std::span(order).subspan(first, end - first);
    const frame::Surface& surface = frame_.surfaces[material];
    if (surface.relief.field == nullptr) {
      batch->find(surface, receivers, which);
    } else {
      frame::Surface flat = surface;
      flat.relief = {};
      batch->find(flat, receivers, which);
    }
    for (std::size_t i = 0; i < which.size(); ++i) found[which[i]] = batch->at(i);
    first = end;
  }
  return found;
}

}  // namespace laterna::bake
