// What it saves to draw only the silhouettes that a picture asks for (row 47 of the papers' list).
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "frame_costs.h"

namespace laterna::app {

/// The same frames twice: with occluders culled, and with every silhouette drawn.
struct CullingComparison {
  FrameCosts culled, unculled;
};

/// None where the frames had no silhouettes. `costs`: of the subject as it is; what it does not tell is drawn anew.
/// Leaves the subject's lights unculled.
Result<std::optional<CullingComparison>> compare_culling(Subject& subject, const FrameSeries& series,
                                                         const FrameCosts& costs);

nlohmann::json json_of(const CullingComparison& comparison);
void print_table(const CullingComparison& comparison);

}  // namespace laterna::app
