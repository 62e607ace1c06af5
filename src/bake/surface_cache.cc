#include "bake/surface_cache.h"

#include <algorithm>

namespace laterna::bake {

void SurfaceCache::keep(Key key, std::shared_ptr<const CombinedSurface> surface) {
  const std::size_t bytes = surface->rgb.size();
  if (bytes > most_bytes_) return;
  while (statistics_.bytes + bytes > most_bytes_) {
    statistics_.bytes -= kept_.back().second->rgb.size();
    places_.erase(kept_.back().first);
    kept_.pop_back();
    ++statistics_.dropped;
  }
  kept_.emplace_front(key, std::move(surface));
  places_[key] = kept_.begin();
  statistics_.bytes += bytes;
  statistics_.most_bytes = std::max(statistics_.most_bytes, statistics_.bytes);
}

}  // namespace laterna::bake
