// Settings of mirrors, as rigs and LATERNA_mirror have them.
#pragma once

#include <memory>
#include <string>

#include "laterna/mirrors.h"
#include "laterna/scene.h"
#include "scene/json_object.h"

namespace laterna {

/// `value`: the object that holds them, spelled as `names` has it. Faults are reported.
std::shared_ptr<const Mirror> read_mirror_settings(const JsonDocument& json, const JsonValue& value,
                                                   FaultList& faults, const SettingNames& names);

/// What keeps a material from being seen through its mirror's surface; empty: nothing.
std::string find_volume_fault(const Mirror& mirror, AlphaMode alpha_mode);

}  // namespace laterna
