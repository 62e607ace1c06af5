#include "frame/surface_alpha.h"

#include <algorithm>
#include <cmath>

namespace laterna::frame {
namespace {

struct Taps {
  int low, high;
  float weight;
};

Taps find_taps(float coordinate, int size, Wrap wrap) {
  float c = std::abs(coordinate) <= 8388608.0F ? coordinate : 0.0F;
  if (wrap == Wrap::repeat) c -= std::floor(c);
  if (wrap == Wrap::mirror) {
    c -= 2 * std::floor(c * 0.5F);
    c = std::min(c, 2 - c);
  }
  if (wrap == Wrap::clamp) c = std::clamp(c, 0.0F, 1.0F);
  const float position = c * static_cast<float>(size) - 0.5F;
  const float floor = std::floor(position);
  const int low = static_cast<int>(floor);
  const auto held = [&](int i) {
    return wrap == Wrap::repeat ? (i + size) % size : std::clamp(i, 0, size - 1);
  };
  return {held(low), held(low + 1), position - floor};
}

float texture_alpha(const TextureBinding& binding, float u, float v) {
  const image::MipChain& chain = *binding.chain;
  if (!chain.has_alpha()) return 1;
  Taps x = find_taps(u, chain.width(), binding.sampler.wrap_u);
  Taps y = find_taps(v, chain.height(), binding.sampler.wrap_v);
  if (binding.sampler.magnify == Filter::nearest) {
    x.weight = x.weight >= 0.5F ? 1.0F : 0.0F;
    y.weight = y.weight >= 0.5F ? 1.0F : 0.0F;
  }
  const auto at = [&](int i, int j) {
    const auto index =
        static_cast<std::size_t>(j) * static_cast<std::size_t>(chain.width()) + static_cast<std::size_t>(i);
    return static_cast<float>(chain.format == image::TexelFormat::data ? chain.texels[index] >> 24U
                                                                       : chain.alpha[index]);
  };
  const float above = at(x.low, y.low) + (at(x.high, y.low) - at(x.low, y.low)) * x.weight;
  const float below = at(x.low, y.high) + (at(x.high, y.high) - at(x.low, y.high)) * x.weight;
  return (above + (below - above) * y.weight) * (1.0F / 255.0F);
}

}  // namespace

float alpha_at(const Frame& frame, TriangleId id, float b, float c) {
  const std::uint32_t cluster = cluster_of(id);
  const Surface& surface = frame.surfaces[frame.clusters[cluster].material];
  const ClusterStreams& streams = frame.streams[cluster];
  const std::uint32_t packed = frame.corners[id];
  const auto interpolate = [&](const auto& values, std::uint32_t first) {
    const auto at_a = values[first + (packed & 255U)];
    return at_a + ((values[first + (packed >> 8U & 255U)] - at_a) * b +
                   (values[first + (packed >> 16U & 255U)] - at_a) * c);
  };
  const float factor = surface.base_color[3];
  const float vertex_alpha = streams.color == kNoStream ? 1 : interpolate(frame.colors, streams.color).a;
  const TextureBinding& binding = surface.base_color_texture;
  if (binding.chain == nullptr) return factor * vertex_alpha;
  const auto set = static_cast<std::size_t>(binding.uv_set);
  float u = 0;
  float v = 0;
  if (streams.uv[set] != kNoStream) {
    const glm::vec2 mesh_uv = interpolate(frame.uvs[set], streams.uv[set]);
    const std::array<float, 6>& m = binding.uv_from_mesh_uv;
    u = m[0] * mesh_uv.x + m[1] * mesh_uv.y + m[2];
    v = m[3] * mesh_uv.x + m[4] * mesh_uv.y + m[5];
  }
  return factor * texture_alpha(binding, u, v) * vertex_alpha;
}

bool is_hole(const Frame& frame, TriangleId id, float b, float c) {
  const Cluster& cluster = frame.clusters[cluster_of(id)];
  if ((cluster.flags & kAlphaMask) == 0) return false;
  return alpha_at(frame, id, b, c) < frame.surfaces[cluster.material].alpha_cutoff;
}

}  // namespace laterna::frame
