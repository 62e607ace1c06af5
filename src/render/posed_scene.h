// A scene as it stands at a time: its state, what is loaded for it and the frame made of it, and all that changes it.
#pragma once

#include <memory>
#include <span>

#include "base/task_pool.h"
#include "frame/cluster_builder.h"
#include "frame/frame.h"
#include "frame/texture_library.h"
#include "laterna/render.h"
#include "render/caster_changes.h"
#include "render/caster_structures.h"
#include "scene/scene_pose.h"

namespace laterna::render {

/// What the calls do is what Renderer's of the same names say. A call that fails leaves everything as it was.
class PosedScene {
 public:
  /// The pool must outlive it.
  PosedScene(Scene scene, const RendererOptions& options, const TaskPool& pool);
  ~PosedScene() = default;
  PosedScene(const PosedScene&) = delete;
  PosedScene& operator=(const PosedScene&) = delete;

  /// Decodes pictures, cuts meshes into clusters and makes the frame.
  Result<void> load();

  Result<void> set_transform(int node, const glm::dmat4& parent_from_node);
  Result<void> set_light(int light, Light value);
  Result<void> set_photograph_gains(std::span<const glm::vec3> gains);
  Result<int> set_time(double seconds);

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const frame::Frame& frame() const { return frame_; }
  [[nodiscard]] const CasterStructures& casters() const { return casters_; }
  [[nodiscard]] const CasterChanges& caster_changes() const { return caster_changes_; }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] const PosingStatistics& posing() const { return posing_; }

 private:
  void tell_warnings();
  Result<void> rebuild();
  Result<PoseChanges> pose(double seconds);
  Result<void> follow(const PoseChanges& changes);
  void return_to(double seconds);
  bool let_move(int node);
  void forget_casters();

  Scene scene_;  // as it is posed now
  const TaskPool& pool_;
  InstructionSet instruction_set_;
  double time_;
  ScenePose poses_;
  PosingStatistics posing_;
  std::shared_ptr<frame::TextureLibrary> textures_;
  frame::ClusteredMeshes meshes_;
  std::vector<bool> may_move_;  // of nodes: set by callers, and followed by the frame since
  frame::Frame frame_;
  CasterStructures casters_;
  CasterChanges caster_changes_;
};

}  // namespace laterna::render
