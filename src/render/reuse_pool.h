// Objects that have done their work, kept for the next that need some: their memory is already touched.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <utility>
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

  /// Frees the largest of what nobody uses until the rest takes no more than `bytes`.
  void trim(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    std::size_t held = 0;
    for (const auto& object : idle_) held += object->memory_bytes();
    std::sort(idle_.begin(), idle_.end(),
              [](const auto& a, const auto& b) { return a->memory_bytes() < b->memory_bytes(); });
    for (; !idle_.empty() && held > bytes; idle_.pop_back()) held -= idle_.back()->memory_bytes();
  }

  /// Frees what nobody uses.
  void clear() {
    const std::lock_guard lock(mutex_);
    idle_.clear();
  }

 private:
  // Called by destructors: an object for which there is no room in the list is let go.
  void give_back(T* object) noexcept {
    std::unique_ptr<T> owned(object);
    try {
      const std::lock_guard lock(mutex_);
      idle_.push_back(std::move(owned));
    } catch (const std::bad_alloc&) {
      return;
    }
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

using BinsPool = ReusePool<raster::TriangleBins>;

}  // namespace laterna::render
