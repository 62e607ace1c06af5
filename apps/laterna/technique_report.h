// What `laterna bench --techniques` tells.
#pragma once

#include <nlohmann/json.hpp>

#include "projection_cost.h"
#include "technique_comparison.h"

namespace laterna::app {

nlohmann::ordered_json json_of(const TechniqueComparison& comparison, const ProjectionCost& projection);
void print_table(const TechniqueComparison& comparison, const ProjectionCost& projection);

}  // namespace laterna::app
