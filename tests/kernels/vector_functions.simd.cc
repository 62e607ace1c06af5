// Runs the functions of the *-inl.h files over arrays.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/vector_functions.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/record_gather-inl.h"
#include "base/vectors-inl.h"
#include "frame/surface_alpha-inl.h"
#include "image/texture_lookup-inl.h"
#include "kernels/vector_functions.h"
#include "shadow/depth_comparison-inl.h"
#include "shadow/projected_view-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

FloatVector At(Numbers values, std::size_t i) { return hn::Load(FloatTag(), values.data() + i); }

void exponentials(Numbers x, Results result) {
  for (std::size_t i = 0; i < x.size(); i += kLanes)
    hn::Store(Exponential2(At(x, i)), FloatTag(), result.data() + i);
}

void logarithms(Numbers x, Results result) {
  for (std::size_t i = 0; i < x.size(); i += kLanes)
    hn::Store(Logarithm2(At(x, i)), FloatTag(), result.data() + i);
}
void cosines(Numbers x, Results result) {
  for (std::size_t i = 0; i < x.size(); i += kLanes)
    hn::Store(Cosine(At(x, i)), FloatTag(), result.data() + i);
}

void saturated(Numbers x, Results result) {
  for (std::size_t i = 0; i < x.size(); i += kLanes)
    hn::Store(Saturate(At(x, i)), FloatTag(), result.data() + i);
}

void powers(Numbers x, Numbers y, Results result) {
  for (std::size_t i = 0; i < x.size(); i += kLanes)
    hn::Store(Power(At(x, i), At(y, i)), FloatTag(), result.data() + i);
}

void gather_probes(const RecordProbes& p) {
  const FloatTag d;
  for (std::size_t i = 0; i < p.index.size(); i += kLanes) {
    const auto index = hn::Load(IntTag(), p.index.data() + i);
    const auto record = GatherRecords(p.records.data(), index);
    hn::Store(record.x, d, p.x.data() + i);
    hn::Store(record.y, d, p.y.data() + i);
    hn::Store(record.z, d, p.z.data() + i);
    hn::Store(hn::ConvertTo(d, GatherRecords(p.counts.data(), index).z), d, p.last_count.data() + i);
  }
}

void normalise(const Directions& directions) {
  for (std::size_t i = 0; i < directions.x.size(); i += kLanes) {
    const Vector3 unit = Normalised({At(directions.x, i), At(directions.y, i), At(directions.z, i)});
    hn::Store(unit.x, FloatTag(), directions.unit_x.data() + i);
    hn::Store(unit.y, FloatTag(), directions.unit_y.data() + i);
    hn::Store(unit.z, FloatTag(), directions.unit_z.data() + i);
  }
}

void compare_depths(Numbers stored, Numbers tested, Numbers bias, Results result) {
  for (std::size_t i = 0; i < stored.size(); i += kLanes) {
    const auto is_lit = shadow::HWY_NAMESPACE::IsLit(At(stored, i), At(tested, i), At(bias, i));
    hn::Store(hn::IfThenElseZero(is_lit, Splat(1.0F)), FloatTag(), result.data() + i);
  }
}

void evaluate_row(const RowPoints& points) {
  for (std::size_t i = 0; i < points.x.size(); i += kLanes) {
    const auto value =
        shadow::HWY_NAMESPACE::Evaluate(*points.row, At(points.x, i), At(points.y, i), At(points.q, i));
    hn::Store(value, FloatTag(), points.value.data() + i);
  }
}

void look_up_texture(const TextureProbes& p) {
  using image::HWY_NAMESPACE::Footprint;
  using image::HWY_NAMESPACE::LookUp;
  using image::HWY_NAMESPACE::LookUpAlpha;
  for (std::size_t i = 0; i < p.u.size(); i += kLanes) {
    const Footprint footprint = {At(p.u, i),     At(p.v, i),     At(p.du_dx, i),
                                 At(p.dv_dx, i), At(p.du_dy, i), At(p.dv_dy, i)};
    const Vector3 colour = LookUp(*p.chain, p.sampler, p.anisotropy, footprint);
    hn::Store(colour.x, FloatTag(), p.r.data() + i);
    hn::Store(colour.y, FloatTag(), p.g.data() + i);
    hn::Store(colour.z, FloatTag(), p.b.data() + i);
    hn::Store(LookUpAlpha(*p.chain, p.sampler, p.anisotropy, footprint), FloatTag(), p.a.data() + i);
  }
}

void find_holes(const SurfaceProbes& p) {
  const auto zero = Splat(0.0F);
  for (std::size_t i = 0; i < p.b.size(); i += kLanes) {
    const frame::HWY_NAMESPACE::TriangleCorners<false> corners(*p.frame, p.ids.data() + i);
    const frame::HWY_NAMESPACE::Weights weights = {At(p.b, i), At(p.c, i), zero, zero, zero, zero};
    const auto holes = frame::HWY_NAMESPACE::FindHoles(*p.frame, corners, weights, zero == zero);
    hn::Store(hn::IfThenElseZero(holes, Splat(1.0F)), FloatTag(), p.is_hole.data() + i);
  }
}

}  // namespace laterna::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::kernels {
LATERNA_KERNEL_TABLE(exponentials)
LATERNA_KERNEL_TABLE(logarithms)
LATERNA_KERNEL_TABLE(cosines)
LATERNA_KERNEL_TABLE(saturated)
LATERNA_KERNEL_TABLE(powers)
LATERNA_KERNEL_TABLE(gather_probes)
LATERNA_KERNEL_TABLE(normalise)
LATERNA_KERNEL_TABLE(compare_depths)
LATERNA_KERNEL_TABLE(evaluate_row)
LATERNA_KERNEL_TABLE(look_up_texture)
LATERNA_KERNEL_TABLE(find_holes)
}  // namespace laterna::kernels
#endif
