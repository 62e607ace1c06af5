// Which glTF extensions are read, and what is said about the others.
#pragma once

#include <string_view>

#include "scene/fault_list.h"
#include "scene/json_document.h"

namespace laterna::gltf {

/// value.extensions[name]; null when there is none.
const JsonValue* find_extension(const JsonValue& value, std::string_view name);

/// Checks asset.version, extensionsRequired (an extension that is not read is an error) and extensionsUsed
/// (one that changes the look and is not read is a warning; others pass in silence).
void check_requirements(const JsonDocument& json, FaultList& faults);

}  // namespace laterna::gltf
