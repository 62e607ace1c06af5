// Settings in a rig that the light's shadow technique does not read.
#pragma once

#include "laterna/shadows.h"
#include "scene/json_object.h"

namespace laterna {

/// Warns at each member of a light's "shadow" that says something else than the default and that the technique named beside
/// it ignores. Where none is named, the picture's decides, which is not known here; "none" ignores all, for a while.
void warn_of_unread_settings(JsonObject& shadow, const ShadowSettings& settings);

}  // namespace laterna
