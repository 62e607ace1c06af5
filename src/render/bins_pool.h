// Bins that have done their work, kept for the next that need some: their memory is already touched.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "raster/triangle_bins.h"

namespace laterna::render {

class BinsPool {
 public:
  struct Return {
    BinsPool* pool;
    void operator()(raster::TriangleBins* bins) const { pool->give_back(bins); }
  };
  using Lease = std::unique_ptr<raster::TriangleBins, Return>;

  /// Comes back by itself when the lease ends.
  Lease take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return Lease(new raster::TriangleBins, Return{this});
    Lease lease(idle_.back().release(), Return{this});
    idle_.pop_back();
    return lease;
  }

 private:
  void give_back(raster::TriangleBins* bins) {
    const std::lock_guard lock(mutex_);
    idle_.emplace_back(bins);
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<raster::TriangleBins>> idle_;
};

}  // namespace laterna::render
