// A light's "shadow" in a rig.
#pragma once

#include "laterna/scene.h"
#include "scene/json_object.h"

namespace laterna {

/// Reads the member "shadow" of a light into `light.shadow`: true, false or an object. The rest of the light, whose type
/// decides what it can have, has been read.
void read_rig_shadow(const JsonDocument& json, JsonObject& object, FaultList& faults, Light& light);

}  // namespace laterna
