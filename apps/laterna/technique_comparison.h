// Shadow techniques beside each other: what a frame costs with each, and how right it is.
#pragma once

#include <string>
#include <vector>

#include "frame_costs.h"
#include "laterna/accuracy.h"

namespace laterna::app {

struct TechniqueResult {
  ShadowTechnique technique = ShadowTechnique::none;
  double frame_ms = 0;   ///< median
  double shadow_ms = 0;  ///< of it, all threads together: preparing maps and the like, and asking them
  double map_ms = 0;     ///< of that, drawing shadow maps
  double mb = 0;         ///< of maps and the like
  std::vector<std::string> by_map;  ///< lights that it cannot serve: they have `map` in its frames
  // Of the light for which it is worst:
  double wrong_share = 0, acne = 0, gap_texels = 0, edge_px_median = 0, edge_px_mean = 0, edge_px_p99 = 0;
};

struct TechniqueComparison {
  std::vector<TechniqueResult> results;
  struct Skipped {
    ShadowTechnique technique;
    std::string reason;
  };
  std::vector<Skipped> skipped;  ///< those that can serve no light
  std::string advice;
};
/// All lights' own techniques are set aside.
Result<TechniqueComparison> compare_techniques(const Subject& subject, const FrameSeries& series,
                                               const std::vector<ShadowTechnique>& techniques);

/// Which to take, and why, from what was measured.
std::string advise(const std::vector<TechniqueResult>& results);

}  // namespace laterna::app
