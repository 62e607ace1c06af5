// Work on the rows of a picture in parallel.
#pragma once

#include <algorithm>

#include "base/task_pool.h"

namespace laterna::image {

/// Calls work(first, last, worker) for blocks of rows that together make [0, rows). A block's result must not
/// depend on another's; `worker` chooses a scratch buffer, as in TaskPool::for_each. `work` must not throw.
template <class Work>
void for_each_row_block(const TaskPool& pool, int rows, const Work& work) {
  constexpr int kRows = 32;
  pool.for_each(static_cast<std::size_t>((rows + kRows - 1) / kRows), [&](std::size_t block, int worker) {
    const int first = static_cast<int>(block) * kRows;
    work(first, std::min(first + kRows, rows), worker);
  });
}

}  // namespace laterna::image
