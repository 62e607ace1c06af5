#include "bake/luxel_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "image/mip_chain.h"

namespace laterna::bake {
namespace {

constexpr float kPi32 = 3.14159265F;

// A receiver's triangle: vertices of its streams, and the weights of its corners.
class Corners {
 public:
  Corners(const frame::Frame& frame, const Receiver& receiver)
      : frame_(frame),
        id_(receiver.id),
        weights_{1 - receiver.weight_b - receiver.weight_c, receiver.weight_b, receiver.weight_c} {}

  // The value of a stream that begins at `first`.
  [[nodiscard]] float interpolate(const AlignedVector<float>& values, std::uint32_t first) const {
    float sum = 0;
    for (unsigned k = 0; k < 3; ++k) sum += weights_[k] * values[vertex(first, k)];
    return sum;
  }
  [[nodiscard]] glm::dvec2 uv(const frame::TextureBinding& binding, std::uint32_t first,
                              unsigned corner) const {
    const auto set = static_cast<std::size_t>(binding.uv_set);
    const std::size_t v = vertex(first, corner);
    return {frame_.uv_u[set][v], frame_.uv_v[set][v]};
  }
  [[nodiscard]] std::uint32_t stream(const frame::TextureBinding& binding) const {
    return frame_.streams[cluster_of(id_)].uv[binding.uv_set];
  }

  // Linear r, g, b, alpha of a picture.
  [[nodiscard]] glm::vec4 look_up(const frame::TextureBinding& binding, double luxel_side) const {
    const std::uint32_t first = stream(binding);
    glm::dvec2 mesh_uv(0);
    if (first != frame::kNoStream) {
      for (unsigned k = 0; k < 3; ++k) mesh_uv += double{weights_[k]} * uv(binding, first, k);
    }
    const auto& m = binding.uv_from_mesh_uv;
    const glm::dvec2 at(m[0] * mesh_uv.x + m[1] * mesh_uv.y + m[2],
                        m[3] * mesh_uv.x + m[4] * mesh_uv.y + m[5]);
    const image::MipChain& chain = *binding.chain;
    const int level = first == frame::kNoStream ? 0 : level_of(binding, first, luxel_side);
    const image::MipLevel& size = chain.levels[static_cast<std::size_t>(level)];
    const auto texel = image::texel(chain, level, place(at.x, size.width, binding.sampler.wrap_u),
                                    place(at.y, size.height, binding.sampler.wrap_v));
    return {texel[0], texel[1], texel[2], texel[3]};
  }

 private:
  [[nodiscard]] std::size_t vertex(std::uint32_t first, unsigned corner) const {
    return first + (frame_.corners[id_] >> (8 * corner) & 255U);
  }

  // Half the logarithm of how many texels of the full size a luxel holds.
  [[nodiscard]] int level_of(const frame::TextureBinding& binding, std::uint32_t first,
                             double luxel_side) const {
    const glm::dvec2 a = uv(binding, first, 0), u = uv(binding, first, 1) - a, v = uv(binding, first, 2) - a;
    const auto& m = binding.uv_from_mesh_uv;
    const double scale = std::abs(double{m[0]} * m[4] - double{m[1]} * m[3]);
    const glm::dvec3 p(frame_.corner_ws(id_, 0));
    const glm::dvec3 n =
        glm::cross(glm::dvec3(frame_.corner_ws(id_, 1)) - p, glm::dvec3(frame_.corner_ws(id_, 2)) - p);
    const double area = std::sqrt(glm::dot(n, n));
    const image::MipChain& chain = *binding.chain;
    double texels = std::abs(u.x * v.y - u.y * v.x) * scale * chain.width() * chain.height() / area *
                    luxel_side * luxel_side;
    int level = 0;
    for (; texels > 2 && level + 1 < chain.level_count; ++level) texels /= 4;
    return level;
  }

  static int place(double coordinate, int size, Wrap wrap) {
    if (!(std::abs(coordinate) < 1e9)) return 0;
    double c = wrap == Wrap::clamp ? coordinate : coordinate - std::floor(coordinate);
    if (wrap == Wrap::mirror) {
      const double twice = coordinate - 2 * std::floor(coordinate / 2);
      c = std::min(twice, 2 - twice);
    }
    return std::clamp(static_cast<int>(std::floor(c * size)), 0, size - 1);
  }

  const frame::Frame& frame_;
  TriangleId id_;
  float weights_[3];
};

}  // namespace

MattSurface surface_at(const frame::Frame& frame, const Receiver& receiver, double luxel_side) {
  const std::uint32_t cluster = cluster_of(receiver.id);
  const frame::Surface& surface = frame.surfaces[frame.clusters[cluster].material];
  const Corners corners(frame, receiver);
  glm::vec3 base(surface.base_color[0], surface.base_color[1], surface.base_color[2]);
  if (surface.base_color_texture.chain != nullptr)
    base *= glm::vec3(corners.look_up(surface.base_color_texture, luxel_side));
  if (const std::uint32_t first = frame.streams[cluster].color; first != frame::kNoStream)
    base *= glm::vec3(corners.interpolate(frame.color_r, first), corners.interpolate(frame.color_g, first),
                      corners.interpolate(frame.color_b, first));
  float metallic = surface.metallic;
  if (surface.metallic_roughness_texture.chain != nullptr)
    metallic *= corners.look_up(surface.metallic_roughness_texture, luxel_side).z;
  MattSurface matt;
  matt.reflectance = glm::clamp(base * (1 - metallic), 0.0F, 1.0F);
  matt.exitance = kPi32 * glm::vec3(surface.emissive[0], surface.emissive[1], surface.emissive[2]);
  if (surface.emissive_texture.chain != nullptr)
    matt.exitance *= glm::vec3(corners.look_up(surface.emissive_texture, luxel_side));
  return matt;
}

}  // namespace laterna::bake
