// One entry of a rig's "surfaces": layers and a relief for the surfaces of a material or of a node.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "laterna/scene.h"
#include "scene/json_object.h"
#include "scene/surface_overrides.h"

namespace laterna {

/// Nothing when faulty. Textures are added to `pictures`, and the layers count into them.
std::optional<SurfaceOverride> read_rig_surface(const JsonDocument& json, const JsonValue& value,
                                                const std::filesystem::path& folder,
                                                std::vector<Picture>& pictures, FaultList& faults);

/// Adds the file of that name, as a rig's member has it, to `pictures`. −1 where there is none, which is reported.
int add_rig_picture(JsonObject& object, std::string_view member, const std::filesystem::path& folder,
                    std::vector<Picture>& pictures);

}  // namespace laterna
