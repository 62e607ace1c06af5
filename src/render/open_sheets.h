// Which meshes are no bodies: row 81's caution.
#pragma once

#include "laterna/scene.h"

namespace laterna::render {

/// Whether every edge of the mesh's triangles is met by as many triangles from one side as from the other, corners at
/// the same place being one corner.
bool is_closed(const Mesh& mesh);

/// Lights that draw only back faces into their shadow maps are for closed meshes: an open sheet casts no shadow where
/// they fall on its front. Each mesh that casts and is open gets a warning, if the scene has such a light.
void warn_of_open_sheets(Scene& scene);

}  // namespace laterna::render
