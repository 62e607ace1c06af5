// Depth as grey: near light, far dark, nothing white.
#pragma once

#include <limits>
#include <span>

namespace laterna::measure {

class DepthRamp {
 public:
  /// Stretched over the finite depths.
  explicit DepthRamp(std::span<const float> depths);
  /// Linear grey. +infinity is white.
  [[nodiscard]] float grey(float depth) const;

 private:
  // White is kept for where nothing is.
  static constexpr float kNearest = 0.8F, kFarthest = 0.02F, kNothing = 1.0F;
  float nearest_ = std::numeric_limits<float>::infinity();
  float farthest_ = -std::numeric_limits<float>::infinity();
};

}  // namespace laterna::measure
