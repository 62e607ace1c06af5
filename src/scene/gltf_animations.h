// animations[] of a glTF file, with KHR_animation_pointer.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "laterna/scene.h"
#include "scene/fault_list.h"
#include "scene/gltf_accessors.h"
#include "scene/json_document.h"
#include "scene/json_object.h"

namespace laterna::gltf {

/// The scene's indices of what a file numbers: lists at [index in the file], empty where it is not shown. A light or camera
/// that hangs on several nodes is several in the scene.
struct SceneIndices {
  std::vector<int> nodes;  ///< −1: not shown
  std::vector<std::vector<int>> cameras, lights;
  std::vector<int> materials;  ///< −1: not used
};

class Animations {
 public:
  Animations(const JsonDocument& json, Accessors& accessors, FaultList& faults);

  /// Whether any clip moves the weights of a node, or of its mesh.
  [[nodiscard]] bool move_weights(int node, int mesh) const;

  /// All clips; the first plays. `scene`: everything else of the file, of which a few constants are read. What is animated
  /// but not shown is left out, and what cannot be animated is left out with a warning.
  std::vector<Clip> read(const SceneIndices& indices, const Scene& scene);

 private:
  struct Target;     // what a channel moves, as the file says it
  class ClipReader;  // one animation

  /// Another that tells its faults to another list.
  Animations(const Animations& other, FaultList& faults);
  std::optional<Target> parse_target(const JsonValue& channel);
  std::optional<Target> parse_pointer(JsonObject& place, const std::string& pointer);

  const JsonDocument& json_;
  Accessors& accessors_;
  FaultList& faults_;
  std::vector<const JsonValue*> values_;
  std::set<int> nodes_with_weights_, meshes_with_weights_;
  std::uint64_t number_total_ = 0;
};

}  // namespace laterna::gltf
