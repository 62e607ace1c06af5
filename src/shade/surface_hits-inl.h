// The points of its surface that a batch of samples shows.
#if defined(LATERNA_SHADE_SURFACE_HITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADE_SURFACE_HITS_INL_H_
#undef LATERNA_SHADE_SURFACE_HITS_INL_H_
#else
#define LATERNA_SHADE_SURFACE_HITS_INL_H_
#endif

#include <hwy/highway.h>

#include "frame/triangle_corners-inl.h"
#include "shade/relief_hit-inl.h"
#include "shade/surface_hit-inl.h"
#include "shade/surface_points.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Hits of kLanes samples and what they lie on. kUniform: all on one triangle; kOnRelief: on its relief, unless they show its back.
template <bool kUniform, bool kOnRelief>
struct SurfaceHits {
  const frame::HWY_NAMESPACE::TriangleCorners<kUniform>& corners;
  const Facet& facet;
  Hit hit;
};

// Samples of a relief lie below their triangles.
template <class Visitor>
HWY_NOINLINE void VisitReliefHits(const PointSource& source, const PixelRays& rays,
                                  const shadow::SurfaceSamples& s, const Visitor& visit) {
  const FloatTag d;
  for (std::size_t i = 0; i < s.group_count * shadow::kGroupSize; i += kLanes) {
    const frame::HWY_NAMESPACE::TriangleCorners<false> corners(*source.frame, s.id.data() + i);
    const Facet facet = FindFacet<false>(rays, corners.Positions());
    const Hit hit = FindReliefHit(rays, facet, hn::Load(d, s.x.data() + i), hn::Load(d, s.y.data() + i),
                                  hn::Load(d, s.q.data() + i));
    visit(SurfaceHits<false, true>{corners, facet, hit}, i);
  }
}

// Calls visit(hits, i) for samples i … i + kLanes − 1, vector by vector. All that is read of a surface at its samples is read
// at these hits, so that its textures, layers, lobes and light maps lie on one another: on a relief straight above the point
// that is seen, even beyond the triangle's sides; elsewhere on the triangle.
template <class Visitor>
HWY_INLINE void VisitSurfaceHits(const PointSource& source, const frame::Surface& surface,
                                 const shadow::SurfaceSamples& s, const Visitor& visit) {
  const FloatTag d;
  const PixelRays rays(*source.view);
  if (HWY_UNLIKELY(surface.relief.field != nullptr)) return VisitReliefHits(source, rays, s, visit);
  const auto find_hit = [&](const Facet& facet, std::size_t i) HWY_ATTR {
    return FindHit(rays, facet, hn::Load(d, s.x.data() + i), hn::Load(d, s.y.data() + i),
                   hn::Load(d, s.q.data() + i), source.interpolation);
  };
  const TriangleId* ids = s.id.data();
  const std::size_t end = s.group_count * shadow::kGroupSize;
  for (std::size_t first = 0; first < end;) {
    if (IsOneTriangle(ids + first)) {
      const TriangleId id = ids[first];
      const frame::HWY_NAMESPACE::TriangleCorners<true> corners(*source.frame, &id);
      const Facet facet = FindFacet<true>(rays, corners.Positions());
      // Wide triangles fill many groups one after the other.
      do {
        for (std::size_t i = first; i < first + shadow::kGroupSize; i += kLanes)
          visit(SurfaceHits<true, false>{corners, facet, find_hit(facet, i)}, i);
        first += shadow::kGroupSize;
      } while (first < end && ids[first] == id && IsOneTriangle(ids + first));
    } else {
      for (std::size_t i = first; i < first + shadow::kGroupSize; i += kLanes) {
        const frame::HWY_NAMESPACE::TriangleCorners<false> corners(*source.frame, ids + i);
        const Facet facet = FindFacet<false>(rays, corners.Positions());
        visit(SurfaceHits<false, false>{corners, facet, find_hit(facet, i)}, i);
      }
      first += shadow::kGroupSize;
    }
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
