// Records of a few numbers each, read at N places at a time.
#if defined(LATERNA_BASE_RECORD_GATHER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_BASE_RECORD_GATHER_INL_H_
#undef LATERNA_BASE_RECORD_GATHER_INL_H_
#else
#define LATERNA_BASE_RECORD_GATHER_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Components of N records: glm vectors of floats or of 32-bit integers.
template <class Record>
using RecordTag = hn::Rebind<typename Record::value_type, FloatTag>;
template <class Record>
struct Components {
  hn::Vec<RecordTag<Record>> x, y, z, w;
};

#if HWY_TARGET != HWY_SCALAR
// Each 128 bits of the result hold the first four numbers of one record: of those at index[0], index[4], index[8], …
template <class Record, class D>
HWY_INLINE hn::Vec<D> LoadEveryFourth(D d, const Record* records, const std::uint32_t* index) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    return hn::LoadU(d, &records[*index].x);
  } else {
    const hn::Half<D> half;
    constexpr std::size_t kHalf = hn::MaxLanes(hn::Half<D>());
    return hn::Combine(d, LoadEveryFourth(half, records, index + kHalf),
                       LoadEveryFourth(half, records, index));
  }
}
#endif

// Four components of records at N indices; what a record has fewer of is what follows it in memory, and must be readable. A load
// for each record and a transposition: gathers touch memory, lane by lane, once for each component.
template <class Record>
HWY_INLINE Components<Record> GatherRecords(const Record* records, IntVector index) {
  static_assert(sizeof(typename Record::value_type) == sizeof(float));
  const RecordTag<Record> d;
#if HWY_TARGET == HWY_SCALAR
  const auto* record = &records[static_cast<std::uint32_t>(hn::GetLane(index))].x;
  return {hn::Set(d, record[0]), hn::Set(d, record[1]), hn::Set(d, record[2]), hn::Set(d, record[3])};
#else
  const hn::Repartition<double, FloatTag> d64;
  alignas(64) std::uint32_t at[kLanes];
  hn::Store(hn::BitCast(UintTag(), index), UintTag(), at);
  const auto p = LoadEveryFourth(d, records, at), q = LoadEveryFourth(d, records, at + 1),
             r = LoadEveryFourth(d, records, at + 2), s = LoadEveryFourth(d, records, at + 3);
  // x of p and q, y of p and q; …
  const auto xy_pq = hn::BitCast(d64, hn::InterleaveLower(d, p, q)),
             xy_rs = hn::BitCast(d64, hn::InterleaveLower(d, r, s)),
             zw_pq = hn::BitCast(d64, hn::InterleaveUpper(d, p, q)),
             zw_rs = hn::BitCast(d64, hn::InterleaveUpper(d, r, s));
  return {hn::BitCast(d, hn::InterleaveLower(d64, xy_pq, xy_rs)),
          hn::BitCast(d, hn::InterleaveUpper(d64, xy_pq, xy_rs)),
          hn::BitCast(d, hn::InterleaveLower(d64, zw_pq, zw_rs)),
          hn::BitCast(d, hn::InterleaveUpper(d64, zw_pq, zw_rs))};
#endif
}

}  // namespace laterna::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
