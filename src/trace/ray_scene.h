// The truth: rays against the frame's triangles, traced by Embree.
#pragma once

#include <glm/vec3.hpp>
#include <memory>

#include "frame/frame.h"

namespace laterna::trace {

/// The frame's shadow casters as Embree sees them (robust intersection: no ray slips between two triangles). Results
/// are Embree's, the same for any number of threads; its instruction set is pinned.
class RayScene {
 public:
  /// The frame must outlive this.
  explicit RayScene(const frame::Frame& frame);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Whether anything that casts shadows lies on origin + t direction, t in [near, far]. Triangle `own`, on which the
  /// ray starts, is left out; cut-out and blended surfaces block where their alpha at full texture size reaches the
  /// cutoff. Const calls may come from several threads.
  [[nodiscard]] bool is_blocked(const glm::vec3& origin_ws, const glm::vec3& direction_ws, float near,
                                float far, TriangleId own) const;

  /// Nearest hit, or kNoTriangle.
  struct Hit {
    TriangleId id = kNoTriangle;
    float t = 0;
  };
  [[nodiscard]] Hit nearest(const glm::vec3& origin_ws, const glm::vec3& direction_ws, float near,
                            float far) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace laterna::trace
