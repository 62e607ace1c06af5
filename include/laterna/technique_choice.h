// Which shadow technique a light gets.
#pragma once

#include "laterna/scene.h"

namespace laterna {

/// The light's own technique; without one the picture's, where it can serve such a light (find_fault); else `map`, which
/// serves all. In place of `map`, a projector whose lens is open (Aperture) gets `pcss`, so that its shadows are as soft as
/// its slide.
ShadowTechnique technique_for(const Light& light, ShadowTechnique of_picture);

}  // namespace laterna
