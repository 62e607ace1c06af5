// The door through which no exception leaves the library.
#pragma once

#include <new>

#include "laterna/result.h"

namespace laterna::render {

/// work()'s Result, or an error where memory ran out.
template <class Work>
auto without_exceptions(Work work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return tl::unexpected(Error(
        Failure::bad_usage,
        Diagnostic{
            {}, {}, "not enough memory: ask for a smaller picture, fewer layers or smaller shadow maps"}));
  }
}

}  // namespace laterna::render
