// The picture that transmissive surfaces show: drawn before the picture itself, without them.
#pragma once

#include <vector>

#include "laterna/render.h"
#include "shade/earlier_view.h"

namespace laterna::render {

class BehindPicture {
 public:
  BehindPicture(int width, int height);

  /// Channels R, G and B of a picture of that size, in linear radiance.
  [[nodiscard]] RenderTarget target();
  /// Once it is drawn.
  [[nodiscard]] shade::EarlierView seen_from(const raster::RasterView& view, InstructionSet set) const;

 private:
  int width_, height_;
  std::vector<float> planes_[3];
};

}  // namespace laterna::render
