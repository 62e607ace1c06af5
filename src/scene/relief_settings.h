// What rigs and LATERNA_relief say of a relief beside its picture.
#pragma once

#include "laterna/relief.h"
#include "scene/json_object.h"

namespace laterna {

/// Reads "depth", "kind", "self_shadow" and "cut_edges".
void read_relief_settings(JsonObject& object, Relief& relief);

}  // namespace laterna
