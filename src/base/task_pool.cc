#include "base/task_pool.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>
#include <thread>

#ifdef __SANITIZE_THREAD__
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace laterna {
namespace {

// Debian's TBB is not built with ThreadSanitizer, which therefore does not see that TBB starts workers after what came
// before the loop and joins them before what comes after it. These two say so; elsewhere they are nothing.
void publish([[maybe_unused]] void* what) {
#ifdef __SANITIZE_THREAD__
  __tsan_release(what);
#endif
}
void observe([[maybe_unused]] void* what) {
#ifdef __SANITIZE_THREAD__
  __tsan_acquire(what);
#endif
}

struct Loop {
  std::size_t count;
  const std::function<void(std::size_t, int)>& body;
  std::atomic<std::size_t> next = 0;

  void run(int worker) {
    observe(this);
    try {
      for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) body(i, worker);
    } catch (...) {
      next = count;  // nobody begins anything more
      publish(this);
      throw;
    }
    publish(this);
  }
};

// What TBB copies from task to task: nothing but where the loop is.
struct LoopReference {
  Loop* loop;
  void operator()(int worker) const { loop->run(worker); }
};

}  // namespace

struct TaskPool::Arena {
  explicit Arena(int threads) : arena(threads) {
    // TBB starts no more workers than processors unless told so.
    if (threads > tbb::info::default_concurrency()) {
      allowance.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    }
  }
  std::optional<tbb::global_control> allowance;
  tbb::task_arena arena;
};

TaskPool::TaskPool(int threads)
    : threads_(threads > 0 ? threads : std::max(1, tbb::info::default_concurrency())),
      arena_(std::make_unique<Arena>(threads_)) {}

TaskPool::~TaskPool() = default;

void TaskPool::for_each(std::size_t count, const std::function<void(std::size_t, int)>& body) const {
  const int workers = static_cast<int>(std::min<std::size_t>(count, static_cast<std::size_t>(threads_)));
  if (workers <= 1) {
    for (std::size_t i = 0; i < count; ++i) body(i, 0);
    return;
  }
  Loop loop{count, body};
  publish(&loop);
  arena_->arena.execute(
      [&] { tbb::parallel_for(0, workers, LoopReference{&loop}, tbb::simple_partitioner()); });
  observe(&loop);
}

}  // namespace laterna
