// A vector whose storage starts on a cache line, for arrays that kernels load in whole vectors. Large ones ask the
// system for large pages: kernels gather from textures and vertices all over, and a page of 4 KB for each look-up costs
// as much as the look-up.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace laterna {

inline constexpr std::size_t kCacheLine = 64;

/// Small pages suit arrays of which only parts are touched: the rest then takes no memory.
enum class Pages : bool { small, large };

/// `bytes` on a cache line; `large`: in large pages where that pays. Throws std::bad_alloc.
void* allocate_aligned(std::size_t bytes, Pages pages);
void free_aligned(void* memory, std::size_t bytes, Pages pages);

template <class T, Pages kPages>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  struct rebind {
    using other = CacheLineAllocator<U, kPages>;
  };
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U, kPages>&) {}  // NOLINT: allocators convert
  T* allocate(std::size_t count) {
    if (count > std::size_t(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_aligned(count * sizeof(T), kPages));
  }
  void deallocate(T* memory, std::size_t count) { free_aligned(memory, count * sizeof(T), kPages); }
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
using AlignedVector = std::vector<T, CacheLineAllocator<T, Pages::large>>;
/// The same, in small pages.
template <class T>
using SparseAlignedVector = std::vector<T, CacheLineAllocator<T, Pages::small>>;

}  // namespace laterna
