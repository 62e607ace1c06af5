// EXT_lights_ies of a glTF file: measured lamps on nodes.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "laterna/lamps.h"
#include "laterna/scene.h"
#include "scene/fault_list.h"
#include "scene/gltf_buffers.h"
#include "scene/gltf_light_extensions.h"
#include "scene/json_document.h"

namespace laterna::gltf {

class Lamps {
 public:
  /// Profiles given by `uri` are looked for in `folder`.
  Lamps(const JsonDocument& json, Buffers& buffers, std::filesystem::path folder, FaultList& faults);

  /// The lamp that a node's extension names; nothing where it has none, or a faulty one. Each profile is read once.
  std::optional<Light> read(const JsonValue& node, LightExtensions& extensions);

 private:
  struct Profile {
    bool is_read = false;
    std::shared_ptr<const LightDistribution> distribution;  // null: faulty, and reported
  };

  std::shared_ptr<const LightDistribution> profile(std::size_t index);
  std::optional<Result<LightDistribution>> load(const JsonValue& value);

  const JsonDocument& json_;
  Buffers& buffers_;
  std::filesystem::path folder_;
  FaultList& faults_;
  const JsonValue* list_ = nullptr;
  std::vector<Profile> profiles_;
};

}  // namespace laterna::gltf
