// How a kernel is measured: in time by Google Benchmark, in instructions by scripts/kernel_instructions.py.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>

#include "laterna/instruction_set.h"

namespace laterna {

/// One call. Not inlined: callgrind is told to count what happens in here, and nothing else.
template <class Kernel>
[[gnu::noinline]] void run_kernel(Kernel& kernel) {
  kernel();
  benchmark::ClobberMemory();
}

/// Calls `kernel`, which does `count` of `items` ("pixels", "triangles") in one call, until the time is up. Not inlined:
/// callgrind writes what it has counted when this returns.
template <class Kernel>
[[gnu::noinline]] void measure(benchmark::State& state, const char* items, double count, Kernel kernel) {
  for (auto _ : state) run_kernel(kernel);
  state.SetLabel(items);
  state.counters["items"] = count;
  state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
}

/// Registers run(state, set) as "NAME/SET" for every instruction set of this machine.
template <class Run>
void register_kernel(const std::string& name, Run run) {
  for (const InstructionSet set : supported_instruction_sets()) {
    const std::string full_name = name + "/" + std::string(name_of(set));
    benchmark::RegisterBenchmark(full_name.c_str(), [=](benchmark::State& state) {
      run(state, set);
    })->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace laterna
