// Which vertices are the same point: equal bit for bit in a few floats (−0 counts as 0).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace laterna {

/// For each of `count` vertices the first vertex with the same key. key(i) gives std::array<float, N>.
template <std::size_t N, class Key>
std::vector<std::uint32_t> weld_vertices(std::size_t count, const Key& key) {
  constexpr std::uint32_t kFree = 0xFFFFFFFF;
  const std::size_t table_size = std::bit_ceil(count * 2 + 1);
  std::vector<std::uint32_t> table(table_size, kFree);  // open addressing, at most half full
  std::vector<std::uint32_t> first(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<float, N> wanted = key(i);
    std::uint64_t hash = 0;
    for (const float value : wanted) {
      // Adding 0 turns −0 into 0. The multiplier is 2^64 divided by the golden ratio (Knuth's multiplicative
      // hash).
      hash = (hash ^ std::bit_cast<std::uint32_t>(value + 0.0F)) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 32;
    }
    std::size_t slot = hash & (table_size - 1);
    while (table[slot] != kFree && key(table[slot]) != wanted) slot = (slot + 1) & (table_size - 1);
    if (table[slot] == kFree) table[slot] = static_cast<std::uint32_t>(i);
    first[i] = table[slot];
  }
  return first;
}

}  // namespace laterna
