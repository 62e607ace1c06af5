// The thin layer between our kernels and Highway. A kernel file is named *.simd.cc and looks like this:
//
//   #undef HWY_TARGET_INCLUDE
//   #define HWY_TARGET_INCLUDE "room/file.simd.cc"
//   #include "base/simd.h"             // before any Highway header: chooses the targets
//   #include <hwy/foreach_target.h>    // includes this very file once per target
//   #include <hwy/highway.h>
//   HWY_BEFORE_NAMESPACE();
//   namespace laterna::room::HWY_NAMESPACE { void kernel(...) { ... } }
//   HWY_AFTER_NAMESPACE();
//   #if HWY_ONCE
//   LATERNA_KERNEL_TABLE(kernel)       // defines kernel_for(InstructionSet)
//   #endif
//
// Rules that keep pictures identical everywhere: no MulAdd, no approximate reciprocal, no reduction whose order
// depends on the number of lanes, NaN excluded before Min, Max, ConvertTo and NearestInt. Kernels accept any number
// of lanes from 1 to 16.
#ifndef LATERNA_BASE_SIMD_H_
#define LATERNA_BASE_SIMD_H_

// SSSE3 and AVX3_DL bring nothing that SSE4 and AVX3 lack here; SVE and RVV vectors have no fixed size.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#include <array>
#include <cstddef>

#include "laterna/instruction_set.h"

namespace laterna {

inline constexpr std::size_t kInstructionSets = 5;

/// The kernel for `set`, or the next lesser one that was compiled.
template <class Function>
Function select_kernel(const std::array<Function, kInstructionSets>& kernels, InstructionSet set) {
  auto index = static_cast<std::size_t>(set);
  while (index > 0 && kernels[index] == nullptr) --index;
  return kernels[index];
}

}  // namespace laterna

// In the order of InstructionSet.
#define LATERNA_KERNEL_TABLE(kernel)                                                   \
  decltype(&HWY_STATIC_DISPATCH(kernel)) kernel##_for(InstructionSet set) {            \
    using Function = decltype(&HWY_STATIC_DISPATCH(kernel));                           \
    static constexpr std::array<Function, kInstructionSets> kKernels = {               \
        HWY_CHOOSE_FALLBACK(kernel), HWY_CHOOSE_SSE4(kernel), HWY_CHOOSE_AVX2(kernel), \
        HWY_CHOOSE_AVX3(kernel), HWY_CHOOSE_NEON(kernel)};                             \
    return select_kernel(kKernels, set);                                               \
  }

#endif  // LATERNA_BASE_SIMD_H_
