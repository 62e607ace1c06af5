// cameras[] and KHR_lights_punctual of a glTF file.
#pragma once

#include <optional>

#include "laterna/scene.h"
#include "scene/fault_list.h"
#include "scene/gltf_light_extensions.h"
#include "scene/json_document.h"

namespace laterna::gltf {

/// Nothing when it is faulty. Without zfar the frustum is endless; without aspectRatio it follows the
/// picture. What LATERNA_lighting says of the frustum replaces glTF's own.
std::optional<Camera> read_camera(const JsonDocument& json, const JsonValue& value, FaultList& faults);

/// Nothing when it is faulty. With a range the light fades as gltf_windowed, otherwise as inverse_square, unless its
/// extensions say otherwise.
std::optional<Light> read_light(const JsonDocument& json, const JsonValue& value, LightExtensions& extensions,
                                FaultList& faults);

/// extensions.KHR_lights_punctual.lights of the file; null when there are none.
const JsonValue* find_lights(const JsonDocument& json, FaultList& faults);

}  // namespace laterna::gltf
