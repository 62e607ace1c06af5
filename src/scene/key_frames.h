// What key frames come to at an instant.
#pragma once

#include <glm/vec4.hpp>
#include <span>

#include "laterna/animation.h"

namespace laterna {

/// Values at a time in seconds (glTF 2.0, appendix C); `values` holds as many numbers as a key has. `is_rotation`: they are
/// unit quaternions, and so is the result.
void sample_keys(const KeyFrames& keys, double time, bool is_rotation, std::span<double> values);

/// From the unit quaternion `a` (at 0) to `b` (at 1), along the shorter arc at even speed (Shoemake, Animating rotation with
/// quaternion curves, 1985).
glm::dvec4 slerp(const glm::dvec4& a, glm::dvec4 b, double t);

/// Where a clip stands at a scene time: seconds from its start, after its `at_end`.
double clip_time(const Clip& clip, double duration, double scene_time);

}  // namespace laterna
