// Combined surfaces, kept as long as there is room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "laterna/quake_surfaces.h"

namespace laterna::bake {

/// A surface at one size, its texels as they are shown.
struct CombinedSurface {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Drops what was unused for longest once more than `most_bytes` are kept.
class SurfaceCache {
 public:
  using Key = std::pair<std::uint32_t, int>;  // surface and size

  SurfaceCache(std::size_t most_bytes, QuakeStatistics& statistics)
      : most_bytes_(most_bytes), statistics_(statistics) {}

  /// What `combine()` makes, now or earlier.
  template <class Combine>
  std::shared_ptr<const CombinedSurface> find(Key key, Combine combine) {
    ++statistics_.asked;
    if (const auto known = places_.find(key); known != places_.end()) {
      ++statistics_.found;
      kept_.splice(kept_.begin(), kept_, known->second);
      return known->second->second;
    }
    auto made = std::make_shared<const CombinedSurface>(combine());
    keep(key, made);
    return made;
  }

 private:
  void keep(Key key, std::shared_ptr<const CombinedSurface> surface);

  std::size_t most_bytes_;
  QuakeStatistics& statistics_;
  std::list<std::pair<Key, std::shared_ptr<const CombinedSurface>>> kept_;  // the last used first
  std::map<Key, decltype(kept_)::iterator> places_;
};

}  // namespace laterna::bake
