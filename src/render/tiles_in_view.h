// Where boxes of the world lie in a picture, to be on the safe side.
#pragma once

#include "frame/frame.h"
#include "raster/raster_view.h"
#include "raster/triangle_bins.h"

namespace laterna::render {

/// Tiles of the view's picture that hold all that can be seen of the box, wherever its near plane is; empty where nothing can.
raster::Rect tiles_in_view(const raster::RasterView& view, const frame::Bounds& box);

/// Whether the near plane may be in either place: between both, and where either stands, there is no opaque caster within
/// the sides of the picture, so that all of them are cut alike. The views are alike but for that plane.
bool is_clear_between(const raster::RasterView& a, const raster::RasterView& b, const frame::Frame& frame);

}  // namespace laterna::render
