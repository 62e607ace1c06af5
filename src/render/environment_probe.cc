#include "laterna/environment_probe.h"

#include <fmt/format.h>

#include "base/refuse.h"

namespace laterna {
namespace {

struct Face {
  glm::dvec3 forward, up;
};
// In OpenGL's order; the upper edge of each as its table 8.19 has it.
constexpr Face kFaces[6] = {{{1, 0, 0}, {0, 1, 0}},  {{-1, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {0, 0, -1}},
                            {{0, -1, 0}, {0, 0, 1}}, {{0, 0, 1}, {0, 1, 0}},  {{0, 0, -1}, {0, 1, 0}}};

}  // namespace

Result<LayeredImage> render_environment(const Renderer& renderer, const EnvironmentProbe& probe,
                                        const RenderSettings& settings, const Progress& progress) {
  const int size = probe.face_size;
  if (size < 1 || size > kMaxEnvironmentSize)
    return refuse(fmt::format("the faces' size must be from 1 to {}, got {}", kMaxEnvironmentSize, size));
  RenderSettings own = settings;
  own.width = own.height = size;
  own.layers.clear();
  const std::size_t width = 6 * static_cast<std::size_t>(size);
  LayeredImage cube;
  cube.width = 6 * size;
  cube.height = size;
  for (const char* name : {"R", "G", "B"})
    cube.channels.push_back({name, std::vector<float>(width * static_cast<std::size_t>(size))});
  const Projection projection =
      Projection::perspective(Angle::degrees(90), 1, probe.near, std::numeric_limits<double>::infinity());
  for (std::size_t face = 0; face < 6; ++face) {
    const auto pose =
        Pose::look_at(probe.position_ws, probe.position_ws + kFaces[face].forward, kFaces[face].up);
    if (!pose) return refuse("the probe's place is not finite");
    const auto part = [&](double done) {
      return !progress || progress((static_cast<double>(face) + done) / 6);
    };
    const Result<LayeredImage> seen = renderer.render({*pose, projection}, own, part);
    if (!seen) return tl::unexpected(seen.error());
    for (Channel& channel : cube.channels) {
      const std::vector<float>& from = seen->find(channel.name)->values;
      // A face is the view mirrored: it is seen from outside.
      for (std::size_t y = 0; y < static_cast<std::size_t>(size); ++y) {
        for (std::size_t x = 0; x < static_cast<std::size_t>(size); ++x) {
          channel.values[y * width + face * static_cast<std::size_t>(size) + x] =
              from[(y + 1) * static_cast<std::size_t>(size) - 1 - x];
        }
      }
    }
  }
  return cube;
}

}  // namespace laterna
