// Looks through long lists for the one bad number, in blocks that compilers turn into SIMD.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace laterna {

namespace number_scans {
inline constexpr std::size_t kBlock = 64;

/// Index of the first value for which is_bad holds, or values.size(). `key` maps a value to an unsigned
/// number that is at least `limit` for bad values only.
template <class T, class Key>
std::size_t first_reaching(std::span<const T> values, std::uint32_t limit, const Key& key) {
  std::size_t at = 0;
  for (; at + kBlock <= values.size(); at += kBlock) {
    std::uint32_t largest = 0;
    for (std::size_t i = 0; i < kBlock; ++i) largest = std::max(largest, key(values[at + i]));
    if (largest >= limit) break;
  }
  while (at < values.size() && key(values[at]) < limit) ++at;
  return at;
}
}  // namespace number_scans

/// Index of the first infinity or NaN, or values.size().
inline std::size_t first_not_finite(std::span<const float> values) {
  return number_scans::first_reaching(values, 0x7F800000U,
                                      [](float v) { return std::bit_cast<std::uint32_t>(v) & 0x7FFFFFFFU; });
}

/// Index of the first value that is not below `limit`, or values.size().
inline std::size_t first_beyond(std::span<const std::uint32_t> values, std::size_t limit) {
  if (limit > 0xFFFFFFFFU) return values.size();
  return number_scans::first_reaching(values, static_cast<std::uint32_t>(limit),
                                      [](std::uint32_t v) { return v; });
}

/// The components of a list of vectors, one after the other.
template <class Vector>
std::span<const float> components_of(const std::vector<Vector>& vectors) {
  static_assert(sizeof(Vector) == Vector::length() * sizeof(float));
  if (vectors.empty()) return {};
  return {&vectors[0].x, vectors.size() * static_cast<std::size_t>(Vector::length())};
}

}  // namespace laterna
