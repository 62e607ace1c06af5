// A program outside the project: a white wall under a projector's red light, rendered into an array.
#include <laterna/build_info.h>
#include <laterna/render.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

namespace {

using namespace laterna;

int fail(const char* message) {
  std::fprintf(stderr, "%s\n", message);
  return 1;
}

Scene wall_and_projector() {
  Scene scene;
  Primitive wall;
  wall.positions = {{-2, -2, -4}, {2, -2, -4}, {2, 2, -4}, {-2, 2, -4}};
  wall.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes.push_back({"wall", {wall}});
  Light light;
  light.name = "red";
  light.type = LightType::projector;
  light.color = {1, 0, 0};
  light.intensity = 16;  // candela: 1 lux on the wall, 4 m away
  light.projection =
      Projection::perspective(Angle::degrees(40), 1, 0.1, std::numeric_limits<double>::infinity());
  scene.lights.push_back(light);
  Node wall_node;
  wall_node.mesh = 0;
  Node light_node;
  light_node.light = 0;
  scene.nodes = {wall_node, light_node};
  return scene;
}

}  // namespace

int main() {
  if (version() != "0.1.0") return fail("version() is not that of the package");
  const Result<Renderer> renderer = Renderer::create(wall_and_projector());
  if (!renderer) return fail(to_string(renderer.error()).c_str());
  RenderSettings settings;
  settings.width = settings.height = 32;
  settings.shading = ShadingModel::papers;
  View camera;
  camera.projection = Projection::perspective(Angle::degrees(50), 1, 0.1, 100);
  std::vector<float> red(32 * 32), green(32 * 32);
  RenderTarget target;
  target.channels = {{"R", red.data(), 32}, {"G", green.data(), 32}};
  const Result<RenderStatistics> done = renderer->render_into(camera, settings, target);
  if (!done) return fail(to_string(done.error()).c_str());
  const std::size_t centre = 16 * 32 + 16;
  std::printf("centre %g %g, corner %g\n", red[centre], green[centre], red[0]);
  // `papers`: white · light colour in the frame, nothing outside it.
  if (red[centre] != 1 || green[centre] != 0) return fail("the middle of the wall is not red");
  if (red[0] != 0) return fail("the corner of the picture lies outside the slide and is not black");
  return 0;
}
