// The picture of a view without what light goes through, for those surfaces to be looked through.
#pragma once

#include "image/mip_chain.h"
#include "shade/pixel_rays.h"

namespace laterna::shade {

struct EarlierView {
  image::MipChain radiance;  ///< linear, of the whole picture
  PixelRays rays;            ///< of the view
  float origin_x, origin_y;  ///< RasterView's

  EarlierView(const raster::RasterView& view, image::MipChain picture)
      : radiance(std::move(picture)),
        rays(view),
        origin_x(static_cast<float>(view.origin_x)),
        origin_y(static_cast<float>(view.origin_y)) {}
};

}  // namespace laterna::shade
