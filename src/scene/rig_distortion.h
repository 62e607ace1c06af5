// How a rig describes what a projector's lens does to straight lines.
#pragma once

#include "laterna/scene.h"
#include "scene/json_object.h"

namespace laterna {

/// Reads "distortion" of a projector, OpenCV's coefficients by name or in its order, [k1, k2, p1, p2] or
/// [k1, k2, p1, p2, k3], into `light`, whose projection must have been read. Reports what cannot be inverted.
void read_rig_distortion(const JsonDocument& json, JsonObject& light_object, FaultList& faults, Light& light);

}  // namespace laterna
