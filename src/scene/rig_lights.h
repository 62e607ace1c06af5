// One entry of a rig's "lights".
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "laterna/scene.h"
#include "scene/json_object.h"

namespace laterna {

struct RigLight {
  Light light;  ///< its slide counts into the rig's pictures; the name is as written, or empty
  glm::dmat4 world_from_light{1.0};
};

/// Nothing when faulty. Slides are added to `pictures`.
std::optional<RigLight> read_rig_light(const JsonDocument& json, const JsonValue& value,
                                       const std::filesystem::path& folder, std::vector<Picture>& pictures,
                                       FaultList& faults);

}  // namespace laterna
