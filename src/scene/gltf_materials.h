// materials[] of a glTF file.
#pragma once

#include "laterna/scene.h"
#include "scene/gltf_textures.h"

namespace laterna::gltf {

/// One material with its textures. Factors outside their range are limited, with a warning.
Material read_material(const JsonDocument& json, const JsonValue& value, Textures& textures,
                       FaultList& faults);

/// The materials in use, read when first asked for.
class Materials {
 public:
  Materials(const JsonDocument& json, Textures& textures, FaultList& faults);

  /// materials[].size() of the file.
  [[nodiscard]] std::size_t count() const { return values_.size(); }
  /// The scene's index of a material of the file; −1 stays −1.
  int use(int material);
  [[nodiscard]] const Material& operator[](int index) const {
    return materials_[static_cast<std::size_t>(index)];
  }
  /// The scene's index of each material of the file, −1 where it is not used.
  [[nodiscard]] const std::vector<int>& indices() const { return index_of_; }
  std::vector<Material> take() { return std::move(materials_); }

 private:
  const JsonDocument& json_;
  Textures& textures_;
  FaultList& faults_;
  std::vector<const JsonValue*> values_;
  std::vector<int> index_of_;  // −1: not yet read
  std::vector<Material> materials_;
};

}  // namespace laterna::gltf
