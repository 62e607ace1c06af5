// The truth: rays against the frame's triangles, traced by Embree.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

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

  /// Whether anything opaque that casts shadows lies on origin + t direction, t in [near, far]. Triangle `own`, on which
  /// the ray starts, is left out; cut-outs block where their alpha at full texture size reaches the cutoff. Const calls
  /// may come from several threads.
  [[nodiscard]] bool is_blocked(const glm::vec3& origin_ws, const glm::vec3& direction_ws, float near,
                                float far, TriangleId own) const;

  /// The nearest of what is_blocked() asks about. `b` and `c`: weights of the triangle's second and third corner.
  struct Hit {
    TriangleId id;
    float b, c;
    float distance;  ///< t
  };
  [[nodiscard]] std::optional<Hit> find_nearest(const glm::vec3& origin_ws, const glm::vec3& direction_ws,
                                                float near, float far, TriangleId own) const;

  /// Where the ray meets blended surfaces that cast shadows, on the same terms: appended in any order. `b` and `c`: weights
  /// of the second and third corner.
  struct Pane {
    TriangleId id;
    float b, c;
  };
  void find_panes(const glm::vec3& origin_ws, const glm::vec3& direction_ws, float near, float far,
                  TriangleId own, std::vector<Pane>& panes) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace laterna::trace
