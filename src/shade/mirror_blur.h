// Rough mirrors: a picture of what they show, seen in a cone of rays. docs/mirrors.md
#pragma once

#include <glm/vec3.hpp>

#include "raster/raster_view.h"
#include "shade/mirror_picture.h"

namespace laterna::shade {

/// The mean of the picture over rays of a cone whose tangent is `spread`, about the one that ends at (x, y) of the picture; they
/// start at a place of the mirror, `distance` metres along the axis of `view`.
glm::vec3 blurred(const MirrorPicture& picture, const raster::RasterView& view, float spread, float distance,
                  float x, float y);

}  // namespace laterna::shade
