// A scene at an instant: what its clips move is put where it then is.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "laterna/scene.h"

namespace laterna {

/// What a matrix without shear is made of; of others, the nearest by its columns.
Transform parts_of(const glm::dmat4& parent_from_node);

/// Whether a channel's target is a material.
bool changes_material(AnimatedProperty property);

/// Which nodes stand elsewhere at another time, or change their shape: those that clips which play move, all below them, and
/// those whose skins hang on such nodes. Empty where nothing moves.
std::vector<bool> moving_nodes(const Scene& scene);

/// The same where one node moves.
std::vector<bool> nodes_moved_by(const Scene& scene, int node);

/// Where AnimatedProperty::look_at puts a node: position, target, up. A gaze that a path leads through itself keeps to −Z.
glm::dmat4 gaze_matrix(std::span<const double> position_target_up);

/// Whose inputs a change of time has changed.
struct PoseChanges {
  bool nodes = false, cameras = false, lights = false, materials = false;
};

/// Remembers what things are where no clip moves them, so that a pose depends on the time alone and not on poses before it.
class ScenePose {
 public:
  ScenePose() = default;
  /// The scene must have passed validate(), and be at rest.
  explicit ScenePose(const Scene& scene);

  /// Puts everything that clips move where it is at a time in seconds. Values that interpolation has carried out of their
  /// range are held to it. Returns what has changed since the scene was posed last.
  PoseChanges apply(Scene& scene, double time) const;

  /// What a caller has put in place of a thing, which may be one that moves.
  void set_light(int light, const Light& value);
  void set_node(int node, const glm::dmat4& parent_from_node);

 private:
  struct NodeAtRest {
    glm::dmat4 parent_from_node;
    Transform transform;
    std::vector<float> weights;
  };
  std::map<int, NodeAtRest> nodes_;
  std::map<int, Camera> cameras_;
  std::map<int, Light> lights_;
  std::map<int, Material> materials_;
};

}  // namespace laterna
