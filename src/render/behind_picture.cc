#include "render/behind_picture.h"

#include <string>

namespace laterna::render {

BehindPicture::BehindPicture(int width, int height) : width_(width), height_(height) {
  for (std::vector<float>& plane : planes_)
    plane.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

RenderTarget BehindPicture::target() {
  RenderTarget target;
  for (std::size_t i = 0; i < 3; ++i)
    target.channels.push_back(
        {std::string(1, "RGB"[i]), planes_[i].data(), static_cast<std::size_t>(width_)});
  return target;
}

shade::EarlierView BehindPicture::seen_from(const raster::RasterView& view, InstructionSet set) const {
  Image picture(width_, height_, 3, PixelType::f32, Transfer::linear);
  const std::span<float> values = picture.values<float>();
  for (std::size_t i = 0; i < planes_[0].size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) values[3 * i + k] = planes_[k][i];
  }
  return {view, image::make_mip_chain(picture, image::MipUse::colour, set)};
}

}  // namespace laterna::render
