// A vector whose storage starts on a cache line, for arrays that kernels load in whole vectors.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace laterna {

inline constexpr std::size_t kCacheLine = 64;

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}  // NOLINT: allocators convert
  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new (count * sizeof(T), std::align_val_t{kCacheLine}));
  }
  void deallocate(T* memory, std::size_t) { ::operator delete (memory, std::align_val_t{kCacheLine}); }
  /// Leaves new elements uninitialised: large buffers are written by the threads that use them.
  template <class U>
  void construct(U* element) {
    ::new (static_cast<void*>(element)) U;
  }
  template <class U, class... Arguments>
  void construct(U* element, Arguments&&... arguments) {
    ::new (static_cast<void*>(element)) U(static_cast<Arguments&&>(arguments)...);
  }
  bool operator==(const CacheLineAllocator&) const { return true; }
};

/// Elements made by resize() are not initialised.
template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace laterna
