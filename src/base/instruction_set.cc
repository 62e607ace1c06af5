#include "laterna/instruction_set.h"

#include <array>
#include <utility>

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace laterna {
namespace {

constexpr std::array<std::pair<InstructionSet, std::string_view>, 5> kNames = {{
    {InstructionSet::scalar, "scalar"},
    {InstructionSet::sse4, "sse4"},
    {InstructionSet::avx2, "avx2"},
    {InstructionSet::avx512, "avx512"},
    {InstructionSet::neon, "neon"},
}};

#if defined(__x86_64__) && !defined(HWY_COMPILE_ONLY_SCALAR)
// Clang 14 and 16 do not know __builtin_cpu_supports("f16c").
bool has_f16c() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}
#endif

}  // namespace

std::string_view name_of(InstructionSet set) { return kNames[static_cast<std::size_t>(set)].second; }

std::optional<InstructionSet> instruction_set_named(std::string_view name) {
  for (const auto& [set, known] : kNames) {
    if (known == name) return set;
  }
  return std::nullopt;
}

std::vector<InstructionSet> supported_instruction_sets() {
  std::vector<InstructionSet> sets = {InstructionSet::scalar};
#if defined(HWY_COMPILE_ONLY_SCALAR)
  return sets;
#elif defined(__x86_64__)
  // What Highway compiles each target with (hwy/ops/set_macros-inl.h).
  const bool sse4 =
      __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("aes");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
                    __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma") && has_f16c();
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd");
  if (sse4) sets.push_back(InstructionSet::sse4);
  if (avx2) sets.push_back(InstructionSet::avx2);
  if (avx512) sets.push_back(InstructionSet::avx512);
#elif defined(__aarch64__)
  sets.push_back(InstructionSet::neon);
#endif
  return sets;
}

InstructionSet best_instruction_set() { return supported_instruction_sets().back(); }

}  // namespace laterna
