// A rig's "mirror": what makes a surface show the scene.
#pragma once

#include <memory>

#include "laterna/mirrors.h"
#include "scene/json_object.h"

namespace laterna {

/// `value`: the object's member "mirror". Faults are reported.
std::shared_ptr<const Mirror> read_rig_mirror(const JsonDocument& json, const JsonValue& value,
                                              FaultList& faults);

}  // namespace laterna
