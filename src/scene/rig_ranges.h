// The numbers that a rig may hold, beyond those that any JSON may (scene/json_object.h).
#pragma once

#include "laterna/scene.h"
#include "scene/json_object.h"

namespace laterna {

/// Metres, of things that may have no size.
inline constexpr NumberRange kLength{0, kMaxCoordinate, false, false};
/// Metres, of what has a size.
inline constexpr NumberRange kPositiveLength{0, kMaxCoordinate, true, false};
inline constexpr NumberRange kCoordinate{-kMaxCoordinate, kMaxCoordinate, false, false};
inline constexpr NumberRange kFieldOfView{0, 180, true, true};
inline constexpr NumberRange kHalfAngle{0, 90, false, false};

/// Candela, lux, lumens, radiance and factors of colour: far above any lamp, and products of three stay finite in single
/// precision.
inline constexpr NumberRange kAmountOfLight{0, 1e12, false, false};

}  // namespace laterna
