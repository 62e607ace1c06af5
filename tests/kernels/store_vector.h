// A vector of double precision as sample `i` of three planes.
#pragma once

#include <glm/vec3.hpp>

#include "shadow/surface_samples.h"

namespace laterna::shade {

inline void store(const glm::dvec3& v, shadow::SampleArray<float>& x, shadow::SampleArray<float>& y,
                  shadow::SampleArray<float>& z, std::size_t i) {
  x[i] = static_cast<float>(v.x), y[i] = static_cast<float>(v.y), z[i] = static_cast<float>(v.z);
}

}  // namespace laterna::shade
