// A vector whose storage starts on a cache line, for arrays that kernels load in whole vectors. Large ones ask the
// system for large pages: kernels gather from textures and depth maps all over, and a page of 4 KB for each look-up
// costs as much as the look-up.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace laterna {

inline constexpr std::size_t kCacheLine = 64;

/// `bytes` on a cache line, or in large pages where that pays. Throws std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* memory, std::size_t bytes);

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}  // NOLINT: allocators convert
  T* allocate(std::size_t count) {
    if (count > std::size_t(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_aligned(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t count) { free_aligned(memory, count * sizeof(T)); }
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
