#include "shadow/smooth_texels.h"

#include <algorithm>
#include <utility>

namespace laterna::shadow {
namespace {

// Weights of a texel's own row and of its neighbours': left, middle and right.
struct Weights {
  float middle[3], beside[3];
};
// As printed, the mean leaves the texel itself out. All are powers of two: sums of few passes are exact.
constexpr Weights kEightNeighbours = {{0.125F, 0, 0.125F}, {0.125F, 0.125F, 0.125F}};
constexpr Weights kBinomial = {{0.125F, 0.25F, 0.125F}, {0.0625F, 0.125F, 0.0625F}};

void smooth_once(const ArrivingLight& from, const Weights& w, std::vector<float>& to) {
  const auto width = static_cast<std::size_t>(from.width);
  const auto height = static_cast<std::size_t>(from.height);
  // With a lit rim around, so that no texel is a special case.
  const std::size_t stride = width + 2;
  std::vector<float> framed(stride * (height + 2), 1.0F);
  for (std::size_t y = 0; y < height; ++y) {
    std::copy_n(from.values.begin() + static_cast<std::ptrdiff_t>(y * width), width,
                framed.begin() + static_cast<std::ptrdiff_t>((y + 1) * stride + 1));
  }
  const auto weigh = [](const float* three, const float* weights) {
    return weights[0] * three[0] + (weights[1] * three[1] + weights[2] * three[2]);
  };
  for (std::size_t y = 0; y < height; ++y) {
    const float* above = framed.data() + y * stride;
    const float* here = above + stride;
    const float* below = here + stride;
    for (std::size_t x = 0; x < width; ++x) {
      to[y * width + x] =
          weigh(above + x, w.beside) + (weigh(here + x, w.middle) + weigh(below + x, w.beside));
    }
  }
}

}  // namespace

void smooth(ArrivingLight& picture, int passes, SmoothKernel kernel) {
  const Weights& weights = kernel == SmoothKernel::binomial ? kBinomial : kEightNeighbours;
  std::vector<float> next(picture.values.size());
  for (int i = 0; i < passes; ++i) {
    smooth_once(picture, weights, next);
    std::swap(picture.values, next);
  }
}

}  // namespace laterna::shadow
