// Rays from surfaces to lights, for questions that the picture does not answer.
#pragma once

#include <limits>
#include <memory>
#include <string>

#include "base/task_pool.h"
#include "frame/frame.h"
#include "trace/ray_scene.h"

namespace laterna::measure {

/// A scene's casters and lights, at one instant.
class ShadowRays {
 public:
  static Result<std::unique_ptr<const ShadowRays>> create(Scene scene, const TaskPool& pool);
  ~ShadowRays() = default;
  ShadowRays(const ShadowRays&) = delete;
  ShadowRays& operator=(const ShadowRays&) = delete;

  /// Null: no such light is on.
  [[nodiscard]] const frame::PlacedLight* find(const std::string& light) const;
  /// Whether anything casts a shadow on the point from between `near` and `far` metres. Const calls may come from several
  /// threads.
  [[nodiscard]] bool is_blocked(const frame::PlacedLight& light, const glm::dvec3& point_ws, double near,
                                double far = std::numeric_limits<double>::infinity()) const;

 private:
  explicit ShadowRays(Scene scene) : scene_(std::move(scene)) {}
  Scene scene_;
  frame::Frame frame_;
  std::unique_ptr<trace::RayScene> rays_;
};

}  // namespace laterna::measure
