// Groups of luxels that stand for each other while light goes to and fro.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace laterna::bake {

/// Runs of places in the order of a LuxelTree, which is balanced: equal runs are boxes of neighbouring luxels. Few luxels are patches
/// each; many are grouped, and so are those that send out more rays than can be remembered.
class Patches {
 public:
  /// `rays`: that a luxel sends out.
  Patches(std::size_t luxel_count, int rays) : luxel_count_(luxel_count) {
    const auto wanted = static_cast<std::size_t>(rays);
    const bool are_few = luxel_count <= kMostAlone && luxel_count * wanted <= kMostRays;
    if (luxel_count > 0) size_ = are_few ? 1 : std::max(kLeastGroup, (luxel_count + kMost - 1) / kMost);
    rays_ = static_cast<int>(std::min(wanted, kMostRays / std::max<std::size_t>(1, count())));
  }

  [[nodiscard]] std::size_t count() const { return (luxel_count_ + size_ - 1) / size_; }
  [[nodiscard]] std::uint32_t of(std::uint32_t place) const {
    return place / static_cast<std::uint32_t>(size_);
  }
  [[nodiscard]] std::size_t first(std::size_t patch) const { return patch * size_; }
  [[nodiscard]] std::size_t size(std::size_t patch) const {
    return std::min(size_, luxel_count_ - first(patch));
  }
  [[nodiscard]] bool are_luxels() const { return size_ == 1; }
  /// That each of them sends out.
  [[nodiscard]] int rays() const { return rays_; }

 private:
  static constexpr std::size_t kMost = 32768, kMostAlone = 8192, kLeastGroup = 4;
  // Of all patches together: 128 MB where there are no panes.
  static constexpr std::size_t kMostRays = std::size_t{1} << 25U;

  std::size_t luxel_count_, size_ = 1;
  int rays_;
};

}  // namespace laterna::bake
