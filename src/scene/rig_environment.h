// "environment" of a rig.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "laterna/scene.h"
#include "scene/fault_list.h"
#include "scene/json_document.h"

namespace laterna {

/// Nothing when it is faulty. Its picture is put into `pictures`; names are relative to `folder`.
std::optional<Environment> read_rig_environment(const JsonDocument& json, const JsonValue& value,
                                                const std::filesystem::path& folder,
                                                std::vector<Picture>& pictures, FaultList& faults);

}  // namespace laterna
