// Shadow techniques as the command line names them.
#pragma once

#include <string>
#include <vector>

#include "laterna/render.h"

namespace laterna::app {

/// Of all that there are.
std::vector<std::string> technique_names();
std::string name_of(ShadowTechnique technique);
/// "all", or names with commas between. Error: a name that no technique has; lists those that there are.
Result<std::vector<ShadowTechnique>> parse_techniques(const std::string& list);
/// The parts between commas, without empty ones.
std::vector<std::string> split_list(const std::string& list);

}  // namespace laterna::app
