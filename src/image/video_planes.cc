#include "image/video_planes.h"

#include <cstddef>

namespace laterna::image {
namespace {

constexpr int kFractionBits = 32;
constexpr double kRedWeight = 0.2126, kBlueWeight = 0.0722, kGreenWeight = 1 - kRedWeight - kBlueWeight;

// What one code of R, G and B adds, in 2⁻³² steps of the result. Magnitudes are under 2³⁰: sums of 4 · 3 · 255 of them fit.
struct Weights {
  std::int64_t r, g, b;

  // `span` codes of the result are the whole range of 255.
  constexpr Weights(double red, double green, double blue, double span)
      : r(steps(red * span)), g(steps(green * span)), b(steps(blue * span)) {}

  static constexpr std::int64_t steps(double codes) {
    const double scaled = codes / 255 * 4294967296.0;
    return static_cast<std::int64_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
  }
};
constexpr Weights kLuma(kRedWeight, kGreenWeight, kBlueWeight, 219);
constexpr double kBlueSpan = 2 * (1 - kBlueWeight), kRedSpan = 2 * (1 - kRedWeight);
constexpr Weights kBlueDifference(-kRedWeight / kBlueSpan, -kGreenWeight / kBlueSpan,
                                  (1 - kBlueWeight) / kBlueSpan, 224);
constexpr Weights kRedDifference((1 - kRedWeight) / kRedSpan, -kGreenWeight / kRedSpan,
                                 -kBlueWeight / kRedSpan, 224);

// Sums of `1 << shift` pixels' codes.
struct Sum {
  std::int64_t r = 0, g = 0, b = 0;
};

std::uint8_t weigh(const Weights& weights, const Sum& sum, int shift, std::int64_t zero) {
  const std::int64_t value = weights.r * sum.r + weights.g * sum.g + weights.b * sum.b;
  const int bits = kFractionBits + shift;
  return static_cast<std::uint8_t>(zero + ((value + (std::int64_t{1} << (bits - 1))) >> bits));
}

}  // namespace

VideoPlanes::VideoPlanes(int width, int height) {
  const auto shape = [](Plane& plane, int columns, int rows) {
    plane = {columns, rows, {}};
    plane.values.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  };
  shape(y_, width, height);
  shape(cb_, width / 2, height / 2);
  shape(cr_, width / 2, height / 2);
}

void VideoPlanes::convert(const Image& frame) {
  const std::uint8_t* const pixels = frame.values<std::uint8_t>().data();
  const auto width = static_cast<std::size_t>(y_.width);
  std::size_t luma = 0;
  for (const std::uint8_t* at = pixels; luma < y_.values.size(); ++luma, at += 3)
    y_.values[luma] = weigh(kLuma, {at[0], at[1], at[2]}, 0, 16);
  std::size_t chroma = 0;
  for (std::size_t y = 0; y + 1 < static_cast<std::size_t>(y_.height); y += 2) {
    const std::uint8_t* upper = pixels + y * width * 3;
    const std::uint8_t* lower = upper + width * 3;
    for (int x = 0; x < cb_.width; ++x, ++chroma, upper += 6, lower += 6) {
      const Sum sum = {upper[0] + upper[3] + lower[0] + lower[3], upper[1] + upper[4] + lower[1] + lower[4],
                       upper[2] + upper[5] + lower[2] + lower[5]};
      cb_.values[chroma] = weigh(kBlueDifference, sum, 2, 128);
      cr_.values[chroma] = weigh(kRedDifference, sum, 2, 128);
    }
  }
}

}  // namespace laterna::image
