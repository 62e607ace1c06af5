// The one question every shadow technique answers: how much of a light arrives at each sample?
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "laterna/instruction_set.h"
#include "shadow/surface_samples.h"

namespace laterna::shadow {

/// How much of a light arrives at each sample.
struct Arrival {
  /// Fraction that arrives, 0 in full shadow and 1 in full light; with a tint the mean of the three below.
  SampleArray<float> alpha;
  bool is_tinted = false;      ///< what light came through has coloured it
  SampleArray<float> r, g, b;  ///< then: fraction that arrives, by channel
};

/// What a technique drew for a picture, where it is not known before.
struct DrawnForShadows {
  std::size_t objects = 0, pairs = 0;  ///< of an occluder and a receiver
  std::size_t silhouettes = 0, silhouettes_drawn = 0;
  std::size_t bytes = 0;
};

/// Answers for one light and one set of samples' rays. Const calls may come from several threads at once.
class ShadowTechnique {
 public:
  virtual ~ShadowTechnique() = default;

  /// Writes what arrives at the samples named by `wanted` (a bit each, by group); entries of other samples in the same
  /// group may be written too. Returns how many milliseconds of this went into drawing what the answer is read from,
  /// rather than into reading it.
  virtual double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                              Arrival& arrival) const = 0;

  /// When the picture is done.
  [[nodiscard]] virtual DrawnForShadows drawn() const { return {}; }
};

}  // namespace laterna::shadow
