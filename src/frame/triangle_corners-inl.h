// The corners of N triangles: positions and attributes, interpolated at N samples.
#if defined(LATERNA_FRAME_TRIANGLE_CORNERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_FRAME_TRIANGLE_CORNERS_INL_H_
#undef LATERNA_FRAME_TRIANGLE_CORNERS_INL_H_
#else
#define LATERNA_FRAME_TRIANGLE_CORNERS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <type_traits>

#include "base/record_gather-inl.h"
#include "base/vectors-inl.h"
#include "frame/frame.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::frame::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Values at the three corners.
struct CornerValues {
  FloatVector a, b, c;
};
struct CornerPairs {
  CornerValues x, y;
};
struct CornerVectors {
  Vector3 a, b, c;
};
// Of four components: the fourth apart.
struct CornerVectorsAndValues {
  CornerVectors xyz;
  CornerValues w;
};

// Weights of corners b and c (a has the rest), and their change from one pixel to the next.
struct Weights {
  FloatVector b, c;
  FloatVector db_dx, db_dy, dc_dx, dc_dy;
};

struct Interpolated {
  FloatVector value, d_dx, d_dy;
};

HWY_INLINE FloatVector Interpolate(const CornerValues& v, const Weights& w) {
  return v.a + ((v.b - v.a) * w.b + (v.c - v.a) * w.c);
}
HWY_INLINE Interpolated InterpolateWithSlope(const CornerValues& v, const Weights& w) {
  const auto b = v.b - v.a, c = v.c - v.a;
  return {v.a + (b * w.b + c * w.c), b * w.db_dx + c * w.dc_dx, b * w.db_dy + c * w.dc_dy};
}
HWY_INLINE Vector3 Interpolate(const CornerVectors& v, const Weights& w) {
  const Vector3 b = v.b - v.a, c = v.c - v.a;
  return v.a + (b * w.b + c * w.c);
}

// Reads corners. Where all lanes lie on one triangle (kUniform), as most do, each value is loaded once; otherwise it
// is gathered. Both give the same numbers.
template <bool kUniform>
class TriangleCorners {
 public:
  TriangleCorners(const Frame& frame, const TriangleId* ids) : frame_(frame) {
    if constexpr (kUniform) {
      const std::uint32_t packed = frame.corners[*ids];
      cluster_ = cluster_of(*ids);
      first_ = frame.clusters[cluster_].first_vertex;
      for (unsigned i = 0; i < 3; ++i) local_[i] = packed >> (8 * i) & 255U;
    } else {
      Gather(hn::LoadU(IntTag(), reinterpret_cast<const std::int32_t*>(ids)));
    }
  }
  TriangleCorners(const Frame& frame, IntVector ids) requires(!kUniform) : frame_(frame) { Gather(ids); }

  HWY_INLINE CornerVectors Positions() const { return At(frame_.positions_ws.data(), First()); }

  // Index of each lane's cluster.
  HWY_INLINE IntVector Clusters() const requires(!kUniform) { return clusters_; }
  // Index of a stream's first vertex for each lane's cluster, and whether the cluster has that stream.
  struct Stream {
    std::conditional_t<kUniform, std::uint32_t, IntVector> first;
    std::conditional_t<kUniform, bool, FloatMask> present;
    [[nodiscard]] HWY_INLINE bool IsMissing() const {
      if constexpr (kUniform) {
        return !present;
      } else {
        return hn::AllFalse(FloatTag(), present);
      }
    }
    // `value` where the stream is there, `otherwise` where it is not.
    HWY_INLINE FloatVector OrElse(FloatVector value, FloatVector otherwise) const {
      if constexpr (kUniform) {
        return value;
      } else {
        return hn::IfThenElse(present, value, otherwise);
      }
    }
  };
  // `field`: which word of ClusterStreams.
  HWY_INLINE Stream StreamAt(std::size_t field) const {
    static_assert(sizeof(ClusterStreams) % sizeof(std::uint32_t) == 0);
    constexpr std::size_t kWords = sizeof(ClusterStreams) / sizeof(std::uint32_t);
    const auto* words = reinterpret_cast<const std::uint32_t*>(frame_.streams.data());
    if constexpr (kUniform) {
      const std::uint32_t first = words[cluster_ * kWords + field];
      return {first, first != kNoStream};
    } else {
      const IntTag di;
      const auto first =
          hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(words),
                          clusters_ * SplatInt(kWords) + SplatInt(static_cast<std::int32_t>(field)));
      const auto missing = first == SplatInt(-1);
      // Lanes without the stream read its beginning, and their value is not used.
      return {hn::IfThenZeroElse(missing, first), hn::RebindMask(FloatTag(), hn::Not(missing))};
    }
  }

  // Values of a stream whose first vertex is `first`.
  template <class First>
  HWY_INLINE CornerPairs At(const glm::vec2* values, const First& first) const {
    const auto a = At(values, first, 0), b = At(values, first, 1), c = At(values, first, 2);
    return {{a.x, b.x, c.x}, {a.y, b.y, c.y}};
  }
  template <class First>
  HWY_INLINE CornerVectors At(const glm::vec3* values, const First& first) const {
    const auto a = At(values, first, 0), b = At(values, first, 1), c = At(values, first, 2);
    return {{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}};
  }
  template <class First>
  HWY_INLINE CornerVectorsAndValues At(const glm::vec4* values, const First& first) const {
    const auto a = At(values, first, 0), b = At(values, first, 1), c = At(values, first, 2);
    return {{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}, {a.w, b.w, c.w}};
  }

 private:
  // Of one corner; what values have fewer than four components of is of no use.
  template <class Value, class First>
  HWY_INLINE Components<Value> At(const Value* values, const First& first, std::size_t corner) const {
    if constexpr (kUniform) {
      const float* value = &values[first + local_[corner]].x;
      return {Splat(value[0]), Splat(value[1]), Splat(value[2]), Splat(value[3])};
    } else {
      return GatherRecords(values, first + locals_[corner]);
    }
  }
  HWY_INLINE auto First() const {
    if constexpr (kUniform) {
      return first_;
    } else {
      return firsts_;
    }
  }

  HWY_INLINE void Gather(IntVector ids) {
    const IntTag di;
    const UintTag du;
    clusters_ = hn::BitCast(di, hn::ShiftRight<kTriangleBits>(hn::BitCast(du, ids)));
    const auto packed =
        hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(frame_.corners.data()), ids);
    const auto byte = SplatInt(255);
    locals_[0] = hn::And(packed, byte);
    locals_[1] = hn::And(hn::ShiftRight<8>(packed), byte);
    locals_[2] = hn::And(hn::ShiftRight<16>(packed), byte);
    static_assert(sizeof(Cluster) % sizeof(std::int32_t) == 0 && offsetof(Cluster, first_vertex) == 0);
    firsts_ = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(frame_.clusters.data()),
                              clusters_ * SplatInt(sizeof(Cluster) / sizeof(std::int32_t)));
  }

  struct Nothing {};
  const Frame& frame_;
  std::conditional_t<kUniform, std::uint32_t, Nothing> cluster_{}, first_{};
  std::conditional_t<kUniform, std::array<std::uint32_t, 3>, Nothing> local_{};
  std::conditional_t<kUniform, Nothing, IntVector> clusters_{}, firsts_{};
  std::conditional_t<kUniform, Nothing, std::array<IntVector, 3>> locals_{};
};

constexpr std::size_t kNormalField = 0, kUvField = 1, kColorField = 3, kTangentField = 4;
static_assert(offsetof(ClusterStreams, normal) == kNormalField * sizeof(std::uint32_t));
static_assert(offsetof(ClusterStreams, uv) == kUvField * sizeof(std::uint32_t));
static_assert(offsetof(ClusterStreams, color) == kColorField * sizeof(std::uint32_t));
static_assert(offsetof(ClusterStreams, tangent) == kTangentField * sizeof(std::uint32_t));

}  // namespace laterna::frame::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
