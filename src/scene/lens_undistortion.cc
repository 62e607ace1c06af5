#include "scene/lens_undistortion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>

namespace laterna {
namespace {

constexpr int kPointsPerSide = 64;
// The pinhole's own frame, so many times as wide to every side, is as much as is made of a picture.
constexpr double kWidest = 2;
// In which the largest radius is looked for, of the frame's own.
constexpr int kRadiusSteps = 4096;
constexpr double kFarthestRadius = 8;

// The radius up to which what is farther out is seen farther out.
double find_largest_radius(const CameraDistortion& d, double frame_radius) {
  double before = 0;
  const double most = kFarthestRadius * frame_radius;
  for (int i = 1; i <= kRadiusSteps; ++i) {
    const double r = most * i / kRadiusSteps;
    const double seen = r * radial_factor(d, r * r);
    if (!(seen > before)) return most * (i - 1) / kRadiusSteps;
    before = seen;
  }
  return most;
}

// Newton's method from the radial part's solution; nothing where it ends nowhere, or beyond the fold.
std::optional<glm::dvec2> pinhole_point(const CameraDistortion& d, const glm::dvec2& seen,
                                        double largest_radius) {
  const double radius = glm::length(seen);
  double low = 0, high = largest_radius;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (middle * radial_factor(d, middle * middle) < radius ? low : high) = middle;
  }
  glm::dvec2 point = radius > 0 ? seen * (low / radius) : seen;
  for (int i = 0; i < 50; ++i) {
    const glm::dvec2 miss = distorted(d, point) - seen;
    if (!(glm::length(miss) < 1e6)) return std::nullopt;
    if (glm::length(miss) < 1e-12) break;
    const double h = 1e-6;
    const glm::dvec2 dx =
        (distorted(d, point + glm::dvec2(h, 0)) - distorted(d, point - glm::dvec2(h, 0))) / (2 * h);
    const glm::dvec2 dy =
        (distorted(d, point + glm::dvec2(0, h)) - distorted(d, point - glm::dvec2(0, h))) / (2 * h);
    const double determinant = dx.x * dy.y - dy.x * dx.y;
    if (!(determinant > 1e-9)) return std::nullopt;  // folded over
    point -= glm::dvec2(dy.y * miss.x - dy.x * miss.y, dx.x * miss.y - dx.y * miss.x) / determinant;
  }
  const bool has_arrived = glm::length(distorted(d, point) - seen) < 1e-9;
  if (!has_arrived || glm::length(point) > largest_radius * (1 + 1e-9)) return std::nullopt;
  return point;
}

// Keys, Cubic convolution interpolation for digital image processing, 1981, with a = −1/2.
void cubic_weights(double t, double w[4]) {
  w[0] = t * (-0.5 + t * (1 - 0.5 * t));
  w[1] = 1 + t * t * (-2.5 + 1.5 * t);
  w[2] = t * (0.5 + t * (2 - 1.5 * t));
  w[3] = t * t * (-0.5 + 0.5 * t);
}

class Resampler {
 public:
  Resampler(const Image& from, Image& to) : from_(from), to_(to) {}

  // The value at a place in pixels, (0, 0) the corner of the top-left one.
  void write(int x, int y, glm::dvec2 at) {
    const int colors = from_.has_alpha() ? from_.channels() - 1 : from_.channels();
    const bool is_inside = at.x >= 0 && at.y >= 0 && at.x <= from_.width() && at.y <= from_.height();
    at.x = std::clamp(at.x, 0.5, from_.width() - 0.5);
    at.y = std::clamp(at.y, 0.5, from_.height() - 0.5);
    const double fx = std::floor(at.x - 0.5), fy = std::floor(at.y - 0.5);
    double across[4], down[4];
    cubic_weights(at.x - 0.5 - fx, across);
    cubic_weights(at.y - 0.5 - fy, down);
    const int first_x = static_cast<int>(fx) - 1, first_y = static_cast<int>(fy) - 1;
    for (int c = 0; c < colors; ++c) {
      double sum = 0;
      for (int j = 0; j < 4; ++j) {
        double row = 0;
        for (int i = 0; i < 4; ++i) row += across[i] * value(first_x + i, first_y + j, c);
        sum += down[j] * row;
      }
      store(x, y, c, sum);
    }
    double alpha = is_inside ? 1 : 0;
    if (from_.has_alpha() && is_inside) alpha = value(static_cast<int>(at.x), static_cast<int>(at.y), colors);
    store(x, y, colors, alpha);
  }

 private:
  [[nodiscard]] double value(int x, int y, int channel) const {
    return from_.value(std::clamp(x, 0, from_.width() - 1), std::clamp(y, 0, from_.height() - 1), channel);
  }

  void store(int x, int y, int channel, double value) {
    const std::size_t at =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(to_.width()) + static_cast<std::size_t>(x)) *
            static_cast<std::size_t>(to_.channels()) +
        static_cast<std::size_t>(channel);
    const auto code = [&](double largest) { return std::floor(std::clamp(value, 0.0, 1.0) * largest + 0.5); };
    switch (to_.type()) {
      case PixelType::u8:
        to_.values<std::uint8_t>()[at] = static_cast<std::uint8_t>(code(255));
        break;
      case PixelType::u16:
        to_.values<std::uint16_t>()[at] = static_cast<std::uint16_t>(code(65535));
        break;
      case PixelType::f32:
        to_.values<float>()[at] = static_cast<float>(std::max(value, 0.0));
        break;
    }
  }

  const Image& from_;
  Image& to_;
};

}  // namespace

PinholeFrame find_pinhole_frame(const Intrinsics& k, const CameraDistortion& distortion, std::string& fault) {
  const auto at = [&](double x, double y) { return glm::dvec2((x - k.cx) / k.fx, (y - k.cy) / k.fy); };
  const glm::dvec2 low = at(0, 0), high = at(k.width, k.height);
  const double frame_radius = std::max(glm::length(glm::max(glm::abs(low), glm::abs(high))), 1e-6);
  PinholeFrame frame;
  frame.largest_radius = find_largest_radius(distortion, frame_radius);
  frame.left = frame.top = std::numeric_limits<double>::infinity();
  frame.right = frame.bottom = -frame.left;
  for (int i = 0; i < 4 * kPointsPerSide; ++i) {
    const double along = static_cast<double>(i % kPointsPerSide) / kPointsPerSide;
    const glm::dvec2 sides[4] = {{along, 0}, {1, along}, {1 - along, 1}, {0, 1 - along}};
    const glm::dvec2 pixel = sides[i / kPointsPerSide] * glm::dvec2(k.width, k.height);
    const std::optional<glm::dvec2> point =
        pinhole_point(distortion, at(pixel.x, pixel.y), frame.largest_radius);
    if (!point) {
      fault = fmt::format(
          "the lens distortion cannot be inverted at pixel ({:.0f}, {:.0f}) of {:.0f}x{:.0f}: its formula "
          "folds the picture over",
          pixel.x, pixel.y, k.width, k.height);
      return frame;
    }
    frame.left = std::min(frame.left, point->x), frame.right = std::max(frame.right, point->x);
    frame.top = std::min(frame.top, point->y), frame.bottom = std::max(frame.bottom, point->y);
  }
  const glm::dvec2 middle = (low + high) / 2.0, half = (high - low) / 2.0 * kWidest;
  frame.left = std::max(frame.left, middle.x - half.x),
  frame.right = std::min(frame.right, middle.x + half.x);
  frame.top = std::max(frame.top, middle.y - half.y),
  frame.bottom = std::min(frame.bottom, middle.y + half.y);
  const auto pixels = [](double length) {
    return std::clamp(static_cast<int>(std::ceil(length)), 1, kMaxImageSide);
  };
  frame.width = pixels((frame.right - frame.left) * k.fx);
  frame.height = pixels((frame.bottom - frame.top) * k.fy);
  return frame;
}

Image undistort(const Image& picture, const Intrinsics& k, const CameraDistortion& distortion,
                const PinholeFrame& frame) {
  const int colors = picture.has_alpha() ? picture.channels() - 1 : picture.channels();
  Image pinhole(frame.width, frame.height, colors + 1, picture.type(), picture.transfer());
  Resampler resampler(picture, pinhole);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const glm::dvec2 point(frame.left + (frame.right - frame.left) * (x + 0.5) / frame.width,
                             frame.top + (frame.bottom - frame.top) * (y + 0.5) / frame.height);
      const bool is_folded = glm::length(point) > frame.largest_radius;
      const glm::dvec2 seen = distorted(distortion, point);
      resampler.write(x, y,
                      is_folded ? glm::dvec2(-1) : glm::dvec2(seen.x * k.fx + k.cx, seen.y * k.fy + k.cy));
    }
  }
  return pinhole;
}

}  // namespace laterna
