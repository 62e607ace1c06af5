// Several files become one scene.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "laterna/scene.h"
#include "scene/fault_list.h"
#include "scene/scene_settings.h"
#include "scene/surface_overrides.h"
#include "scene/unique_names.h"

namespace laterna {

/// A rig's change to the flags of the nodes of one name and of everything below them, and what moves it.
struct NodeOverride {
  std::string name;
  NodeFlags flags;
  std::string file, place;   ///< where it is written
  std::optional<Clip> path;  ///< moves the node; its channels' targets are still to be set
};

/// Where what a scene holds has gone.
struct MergedIndices {
  std::vector<int> pictures;  ///< new indices, by the old ones
  int first_light = 0;
};

class SceneMerger {
 public:
  /// Appends a scene. Pictures from the same file become one; cameras and lights whose name is taken are
  /// renamed ("sun.2") with a warning; ambient, background, highlight and environment of a later scene win where it has them.
  MergedIndices add(Scene scene, const std::string& file);

  /// Changes nodes of all scenes added so far; nodes without that name are also found by their mesh's name.
  /// Later overrides win. Faults: no such node, or one that cannot move.
  void apply(const std::vector<NodeOverride>& overrides, std::vector<Diagnostic>& faults);

  /// Lays further layers on surfaces, in their order.
  void apply(const std::vector<SurfaceOverride>& overrides, std::vector<Diagnostic>& faults);

  Scene take() { return std::move(merged_); }

 private:
  std::vector<int> add_pictures(std::vector<Picture>& pictures);
  template <class Named>
  void rename_taken(std::vector<Named>& things, UniqueNames& names, const char* kind,
                    const std::string& file);

  Scene merged_;
  std::map<std::filesystem::path, int> picture_of_file_;
  UniqueNames camera_names_, light_names_;
};

}  // namespace laterna
