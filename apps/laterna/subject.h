// What the measuring commands look at: a scene from files, or a workload.
#pragma once

#include <functional>

#include "frame_costs.h"
#include "scene_options.h"

namespace laterna::app {

struct SubjectOptions {
  SceneOptions scene;
  ViewOptions view;
  std::string workload, name = "W1", scenes;

  /// SCENE..., --rig, …, --camera, --size, --workload, --name, --scenes.
  void declare(CLI::App& command);
  /// Empty, or what is missing.
  [[nodiscard]] std::string find_fault(const std::string& command) const;
  /// Loads, lets `amend` change the scene, and makes it ready.
  using Amend = std::function<Result<Scene>(Scene scene)>;
  [[nodiscard]] Result<Subject> prepare(const Amend& amend = {}) const;

 private:
  [[nodiscard]] Result<Subject> prepare_workload(const Amend& amend) const;
  [[nodiscard]] Result<Subject> prepare_scene(const Amend& amend) const;
};

}  // namespace laterna::app
