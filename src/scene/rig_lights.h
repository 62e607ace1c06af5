// What can be said of a light: one entry of a rig's "lights", and what glTF's own lights leave unsaid.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "laterna/scene.h"
#include "scene/json_object.h"

namespace laterna {

/// The files that a light names, looked for as its own file does it.
class LightFiles {
 public:
  LightFiles() = default;
  LightFiles(const LightFiles&) = delete;
  LightFiles& operator=(const LightFiles&) = delete;
  virtual ~LightFiles() = default;

  /// The file that is there under a name. Error: why there is none.
  virtual tl::expected<std::filesystem::path, std::string> find(std::string_view name) = 0;
  /// Where a name of numbered pictures points.
  virtual std::optional<std::filesystem::path> pattern(std::string_view name) = 0;
  /// The picture that a member of a light names; reports and gives −1 when it is faulty.
  virtual int read_picture(JsonObject& light, std::string_view key) = 0;
  virtual int add(Picture picture) = 0;
  [[nodiscard]] virtual const Picture& at(int picture) const = 0;
};

struct RigLight {
  Light light;  ///< its slide counts into the pictures of `files`; the name is as written, or empty
  glm::dmat4 world_from_light{1.0};
};

/// Nothing when faulty.
std::optional<RigLight> read_rig_light(const JsonDocument& json, const JsonValue& value, LightFiles& files,
                                       FaultList& faults);

/// The extension of a glTF light, whose own members, type and lamp are in `light`: what the extension does not say stays as
/// it is there.
Light read_light_extension(const JsonDocument& json, const JsonValue& value, LightFiles& files,
                           FaultList& faults, Light light);

}  // namespace laterna
