#include "base/aligned_vector.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace laterna {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20U;

// Smaller arrays would waste most of their last page.
bool wants_large_pages(std::size_t bytes, Pages pages) {
  return pages == Pages::large && bytes >= 2 * kLargePage;
}

std::align_val_t alignment_of(std::size_t bytes, Pages pages) {
  return std::align_val_t{wants_large_pages(bytes, pages) ? kLargePage : kCacheLine};
}

}  // namespace

void* allocate_aligned(std::size_t bytes, Pages pages) {
  void* memory = ::operator new(bytes, alignment_of(bytes, pages));
#ifdef __linux__
  // Whole pages only: what follows belongs to others. Where the system has none to give, small ones do.
  if (wants_large_pages(bytes, pages)) {
    ::madvise(memory, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
  }
#endif
  return memory;
}

void free_aligned(void* memory, std::size_t bytes, Pages pages) {
  ::operator delete(memory, alignment_of(bytes, pages));
}

}  // namespace laterna
