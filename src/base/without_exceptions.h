// The door through which no exception leaves the library.
#pragma once

#include <new>
#include <utility>

#include "laterna/result.h"

namespace laterna {

/// work()'s Result; `exhausted` where memory ran out.
template <class Work>
auto without_exceptions(Error exhausted, Work work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return tl::unexpected(std::move(exhausted));
  }
}

}  // namespace laterna
