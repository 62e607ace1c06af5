// Loops spread over threads, in index order, with results that do not depend on how many threads there are.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>

namespace laterna {

class TaskPool {
 public:
  /// threads = 0: one per processor. More threads than processors are really started (for tests).
  explicit TaskPool(int threads = 0);
  ~TaskPool();
  TaskPool(const TaskPool&) = delete;
  TaskPool& operator=(const TaskPool&) = delete;

  [[nodiscard]] int threads() const { return threads_; }

  /// Calls body(index, worker) once for each index in [0, count), indices handed out in order; worker in
  /// [0, threads()) is distinct among calls that run at the same time, so it may pick a scratch buffer.
  /// Returns when all are done. What `body` throws (std::bad_alloc) ends the loop and is thrown on, the first of several.
  void for_each(std::size_t count, const std::function<void(std::size_t index, int worker)>& body) const;

 private:
  struct Arena;
  int threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace laterna
