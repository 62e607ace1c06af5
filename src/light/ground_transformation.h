// Shadows on a plane as a 4×4 matrix: Blinn, Me and my (fake) shadow, 1988; Bentley, A comparison of shadow algorithms,
// 1995.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "laterna/shadows.h"

namespace laterna::light {

/// n·x = d as (n, −d) with n of length 1: its dot product with a point (x, 1) is the height over the plane.
glm::dvec4 plane_equation(const ShadowPlane& plane);

/// Takes a homogeneous world point to its shadow on the plane, in world space and homogeneous: the place where the line
/// through the point and the light meets the plane. `light` is (position, 1) of a local light, or (direction toward it,
/// 0) of one at infinity.
///
/// With π the plane's equation, M = (π·light) I − light πᵀ. The fourth coordinate of M (x, 1) is the light's height less
/// the point's (at infinity: the light's alone). Where it has not the sign of the light's height, point and shadow are
/// on different sides of the light: what the division gives there is a mirrored ghost, and no shadow.
glm::dmat4 ground_transformation(const glm::dvec4& plane_equation, const glm::dvec4& light);

}  // namespace laterna::light
