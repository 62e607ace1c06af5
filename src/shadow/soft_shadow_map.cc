#include "shadow/soft_shadow_map.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"

namespace laterna::shadow {
namespace {

void copy(const glm::dvec3& from, float* to) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

constexpr int kInnerTaps = TapPattern::kSearchTaps - TapPattern::kRimTaps;

// Vogel's spiral: each point a golden angle further than the one before; with radii √k they share out the disc's area
// evenly.
TapPattern make_disc_pattern() {
  const double golden_angle = kPi * (3 - std::sqrt(5.0));
  TapPattern pattern{};
  for (int k = 0; k < TapPattern::kSearchTaps; ++k) {
    const double radius = std::min(k / static_cast<double>(kInnerTaps), 1.0);
    pattern.search_size[k] = static_cast<float>(radius);
    const double angle =
        k < kInnerTaps ? k * golden_angle : (k - kInnerTaps) * 2 * kPi / TapPattern::kRimTaps;
    pattern.search_x[k] = static_cast<float>(radius * cosine(angle));
    pattern.search_y[k] = static_cast<float>(radius * sine(angle));
  }
  for (int k = 0; k < TapPattern::kFilterTaps; ++k) {
    const double radius = std::sqrt((k + 0.5) / TapPattern::kFilterTaps);
    pattern.filter_size[k] = static_cast<float>(radius);
    pattern.filter_x[k] = static_cast<float>(radius * cosine(k * golden_angle));
    pattern.filter_y[k] = static_cast<float>(radius * sine(k * golden_angle));
  }
  return pattern;
}

// Rim taps share out the square's four sides, which are 2 long.
glm::dvec2 on_square_rim(int k) {
  const double along = 8.0 * k / TapPattern::kRimTaps;
  const int side = static_cast<int>(along / 2);
  const double past_middle = along - 2 * side - 1;
  constexpr int kNormalX[] = {0, 1, 0, -1}, kNormalY[] = {-1, 0, 1, 0};
  return {kNormalX[side] - kNormalY[side] * past_middle, kNormalY[side] + kNormalX[side] * past_middle};
}

// Steps of the plastic number share out the square evenly (Roberts 2018).
TapPattern make_square_pattern() {
  constexpr double kPlastic = 1.32471795724474602596;
  const auto place = [](int k, double step) {
    const double turns = 0.5 + step * (k + 1);
    return 2 * (turns - std::floor(turns)) - 1;
  };
  TapPattern pattern{};
  for (int k = 0; k < TapPattern::kSearchTaps; ++k) {
    // The first in the middle, the last about the rim.
    double x = k == 0 ? 0 : place(k, 1 / kPlastic);
    double y = k == 0 ? 0 : place(k, 1 / (kPlastic * kPlastic));
    double size = std::max(std::abs(x), std::abs(y));
    x *= size;
    y *= size;
    size *= size;
    if (k >= kInnerTaps) {
      const glm::dvec2 rim = on_square_rim(k - kInnerTaps);
      x = rim.x;
      y = rim.y;
      size = 1;
    }
    pattern.search_x[k] = static_cast<float>(x);
    pattern.search_y[k] = static_cast<float>(y);
    pattern.search_size[k] = static_cast<float>(size);
  }
  for (int k = 0; k < TapPattern::kFilterTaps; ++k) {
    const double x = place(k, 1 / kPlastic);
    const double y = place(k, 1 / (kPlastic * kPlastic));
    pattern.filter_x[k] = static_cast<float>(x);
    pattern.filter_y[k] = static_cast<float>(y);
    pattern.filter_size[k] = static_cast<float>(std::max(std::abs(x), std::abs(y)));
  }
  return pattern;
}

}  // namespace

const TapPattern& disc_pattern() {
  static const TapPattern kPattern = make_disc_pattern();
  return kPattern;
}

const TapPattern& square_pattern() {
  static const TapPattern kPattern = make_square_pattern();
  return kPattern;
}

SoftShadowMap::SoftShadowMap(const light::PlannedLight& planned,
                             std::span<const std::shared_ptr<DepthMap>> maps,
                             std::shared_ptr<const NearestPyramids> nearest, const frame::Frame& frame,
                             const frame::TriangleNeighbours* neighbours, const raster::RasterView::Ray& ray,
                             int samples_per_pixel, InstructionSet set)
    : maps_(maps.begin(), maps.end()), nearest_(std::move(nearest)) {
  test_.hard = make_shadow_map_test(planned, maps, frame, neighbours, ray, samples_per_pixel, set);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const raster::RasterView& view = maps[i]->view();
    SoftDepthMap& soft = test_.maps.emplace_back();
    soft.nearest = &nearest_->of_map[i];
    copy(view.x_row, soft.x_row_ws);
    copy(view.y_row, soft.y_row_ws);
    // Parallel light has the same place in every texel.
    if (!view.is_orthographic) copy(view.w_row, soft.w_row_ws);
    soft.origin_x = static_cast<float>(view.origin_x);
    soft.origin_y = static_cast<float>(view.origin_y);
  }
  const LightSource& source = planned.placed->light->source;
  const Pose& pose = planned.placed->pose;
  test_.pattern = &disc_pattern();
  if (source.radius > 0) {
    test_.shape = LightShape::ball;
    test_.radius = static_cast<float>(source.radius);
    return;
  }
  test_.shape = LightShape::plane;
  const double lens = planned.placed->light->aperture.radius;
  glm::dvec2 half(lens > 0 ? lens : tangent(0.5 * source.angular_diameter.in_radians()));
  if (source.width > 0 || source.height > 0) {
    test_.pattern = &square_pattern();
    half = {0.5 * source.width, 0.5 * source.height};
  }
  copy(pose.right_ws() * half.x, test_.half_x_ws);
  copy(pose.up_ws() * half.y, test_.half_y_ws);
}

double SoftShadowMap::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                   Arrival& arrival) const {
  arrival.is_tinted = false;
  look_up_soft_shadow_map_for(test_.hard.instruction_set)(test_, samples, wanted, arrival.alpha.data());
  return 0;
}

std::size_t SoftShadowMap::memory_bytes() const { return nearest_->memory_bytes(); }

}  // namespace laterna::shadow
