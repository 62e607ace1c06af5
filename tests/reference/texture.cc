#include "reference/texture.h"

#include <algorithm>
#include <cmath>

namespace laterna::reference {
namespace {

// How near to a decision double and single precision may disagree.
constexpr double kDoubt = 1e-4;

bool is_near_whole(double value) { return std::abs(value - std::round(value)) < kDoubt; }

// Table 8.22: the texel that index i of a picture n wide stands for.
int wrapped(int i, int n, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(i, 0, n - 1);
  if (wrap == Wrap::repeat) return (i % n + n) % n;
  const int k = (i % (2 * n) + 2 * n) % (2 * n);
  return k < n ? k : 2 * n - 1 - k;
}

class Sampling {
 public:
  Sampling(const image::MipChain& chain, const Sampler& sampler) : chain_(chain), sampler_(sampler) {}

  void add(double u, double v, double lambda, double weight) {
    const bool is_minified = lambda > 0;
    is_ambiguous |= std::abs(lambda) < kDoubt && sampler_.minify != sampler_.magnify;
    const Filter filter = is_minified ? sampler_.minify : sampler_.magnify;
    const double last = chain_.level_count - 1;
    if (!is_minified || sampler_.mip == MipFilter::none) return add_level(u, v, 0, filter, weight);
    const double held = std::min(lambda, last);
    if (sampler_.mip == MipFilter::nearest) {
      is_ambiguous |= is_near_whole(lambda + 0.5) && lambda < last;
      return add_level(u, v, static_cast<int>(std::min(std::floor(held + 0.5), last)), filter, weight);
    }
    const int finer = static_cast<int>(std::floor(held));
    const int coarser = std::min(finer + 1, chain_.level_count - 1);
    add_level(u, v, finer, filter, weight * (1 - (held - finer)));
    add_level(u, v, coarser, filter, weight * (held - finer));
  }

  std::array<double, 4> sum = {};
  bool is_ambiguous = false;

 private:
  void add_level(double u, double v, int level, Filter filter, double weight) {
    if (weight == 0) return;
    const image::MipLevel& size = chain_.levels[static_cast<std::size_t>(level)];
    const double x = u * size.width;
    const double y = v * size.height;
    if (filter == Filter::nearest) {
      is_ambiguous |= is_near_whole(x) || is_near_whole(y);
      return add_texel(level, static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)), weight);
    }
    const int i = static_cast<int>(std::floor(x - 0.5));
    const int j = static_cast<int>(std::floor(y - 0.5));
    const double a = x - 0.5 - i;
    const double b = y - 0.5 - j;
    add_texel(level, i, j, weight * (1 - a) * (1 - b));
    add_texel(level, i + 1, j, weight * a * (1 - b));
    add_texel(level, i, j + 1, weight * (1 - a) * b);
    add_texel(level, i + 1, j + 1, weight * a * b);
  }

  void add_texel(int level, int i, int j, double weight) {
    const image::MipLevel& size = chain_.levels[static_cast<std::size_t>(level)];
    const std::array<float, 4> rgba = image::texel(chain_, level, wrapped(i, size.width, sampler_.wrap_u),
                                                   wrapped(j, size.height, sampler_.wrap_v));
    for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * rgba[c];
  }

  const image::MipChain& chain_;
  const Sampler& sampler_;
};

}  // namespace

TextureSample look_up(const image::MipChain& chain, const Sampler& sampler, int anisotropy,
                      const TextureProbe& p) {
  Sampling sampling(chain, sampler);
  const double along_x = std::hypot(p.du_dx * chain.width(), p.dv_dx * chain.height());
  const double along_y = std::hypot(p.du_dy * chain.width(), p.dv_dy * chain.height());
  const double longest = std::max(along_x, along_y);
  if (anisotropy <= 1 || sampler.mip == MipFilter::none) {
    sampling.add(p.u, p.v, std::log2(std::max(longest, 1e-10)), 1);
    return {sampling.sum, sampling.is_ambiguous};
  }
  // EXT_texture_filter_anisotropic; pictures that are magnified even along the longer side need no probes.
  const double ratio = longest / std::max(std::min(along_x, along_y), 1e-10);
  const double wanted = std::min({ratio, std::max(longest, 1.0), static_cast<double>(anisotropy)});
  const int probes = std::max(static_cast<int>(std::ceil(wanted - 1e-4)), 1);
  sampling.is_ambiguous |=
      wanted < anisotropy && std::abs(wanted - 1e-4 - std::round(wanted)) < 5e-4 && wanted > 1.001;
  sampling.is_ambiguous |= std::abs(along_x - along_y) < kDoubt * longest && probes > 1;
  const double lambda = std::log2(std::max(longest / probes, 1e-10));
  const double du = along_x > along_y ? p.du_dx : p.du_dy;
  const double dv = along_x > along_y ? p.dv_dx : p.dv_dy;
  for (int i = 1; i <= probes; ++i) {
    const double t = i / (probes + 1.0) - 0.5;
    sampling.add(p.u + t * du, p.v + t * dv, lambda, 1.0 / probes);
  }
  return {sampling.sum, sampling.is_ambiguous};
}

}  // namespace laterna::reference
