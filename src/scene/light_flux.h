// Lumens and candela of lights whose beam has a formula. Intensity maps: frame/place_lights.h; measured lamps:
// laterna/lamps.h.
#pragma once

#include "laterna/scene.h"

namespace laterna {

/// Candela on the axis that make the frame of a projector throw `lumens` in all (row 16): flux = intensity × solid
/// angle for uniform candela, illuminance at 1 m × area of the frame at 1 m for a flat field.
double candela_from_lumens(double lumens, const Projection& projection, BeamProfile profile);

/// Solid angle of a perspective frustum in steradians.
double solid_angle(const Projection& projection);

/// ∫ of a spot's angular term (KHR_lights_punctual) over all directions: lumens per candela on the axis.
double solid_angle_of_spot(const Light& spot);

}  // namespace laterna
