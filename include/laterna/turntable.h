// A camera that goes round what it looks at.
#pragma once

#include <glm/vec3.hpp>

#include "laterna/view.h"

namespace laterna {

/// A view carried round the vertical axis through `centre_ws` by so many turns, counter-clockwise as seen from above: as if
/// the scene stood on a turntable that went the other way. Whole turns are the view itself, bit for bit.
View turned_about(const View& view, const glm::dvec3& centre_ws, double turns);

}  // namespace laterna
