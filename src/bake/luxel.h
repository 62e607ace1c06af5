// The points that light maps hold light for.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/triangle_clusters.h"

namespace laterna::bake {

/// A texel of a light map that lies on a surface. A surface that is lit on both sides has luxels on both, told apart by
/// their normals.
struct Luxel {
  glm::vec3 position_ws;  ///< on its triangle
  glm::vec3 normal_ws;    ///< unit, on the side that receives light
  float area = 0;         ///< of the surface that it stands for, in m², > 0
  TriangleId triangle = kNoTriangle;
  glm::vec3 reflectance;  ///< diffuse, per channel, in [0, 1]
};

/// All channels of light together.
inline float sum_of(const glm::vec3& light) { return light.x + light.y + light.z; }

}  // namespace laterna::bake
