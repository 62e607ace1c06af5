// Photographs at surface samples.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/photograph_blend.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "image/texture_lookup-inl.h"
#include "shade/photograph_blend.h"
#include "shadow/projected_view-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using image::HWY_NAMESPACE::Footprint;
using image::HWY_NAMESPACE::LookUp;
using image::HWY_NAMESPACE::LookUpAlpha;
using shadow::kGroupSize;
using shadow::HWY_NAMESPACE::Evaluate;

// Where a photograph's weight has been feathered away it still counts this much: what no other sees keeps its colour.
constexpr float kLeastFeather = 1e-3F;
// Of 1 − cos of the angle between two directions of view: below it they are the same.
constexpr float kSameDirection = 1e-4F;
// Weights are held to what single precision can add and divide.
constexpr float kLeastWeight = 1e-30F, kMostWeight = 1e30F;

template <class Samples>
HWY_INLINE Vector3 Load3(const Samples& x, const Samples& y, const Samples& z, std::size_t i) {
  const FloatTag d;
  return {hn::Load(d, x.data() + i), hn::Load(d, y.data() + i), hn::Load(d, z.data() + i)};
}

// Homogeneous coordinates of the picture (equation 6 of Segal et al. 1992).
struct PicturePoint {
  FloatVector s, t, w;
  FloatMask is_ahead;
};
HWY_INLINE PicturePoint FindPicturePoint(const BoundPhotograph& photograph,
                                         const shadow::SurfaceSamples& samples, std::size_t i) {
  const FloatTag d;
  const auto x = hn::Load(d, samples.x.data() + i), y = hn::Load(d, samples.y.data() + i),
             q = hn::Load(d, samples.q.data() + i);
  const shadow::ProjectedView& v = photograph.picture_position;
  const auto W = Evaluate(v.divisor, x, y, q);
  const auto h = Evaluate(photograph.homogeneous, x, y, q);
  PicturePoint point;
  point.is_ahead = W > h * Splat(1e-6F);
  point.w = hn::IfThenElse(point.is_ahead, W, h);
  point.s = Evaluate(v.x, x, y, q) / point.w;
  point.t = Evaluate(v.y, x, y, q) / point.w;
  return point;
}

void find_faced(const BoundPhotograph& photograph, const shadow::SurfaceSamples& samples,
                std::span<std::uint16_t> faced) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const std::size_t i = group * kGroupSize + k;
      const PicturePoint point = FindPicturePoint(photograph, samples, i);
      const Vector3 to_camera =
          Splat3(photograph.position_ws) - Load3(samples.x_ws, samples.y_ws, samples.z_ws, i);
      const Vector3 normal = Load3(samples.normal_x_ws, samples.normal_y_ws, samples.normal_z_ws, i);
      const auto in_width = hn::And(point.s >= zero, point.s <= one);
      const auto in_height = hn::And(point.t >= zero, point.t <= one);
      const auto faces = hn::And(point.is_ahead, Dot(normal, to_camera) > zero);
      bits |= BitsOf(hn::And(hn::And(in_width, in_height), faces)) << k;
    }
    faced[group] = static_cast<std::uint16_t>(bits & samples.active[group]);
  }
}

// The pixel's footprint in the picture.
HWY_INLINE Footprint FindFootprint(const BoundPhotograph& photograph, const shadow::SurfaceSamples& samples,
                                   std::size_t i) {
  const FloatTag d;
  const shadow::ProjectedView& v = photograph.picture_position;
  const PicturePoint point = FindPicturePoint(photograph, samples, i);
  const auto q_dx = hn::Load(d, samples.dq_dx.data() + i), q_dy = hn::Load(d, samples.dq_dy.data() + i);
  const auto slope = [](const shadow::ProjectedRow& row, float at, FloatVector dq)
                         HWY_ATTR { return Splat(at) + Splat(row.at_q) * dq; };
  const auto w_dx = slope(v.divisor, v.divisor.at_x, q_dx), w_dy = slope(v.divisor, v.divisor.at_y, q_dy);
  Footprint f;
  f.u = point.s;
  f.v = point.t;
  f.du_dx = (slope(v.x, v.x.at_x, q_dx) - f.u * w_dx) / point.w;
  f.dv_dx = (slope(v.y, v.y.at_x, q_dx) - f.v * w_dx) / point.w;
  f.du_dy = (slope(v.x, v.x.at_y, q_dy) - f.u * w_dy) / point.w;
  f.dv_dy = (slope(v.y, v.y.at_y, q_dy) - f.v * w_dy) / point.w;
  return f;
}

// (ρ cos θ)², PhotographBlend. A surface at true distance d, z along the axis, is ρ = N cos θ d / z³ pixels per square
// metre, N of them at 1 m.
HWY_INLINE FloatVector WeightOf(const BoundPhotograph& photograph, const shadow::SurfaceSamples& samples,
                                const SurfacePoints& points, std::size_t i) {
  const Vector3 to_camera =
      Splat3(photograph.position_ws) - Load3(samples.x_ws, samples.y_ws, samples.z_ws, i);
  // The shading normal: facets of a smooth surface do not show.
  const Vector3 normal = Load3(points.normal_x_ws, points.normal_y_ws, points.normal_z_ws, i);
  const auto distance = hn::Max(hn::Sqrt(Dot(to_camera, to_camera)), Splat(1e-9F));
  const auto along = hn::Max(Dot(to_camera, Splat3(photograph.forward_ws)) * Splat(-1.0F), Splat(1e-9F));
  const Vector3 direction = to_camera * (Splat(1.0F) / distance);
  const auto cosine = Saturate(Dot(normal, direction));
  const auto density = Splat(photograph.pixels_at_unit) * (cosine * (distance / along)) / (along * along);
  const auto root = density * cosine;
  auto weight = root * root;
  if (photograph.by_view) {
    const Vector3 to_eye = Load3(points.to_eye_x_ws, points.to_eye_y_ws, points.to_eye_z_ws, i);
    const auto apart = hn::Max(Splat(1.0F) - Dot(to_eye, direction), Splat(0.0F)) + Splat(kSameDirection);
    weight = weight / (apart * apart);
  }
  return weight;
}

void add_photograph(const BoundPhotograph& photograph, const shadow::SurfaceSamples& samples,
                    const SurfacePoints& points, std::span<const std::uint16_t> seen, PhotographSums& sums,
                    PhotographColor& color) {
  const FloatTag d;
  const auto one = Splat(1.0F);
  Sampler sampler;
  sampler.wrap_u = sampler.wrap_v = Wrap::clamp;
  const Vector3 gain = Splat3(photograph.gain);
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const std::size_t i = group * kGroupSize + k;
      auto sees = MaskFromBits(std::uint32_t{seen[group]} >> k);
      if (hn::AllFalse(d, sees)) {
        hn::Store(hn::Zero(d), d, color.weight.data() + i);
        continue;
      }
      const Footprint footprint = FindFootprint(photograph, samples, i);
      if (photograph.picture->has_alpha()) {
        const auto alpha = LookUpAlpha(*photograph.picture, sampler, photograph.anisotropy, footprint);
        sees = hn::And(sees, alpha >= Splat(0.5F));
      }
      const Vector3 found = LookUp(*photograph.picture, sampler, photograph.anisotropy, footprint);
      auto weight = WeightOf(photograph, samples, points, i);
      if (photograph.feather != nullptr) {
        const auto feather = LookUp(*photograph.feather, sampler, 1, footprint).x;
        weight = weight * (Saturate(feather) + Splat(kLeastFeather));
      }
      weight = hn::Min(hn::Max(weight, Splat(kLeastWeight)), Splat(kMostWeight));
      weight = hn::IfThenElseZero(sees, weight);
      const auto add = [&](FloatVector value, shadow::SampleArray<float>& sum)
                           HWY_ATTR { hn::Store(hn::Load(d, sum.data() + i) + value, d, sum.data() + i); };
      add(found.x * gain.x * weight, sums.r);
      add(found.y * gain.y * weight, sums.g);
      add(found.z * gain.z * weight, sums.b);
      add(weight, sums.weight);
      add(hn::IfThenElseZero(sees, one), sums.seen);
      hn::Store(found.x, d, color.r.data() + i);
      hn::Store(found.y, d, color.g.data() + i);
      hn::Store(found.z, d, color.b.data() + i);
      hn::Store(weight, d, color.weight.data() + i);
    }
  }
}

void take_photographs(const PhotographSums& sums, const glm::vec3& unseen, std::size_t groups,
                      SurfacePoints& points) {
  const FloatTag d;
  for (std::size_t i = 0; i < groups * kGroupSize; i += kLanes) {
    const auto weight = hn::Load(d, sums.weight.data() + i);
    const auto is_seen = weight > Splat(0.0F);
    const auto safe = hn::IfThenElse(is_seen, weight, Splat(1.0F));
    const auto take = [&](const shadow::SampleArray<float>& sum, float otherwise,
                          shadow::SampleArray<float>& base) HWY_ATTR {
      const auto mean = hn::Load(d, sum.data() + i) / safe;
      hn::Store(hn::IfThenElse(is_seen, mean, Splat(otherwise)), d, base.data() + i);
    };
    take(sums.r, unseen.x, points.base_r);
    take(sums.g, unseen.y, points.base_g);
    take(sums.b, unseen.z, points.base_b);
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(find_faced)
LATERNA_KERNEL_TABLE(add_photograph)
LATERNA_KERNEL_TABLE(take_photographs)
}  // namespace laterna::shade
#endif
