#include "shadow/silhouette_texture.h"

#include <cmath>

namespace laterna::shadow {
namespace {

constexpr float kWhole = 32768;

float evaluate(const ProjectedRow& row, float x, float y, float q) {
  return (row.at_0 + row.at_x * x) + (row.at_y * y + row.at_q * q);
}

}  // namespace

SilhouetteTexture::SilhouetteTexture(const light::ShadowView& view, std::uint32_t object,
                                     const raster::RasterView::Ray& ray)
    : view_(view.view, view.width, view.height), object_(object), homogeneous_(homogeneous_row(ray)) {
  const PixelRows rows(view_);
  position_ = {ProjectedRow(rows.x, ray), ProjectedRow(rows.y, ray), ProjectedRow(rows.w, ray)};
}

bool SilhouetteTexture::require(const SilhouettePainter& painter, const ShadowSettings& settings) {
  bool was_here = false;
  std::call_once(once_, [&] {
    ArrivingLight picture{view_.width, view_.height, {}};
    picture.values.assign(static_cast<std::size_t>(view_.width) * static_cast<std::size_t>(view_.height), 1);
    painter.paint(object_, view_, picture);
    smooth(picture, settings.smooth, settings.smooth_kernel);
    texels_.resize(picture.values.size());
    for (std::size_t i = 0; i < texels_.size(); ++i)
      texels_[i] = static_cast<std::uint16_t>(picture.values[i] * kWhole + 0.5F);
    is_drawn_.store(true, std::memory_order_release);
    was_here = true;
  });
  return was_here;
}

SilhouetteTexture::Place SilhouetteTexture::place_of(float x, float y, float q) const {
  const float w = evaluate(position_.divisor, x, y, q);
  const float h = evaluate(homogeneous_, x, y, q);
  const bool is_ahead = view_.is_orthographic || w > h * 1e-6F;
  const float inverse = 1 / (view_.is_orthographic || !is_ahead ? h : w);
  return {evaluate(position_.x, x, y, q) * inverse + static_cast<float>(view_.origin_x),
          evaluate(position_.y, x, y, q) * inverse + static_cast<float>(view_.origin_y), is_ahead};
}

float SilhouetteTexture::texel(int x, int y) const {
  if (x < 0 || y < 0 || x >= view_.width || y >= view_.height) return 1;
  const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width);
  return static_cast<float>(texels_[i + static_cast<std::size_t>(x)]) * (1 / kWhole);
}

float SilhouetteTexture::nearest(const Place& place) const {
  // Comparisons are written so that NaN and what no int holds are beside.
  const bool is_inside = place.x >= 0 && place.y >= 0 && place.x < static_cast<float>(view_.width) &&
                         place.y < static_cast<float>(view_.height);
  return place.is_ahead && is_inside ? texel(static_cast<int>(place.x), static_cast<int>(place.y)) : 1;
}

float SilhouetteTexture::bilinear(const Place& place) const {
  const float x = place.x - 0.5F;
  const float y = place.y - 0.5F;
  const bool is_inside =
      x > -1 && y > -1 && x < static_cast<float>(view_.width) && y < static_cast<float>(view_.height);
  if (!place.is_ahead || !is_inside) return 1;
  const float left = std::floor(x);
  const float top = std::floor(y);
  const float right_share = x - left;
  const float lower_share = y - top;
  const int i = static_cast<int>(left);
  const int j = static_cast<int>(top);
  const auto mix = [](float a, float b, float share) { return a + (b - a) * share; };
  return mix(mix(texel(i, j), texel(i + 1, j), right_share),
             mix(texel(i, j + 1), texel(i + 1, j + 1), right_share), lower_share);
}

}  // namespace laterna::shadow
