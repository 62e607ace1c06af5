// A depth map as moments, which may be filtered like any picture, before they are compared: Donnelly and Lauritzen, Variance
// shadow maps, 2006; of exponentials of depth: Lauritzen and McCool, Layered variance shadow maps, 2008.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/aligned_vector.h"
#include "base/task_pool.h"
#include "laterna/instruction_set.h"
#include "laterna/shadows.h"
#include "shadow/depth_map.h"

namespace laterna::shadow {

/// The depth whose moments are kept: −1 at the nearest that any texel of a light's maps saw, kFarthestDepth at the farthest,
/// 1 where nothing was seen and for all receivers beyond.
struct DepthMeasure {
  static constexpr float kFarthestDepth = 0.9F;
  bool is_orthographic = false, is_radial = false;
  float nearest = 0;    ///< metres; orthographic: reversed depth
  float per_metre = 1;  ///< depth per metre
};

/// Moments of depth x: mean of x and of x²; of exponentials: of e^(a x), its square, −e^(−b x) and its square. Single
/// precision ends at e^88.7, so the first exponent may not be over 44; differences of moments lose what is below 2⁻²⁴ of
/// them, so large ones do no harm. The second works on what the first is blind to, near casters before far ones; where a
/// lit surface is steep it is the one that darkens it, by 1 % with an exponent of 5, by 3 % with 10.
inline constexpr float kPositiveExponent = 40, kNegativeExponent = 5;

struct MomentLevel {
  int width = 0, height = 0;
  std::size_t first = 0;  ///< texel, in MomentMap's list
};

/// A mip chain of moments, 2 or 4 floats per texel side by side.
class MomentMap {
 public:
  /// Of a map whose tiles are all drawn. `blur`: texels to each side that a tent of weights reaches over.
  MomentMap(const DepthMap& map, const DepthMeasure& measure, ShadowMoments kind, float blur,
            InstructionSet set, const TaskPool& pool);

  [[nodiscard]] const std::vector<MomentLevel>& levels() const { return levels_; }
  [[nodiscard]] const float* moments() const { return moments_.data(); }
  [[nodiscard]] std::size_t memory_bytes() const { return moments_.capacity() * sizeof(float); }

 private:
  void find_finest(const DepthMap& map, const DepthMeasure& measure, ShadowMoments kind, float blur,
                   InstructionSet set, const TaskPool& pool);
  void halve(std::size_t level, std::size_t channels, const TaskPool& pool);

  std::vector<MomentLevel> levels_;
  AlignedVector<float> moments_;
};

/// The measure for maps of one light, whose tiles are all drawn.
DepthMeasure find_depth_measure(std::span<const std::shared_ptr<DepthMap>> maps, ShadowDepth depth,
                                const TaskPool& pool);

/// Moments of texels `first_x`… of row `y`, those beyond the map's sides like the nearest within; `count` is rounded up to
/// whole vectors of 16.
using FindMoments = void (*)(const DepthMap& map, const DepthMeasure& measure, ShadowMoments kind,
                             int first_x, int y, std::size_t count, float* moments);
FindMoments find_moments_for(InstructionSet set);
/// sum[i] = Σ weights[k] rows[k][i]; `count` likewise.
using AddWeighted = void (*)(std::span<const float> weights, std::span<const float* const> rows,
                             std::size_t count, float* sum);
AddWeighted add_weighted_for(InstructionSet set);

}  // namespace laterna::shadow
