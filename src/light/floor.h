// The plane that ground shadows fall on where none is named.
#pragma once

#include <optional>

#include "frame/frame.h"
#include "laterna/shadows.h"

namespace laterna::light {

/// How far from a plane a surface may lie and be taken for it: rounding, and decimals that somebody typed.
double plane_tolerance(const frame::Frame& frame);

/// The lowest horizontal plane that faces up and is at least half as large as the largest, by the area of the triangles
/// that lie in it: a building's floor rather than its roof, and not the bottom of a well. Only what receives shadows and
/// is seen by cameras counts. Where no triangle's front is up, those that are seen from both sides do.
std::optional<ShadowPlane> find_floor(const frame::Frame& frame);

}  // namespace laterna::light
