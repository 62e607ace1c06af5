// Objects that have done their work, kept for the next that need some: their memory is already touched.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "raster/triangle_bins.h"

namespace laterna::render {

template <class T>
class ReusePool {
 public:
  struct Return {
    ReusePool* pool;
    void operator()(T* object) const { pool->give_back(object); }
  };
  using Lease = std::unique_ptr<T, Return>;

  /// Comes back by itself when the lease ends. What is in it is left from its last use.
  Lease take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return Lease(new T, Return{this});
    Lease lease(idle_.back().release(), Return{this});
    idle_.pop_back();
    return lease;
  }

  /// Frees what nobody uses.
  void clear() {
    const std::lock_guard lock(mutex_);
    idle_.clear();
  }

 private:
  void give_back(T* object) {
    const std::lock_guard lock(mutex_);
    idle_.emplace_back(object);
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

using BinsPool = ReusePool<raster::TriangleBins>;

}  // namespace laterna::render
