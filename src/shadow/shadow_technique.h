// The one question every shadow technique answers: how much of a light arrives at each sample?
#pragma once

#include <cstdint>
#include <span>

#include "laterna/instruction_set.h"
#include "shadow/surface_samples.h"

namespace laterna::shadow {

/// Answers for one light and one set of samples' rays. Const calls may come from several threads at once.
class ShadowTechnique {
 public:
  virtual ~ShadowTechnique() = default;

  /// Writes α to alpha[i], 0 in full shadow and 1 in full light, for the samples named by `wanted` (a bit each, by
  /// group); entries of other samples in the same group may be written too. Returns how many milliseconds of this went
  /// into drawing what the answer is read from, rather than into reading it.
  virtual double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                              float* alpha) const = 0;
};

}  // namespace laterna::shadow
