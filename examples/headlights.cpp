// A car drives at a wall, its low beams with it: what moves is set on a Renderer, and all else is kept from picture to
// picture. Usage: headlights SCENES FOLDER, with SCENES examples/scenes; writes drive.0.png … drive.3.png and says where the
// cut-off stands on the wall.
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "laterna/probes.h"
#include "laterna/render.h"

using namespace laterna;

template <class T>
static T need(Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "%s\n", to_string(result.error()).c_str());
  std::exit(static_cast<int>(result.error().failure));
}

int main(int argc, char** argv) {
  const std::filesystem::path scenes = argc > 1 ? argv[1] : "examples/scenes";
  const std::filesystem::path folder = argc > 2 ? argv[2] : ".";
  LoadOptions with_lamps;
  with_lamps.rigs = {scenes / "headlights.json"};
  Renderer renderer = need(Renderer::create(need(load_scene({scenes / "road.glb"}, with_lamps))));

  // The car and all that is fastened to it, as they stand 25 m before the wall.
  struct Part {
    int node;
    glm::dmat4 start;
  };
  std::vector<Part> parts;
  const std::vector<Node>& nodes = renderer.scene().nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].name == "car" || nodes[i].light >= 0)
      parts.push_back({static_cast<int>(i), nodes[i].parent_from_node});
  }

  RenderSettings settings;
  settings.width = 640, settings.height = 360, settings.samples = 4;
  const View camera = need(renderer.camera_view("bystander", settings.width, settings.height));
  WriteOptions exposed;
  exposed.exposure = exposure_from_stops(-3);
  for (int frame = 0; frame < 4; ++frame) {
    const double driven = 5.0 * frame;
    for (const Part& part : parts) {
      const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -driven)) * part.start;
      if (const auto done = renderer.set_transform(part.node, moved); !done)
        return std::fputs(to_string(done.error()).c_str(), stderr), 1;
    }
    const LayeredImage picture = need(renderer.render(camera, settings));
    LayeredImage opaque = picture;
    opaque.channels.resize(3);
    const auto file = folder / ("drive." + std::to_string(frame) + ".png");
    if (const auto written = write_image(opaque, file, exposed); !written)
      return std::fputs(to_string(written.error()).c_str(), stderr), 1;

    // 1 % of the distance below the lamps the light begins: meters above and below that line.
    const double distance = 25 - driven;
    const double edge = 0.65 - 0.01 * distance;
    const std::vector<Probe> meters = {{{-3, edge + 0.2, -25}, {0, 0, 1}, 0},
                                       {{-3, edge - 0.2, -25}, {0, 0, 1}, 0}};
    const ProbeReport read = need(renderer.measure_probes(meters, {}));
    std::printf("%4.0f m from the wall: %.2f lx above the cut-off, %.2f lx below it\n", distance,
                read.readings[0].lux, read.readings[1].lux);
  }
}
