#include "render/photograph_feathers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace laterna::render {
namespace {

// Depth that changes between two texels by more than this share, unforeseen from either side, is a rim.
constexpr double kRim = 0.01;

constexpr double kFar = 1e20;

double reversed(const shadow::DepthMap& depth, int x, int y) {
  const float q = depth.reversed_depth(x, y);
  return q == shadow::kNothingSeen ? 0.0 : static_cast<double>(q);
}

// Whether something ends between the second and third of four neighbours. Reversed depth is linear along every plane: a
// plane goes on as it came, however steep.
bool is_rim(const double q[4]) {
  const double step = q[2] - q[1];
  const double most = kRim * std::max(std::abs(q[1]), std::abs(q[2]));
  return std::abs(step - (q[1] - q[0])) > most && std::abs(step - (q[3] - q[2])) > most && std::abs(step) > 0;
}

class Distances {
 public:
  Distances(int width, int height)
      : width_(width),
        height_(height),
        squared_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kFar) {}

  double& at(int x, int y) {
    return squared_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(x)];
  }

  // Squared distances to the nearest texel that is 0: Felzenszwalb and Huttenlocher, Distance transforms of sampled
  // functions, 2012.
  void spread() {
    std::vector<double> line;
    for (int y = 0; y < height_; ++y) {
      line.resize(static_cast<std::size_t>(width_));
      for (int x = 0; x < width_; ++x) line[static_cast<std::size_t>(x)] = at(x, y);
      spread_line(line);
      for (int x = 0; x < width_; ++x) at(x, y) = line[static_cast<std::size_t>(x)];
    }
    for (int x = 0; x < width_; ++x) {
      line.resize(static_cast<std::size_t>(height_));
      for (int y = 0; y < height_; ++y) line[static_cast<std::size_t>(y)] = at(x, y);
      spread_line(line);
      for (int y = 0; y < height_; ++y) at(x, y) = line[static_cast<std::size_t>(y)];
    }
  }

 private:
  // The lower envelope of the parabolas line[p] + (x − p)².
  void spread_line(std::vector<double>& line) {
    const std::size_t n = line.size();
    vertex_.assign(n, 0);
    begins_.assign(n + 1, 0);
    std::size_t last = 0;
    begins_[0] = -kFar;
    begins_[1] = kFar;
    for (std::size_t x = 1; x < n; ++x) {
      double cross = crossing(line, vertex_[last], x);
      while (last > 0 && cross <= begins_[last]) cross = crossing(line, vertex_[--last], x);
      if (cross <= begins_[last]) {  // only for last = 0
        vertex_[0] = x;
      } else {
        vertex_[++last] = x;
        begins_[last] = cross;
      }
      begins_[last + 1] = kFar;
    }
    result_.resize(n);
    std::size_t k = 0;
    for (std::size_t x = 0; x < n; ++x) {
      while (begins_[k + 1] < static_cast<double>(x)) ++k;
      const double away = static_cast<double>(x) - static_cast<double>(vertex_[k]);
      result_[x] = away * away + line[vertex_[k]];
    }
    line.swap(result_);
  }

  static double crossing(const std::vector<double>& line, std::size_t p, std::size_t q) {
    const auto x = static_cast<double>(p), y = static_cast<double>(q);
    return ((line[q] + y * y) - (line[p] + x * x)) / (2 * (y - x));
  }

  int width_, height_;
  std::vector<double> squared_;
  std::vector<std::size_t> vertex_;
  std::vector<double> begins_, result_;
};

void mark_rims(const shadow::DepthMap& depth, Distances& distances) {
  const int width = depth.width(), height = depth.height();
  const auto q = [&](int x, int y) {
    return reversed(depth, std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double across[4] = {q(x - 1, y), q(x, y), q(x + 1, y), q(x + 2, y)};
      const double down[4] = {q(x, y - 1), q(x, y), q(x, y + 1), q(x, y + 2)};
      if (x + 1 < width && is_rim(across)) distances.at(x, y) = distances.at(x + 1, y) = 0;
      if (y + 1 < height && is_rim(down)) distances.at(x, y) = distances.at(x, y + 1) = 0;
    }
  }
}

void mark_mask(const image::MipChain& picture, int width, int height, Distances& distances) {
  if (!picture.has_alpha()) return;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto across = static_cast<int>((x + 0.5) * picture.width() / width);
      const auto down = static_cast<int>((y + 0.5) * picture.height() / height);
      if (image::texel(picture, 0, across, down)[3] < 0.5F) distances.at(x, y) = 0;
    }
  }
}

}  // namespace

image::MipChain make_feather(const shadow::DepthMap& depth, const image::MipChain& picture, double width) {
  const int w = depth.width(), h = depth.height();
  Distances distances(w, h);
  mark_rims(depth, distances);
  mark_mask(picture, w, h, distances);
  distances.spread();
  const double texels = std::max(width * std::max(w, h), 1e-6);
  Image feather(w, h, 1, PixelType::f32, Transfer::linear);
  const std::span<float> values = feather.values<float>();
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const double to_side = std::min({x, w - 1 - x, y, h - 1 - y}) + 0.5;
      const double inside = std::min(std::min(std::sqrt(distances.at(x, y)), to_side) / texels, 1.0);
      values[static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x)] =
          static_cast<float>(inside * inside * (3 - 2 * inside));
    }
  }
  return image::make_mip_chain(feather, image::MipUse::data);
}

}  // namespace laterna::render
