#include "own_process.h"

#include <cstdio>
#include <type_traits>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace laterna::growth {
namespace {

static_assert(std::is_trivially_copyable_v<RowCost>);

// The child's part: measures, writes the bytes, and is gone.
[[noreturn]] void measure_and_exit(const std::function<Result<RowCost>()>& measure, int out) {
  const Result<RowCost> cost = measure();
  if (!cost) {
    std::fprintf(stderr, "%s\n", to_string(cost.error()).c_str());
    _exit(1);
  }
  const bool is_sent = write(out, &*cost, sizeof *cost) == static_cast<ssize_t>(sizeof *cost);
  _exit(is_sent ? 0 : 1);
}

Error failure(const char* what) { return {Failure::bad_input, Diagnostic{{}, {}, what}}; }

}  // namespace

Result<RowCost> run_in_own_process(const std::function<Result<RowCost>()>& measure) {
  int ends[2] = {};
  if (pipe(ends) != 0) return tl::unexpected(failure("no pipe to a measuring process"));
  const pid_t child = fork();
  if (child < 0) return tl::unexpected(failure("a measuring process could not be started"));
  if (child == 0) measure_and_exit(measure, ends[1]);
  close(ends[1]);
  RowCost cost;
  const bool is_whole = read(ends[0], &cost, sizeof cost) == static_cast<ssize_t>(sizeof cost);
  close(ends[0]);
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  if (!is_whole)
    return tl::unexpected(failure("a measuring process ended without a result (out of memory?)"));
  cost.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024;
  return cost;
}

}  // namespace laterna::growth
