// The door of every call that may need much memory.
#pragma once

#include "base/refuse.h"
#include "base/without_exceptions.h"

namespace laterna::render {

template <class Work>
auto guarded(Work work) -> decltype(work()) {
  return without_exceptions(
      refuse("not enough memory: ask for a smaller picture, fewer layers or smaller shadow maps").value(),
      work);
}

}  // namespace laterna::render
