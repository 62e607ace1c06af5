// Which SIMD instruction set the kernels use. Every set gives the same picture, bit for bit.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace laterna {

enum class InstructionSet { scalar, sse4, avx2, avx512, neon };

/// "scalar", "sse4", "avx2", "avx512", "neon".
std::string_view name_of(InstructionSet set);
std::optional<InstructionSet> instruction_set_named(std::string_view name);

/// What this machine can run and this build contains, slowest first. Never empty.
std::vector<InstructionSet> supported_instruction_sets();
InstructionSet best_instruction_set();

}  // namespace laterna
