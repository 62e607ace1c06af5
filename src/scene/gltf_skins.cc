#include "scene/gltf_skins.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "scene/json_object.h"

namespace laterna::gltf {

Skins::Skins(const JsonDocument& json, Accessors& accessors, FaultList& faults)
    : json_(json), accessors_(accessors), faults_(faults) {
  JsonObject root(json, json.root(), faults);
  const JsonValue* list = root.array("skins");
  if (list == nullptr) return;
  for (const JsonValue& value : list->children) values_.push_back(&value);
}

int Skins::use(int skin) {
  const auto [known, is_new] = index_of_.try_emplace(skin, static_cast<int>(used_.size()));
  if (is_new) used_.push_back(skin);
  return known->second;
}

std::vector<Skin> Skins::read(std::span<const int> scene_node_of) {
  std::vector<Skin> skins;
  for (const int skin : used_)
    skins.push_back(read_skin(*values_[static_cast<std::size_t>(skin)], scene_node_of));
  return skins;
}

namespace {

// Columns; the last row is 0 0 0 1, whatever rounding has left there.
glm::dmat4 affine_matrix(const float* values) {
  glm::dmat4 matrix;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) matrix[column][row] = values[4 * column + row];
    matrix[column][3] = column == 3 ? 1 : 0;
  }
  return matrix;
}

}  // namespace

Skin Skins::read_skin(const JsonValue& value, std::span<const int> scene_node_of) {
  JsonObject object(json_, value, faults_);
  Skin skin;
  skin.name = object.string("name").value_or("");
  object.require("joints");
  const JsonValue* joints = object.array("joints");
  if (joints == nullptr) return skin;
  if (joints->children.empty()) object.error("joints", "expected at least one joint");
  for (const JsonValue& joint : joints->children) {
    const double index = joint.number;
    if (joint.kind != JsonValue::Kind::number || index < 0 || index != std::floor(index)) {
      faults_.error(json_.place(joint), fmt::format("expected the index of a node, got {}", describe(joint)));
    } else if (index >= static_cast<double>(scene_node_of.size())) {
      faults_.error(json_.place(joint),
                    fmt::format("refers to nodes[{}], but there are only {}", index, scene_node_of.size()));
    } else if (scene_node_of[static_cast<std::size_t>(index)] < 0) {
      faults_.error(json_.place(joint),
                    fmt::format("nodes[{}] is a joint, but not in the scene that is shown", index));
    } else {
      skin.joints.push_back(scene_node_of[static_cast<std::size_t>(index)]);
    }
  }
  skin.joint_from_bind.assign(skin.joints.size(), glm::dmat4(1.0));
  const int accessor = object.index("inverseBindMatrices", accessors_.size(), "accessors");
  if (accessor < 0) return skin;
  const std::string place = json_.place(value, "inverseBindMatrices");
  const auto numbers = accessors_.read_numbers(accessor, 16, place);
  if (!numbers) return skin;
  if (numbers->size() / 16 < skin.joints.size()) {
    faults_.error(place, fmt::format("has {} matrices, but there are {} joints", numbers->size() / 16,
                                     skin.joints.size()));
    return skin;
  }
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const glm::dmat4 matrix = affine_matrix(numbers->data() + 16 * i);
    if (glm::determinant(glm::dmat3(matrix)) == 0)
      faults_.error(place, fmt::format("matrix {} is singular: it has no inverse", i));
    skin.joint_from_bind[i] = matrix;
  }
  return skin;
}

}  // namespace laterna::gltf
