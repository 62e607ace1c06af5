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
    std::size_t owner;
    void operator()(T* object) const { pool->give_back(owner, object); }
  };
  using Lease = std::unique_ptr<T, Return>;

  /// Comes back by itself when the lease ends. What is in it is left from its last use, by the same owner if it is there:
  /// handed round, every object would grow to the largest owner's needs.
  Lease take(std::size_t owner = 0) {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return Lease(new T, Return{this, owner});
    auto found = std::find_if(idle_.begin(), idle_.end(), [&](const Idle& i) { return i.owner == owner; });
    if (found == idle_.end()) found = idle_.end() - 1;
    Lease lease(found->object.release(), Return{this, owner});
    idle_.erase(found);
    return lease;
  }

  /// Frees the largest of what nobody uses until the rest takes no more than `bytes`.
  void trim(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    std::size_t held = 0;
    for (const Idle& idle : idle_) held += idle.object->memory_bytes();
    std::sort(idle_.begin(), idle_.end(), [](const Idle& a, const Idle& b) {
      return a.object->memory_bytes() < b.object->memory_bytes();
    });
    for (; !idle_.empty() && held > bytes; idle_.pop_back()) held -= idle_.back().object->memory_bytes();
  }

  /// Frees what nobody uses.
  void clear() {
    const std::lock_guard lock(mutex_);
    idle_.clear();
  }

 private:
  struct Idle {
    std::size_t owner;
    std::unique_ptr<T> object;
  };

  // Called by destructors: an object for which there is no room in the list is let go.
  void give_back(std::size_t owner, T* object) noexcept {
    std::unique_ptr<T> owned(object);
    try {
      const std::lock_guard lock(mutex_);
      idle_.push_back({owner, std::move(owned)});
    } catch (const std::bad_alloc&) {
      return;
    }
  }

  std::mutex mutex_;
  std::vector<Idle> idle_;
};

using BinsPool = ReusePool<raster::TriangleBins>;

}  // namespace laterna::render
