// skins[] of a glTF file.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "laterna/scene.h"
#include "scene/fault_list.h"
#include "scene/gltf_accessors.h"
#include "scene/json_document.h"

namespace laterna::gltf {

class Skins {
 public:
  Skins(const JsonDocument& json, Accessors& accessors, FaultList& faults);

  /// skins[].size() of the file.
  [[nodiscard]] std::size_t count() const { return values_.size(); }
  /// The scene's index of a skin of the file.
  int use(int skin);
  /// Those in use, once every node of the file has its number in the scene: at [node of the file], −1 where it is not shown.
  std::vector<Skin> read(std::span<const int> scene_node_of);

 private:
  Skin read_skin(const JsonValue& value, std::span<const int> scene_node_of);

  const JsonDocument& json_;
  Accessors& accessors_;
  FaultList& faults_;
  std::vector<const JsonValue*> values_;
  std::vector<int> used_;  // skins of the file
  std::map<int, int> index_of_;
};

}  // namespace laterna::gltf
