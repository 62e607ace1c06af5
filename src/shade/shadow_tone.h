// How dark and of what colour a light's shadows are shown.
#pragma once

#include <array>

#include "laterna/shadows.h"
#include "shadow/shadow_technique.h"

namespace laterna::shade {

/// From the fraction of a light that arrives to the fraction that is seen to (rows 34 and 91): per channel
/// darkest + (1 − darkest) arriving.
class ShadowTone {
 public:
  explicit ShadowTone(const ShadowSettings& settings);

  /// Shadows are as dark as they are.
  [[nodiscard]] bool is_physical() const { return is_physical_; }
  /// `seen` may not be `arriving`.
  void apply(const shadow::Arrival& arriving, std::size_t groups, shadow::Arrival& seen) const;
  [[nodiscard]] float fill() const { return fill_; }

 private:
  std::array<float, 3> darkest_{};
  float fill_;
  bool is_physical_;
};

}  // namespace laterna::shade
