// What a scene needs to be shown and does not bring.
#pragma once

#include "laterna/scene.h"

namespace laterna::render {

/// A sun over the viewer's shoulder and a little ambient light, for a scene that brings no light of its own.
void add_default_light(Scene& scene);

/// Tangents for normal maps, where the caller gave none. Readers of files have done so already.
void add_missing_tangents(Scene& scene);

}  // namespace laterna::render
