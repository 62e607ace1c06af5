// Work on many things alike: on all threads, with progress, kept in files part by part.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bake/luxel_rays.h"
#include "bake/part_files.h"
#include "base/task_pool.h"
#include "render/progress_report.h"

namespace laterna::bake {

class PartWork {
 public:
  PartWork(const TaskPool& pool, render::ProgressReport& progress) : pool_(pool), progress_(progress) {}

  /// Things that one thread does in a row; each such row is a step of progress.
  static std::size_t batches_of(std::size_t count) { return (count + kBatch - 1) / kBatch; }
  [[nodiscard]] bool is_cancelled() const { return progress_.is_cancelled(); }

  /// Calls body(i, scratch) for i in [first, last), unless progress is cancelled.
  template <class Body>
  void run(std::size_t first, std::size_t last, Body body) const {
    std::vector<LuxelRays::Scratch> scratch(static_cast<std::size_t>(pool_.threads()));
    pool_.for_each(batches_of(last - first), [&](std::size_t batch, int worker) {
      if (progress_.is_cancelled()) return;
      const std::size_t end = std::min(last, first + (batch + 1) * kBatch);
      for (std::size_t i = first + batch * kBatch; i < end; ++i)
        body(i, scratch[static_cast<std::size_t>(worker)]);
      progress_.advance();
    });
  }

  /// The same of [0, count), so many batches to a part: values(first, last) are the bytes of what it works out, kept in files.
  template <class Body, class Values>
  void run_in_parts(const PartFiles& files, std::string_view name, std::size_t count,
                    std::size_t batches_per_part, Body body, Values values) const {
    const std::size_t part_size = batches_per_part * kBatch;
    for (std::size_t first = 0; first < count && !is_cancelled(); first += part_size) {
      const std::size_t last = std::min(count, first + part_size);
      const std::string part = fmt::format("{}-{}", name, first / part_size);
      if (files.find(part, values(first, last))) {
        progress_.advance(batches_of(last - first));
        continue;
      }
      run(first, last, body);
      if (is_cancelled()) return;
      files.keep(part, values(first, last));
    }
  }

 private:
  static constexpr std::size_t kBatch = 64;

  const TaskPool& pool_;
  render::ProgressReport& progress_;
};

}  // namespace laterna::bake
