// Where on its surfaces each luxel of a light map finds its light.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/flat_triangle.h"
#include "frame/frame.h"
#include "trace/ray_scene.h"

namespace laterna::bake {

/// Pages are worked on in squares of so many luxels.
inline constexpr int kTileSide = 32;

/// A point on a triangle.
struct Receiver {
  std::uint32_t luxel = 0;  ///< in the tile, row by row
  TriangleId id = kNoTriangle;
  glm::vec3 position_ws{0};
  glm::vec3 normal_ws{0};            ///< of the triangle, unit, on its front
  glm::vec3 shading_normal_ws{0};    ///< unit, on that side too
  float weight_b = 0, weight_c = 0;  ///< of its triangle's second and third corner
  float area = 0;                    ///< of the surface that it stands for, in square metres
};

/// The triangles of a page, by the tiles that they and the luxels read at their rims reach.
class PageTriangles {
 public:
  /// `materials`: whether triangles of a material are on the page.
  PageTriangles(const frame::Frame& frame, const std::vector<bool>& materials, glm::ivec2 size);

  [[nodiscard]] glm::ivec2 size() const { return size_; }
  [[nodiscard]] glm::ivec2 tiles() const { return tiles_; }
  [[nodiscard]] std::span<const TriangleId> at(glm::ivec2 tile) const;

 private:
  glm::ivec2 size_, tiles_{0};
  std::vector<std::uint32_t> first_;  // by tile, and the end
  std::vector<TriangleId> triangles_;
};

/// How receivers are found.
struct ReceiverSettings {
  int samples = 1;          ///< of a luxel's side
  double luxel_side = 0.1;  ///< metres
};

/// The point of a triangle with these weights of its corners; of no luxel, and standing for no area.
Receiver receiver_on(const frame::Frame& frame, TriangleId id, FlatWeights weights);

/// The receivers of one tile, by luxel. A luxel that holds none of the places where it is sampled has the point of a surface
/// that is nearest to its middle, where one is within reach. No receiver lies within a fiftieth of a luxel of an edge of its
/// triangle, where a triangle allows: there it might lie in the wall beside a floor. One that the luxel's middle cannot see
/// along the surface is left out: it lies in another room.
void find_receivers(const frame::Frame& frame, const trace::RayScene& rays, const PageTriangles& page,
                    glm::ivec2 tile, const ReceiverSettings& settings, std::vector<Receiver>& receivers);

/// One receiver for each of these luxels, the point that is nearest to its middle. It stands for all of the surface in the
/// luxel; for next to nothing, where there is none.
void find_middles(const frame::Frame& frame, const PageTriangles& page, glm::ivec2 tile,
                  const ReceiverSettings& settings, std::vector<Receiver>& receivers);

}  // namespace laterna::bake
