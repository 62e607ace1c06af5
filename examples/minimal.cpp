// The library on one screen: triangles and a slide of the caller's own, a projector that throws the slide on them, and
// a picture drawn into the caller's memory. Usage: minimal [OUT.png]
#include <cstdio>

#include "laterna/render.h"

using namespace laterna;

// A quadrilateral from one corner along two edges; its front is where edge_a × edge_b points.
static void add_wall(Scene& scene, glm::vec3 corner, glm::vec3 edge_a, glm::vec3 edge_b) {
  Primitive wall;
  wall.positions = {corner, corner + edge_a, corner + edge_a + edge_b, corner + edge_b};
  wall.indices = {0, 1, 2, 0, 2, 3};
  Node node;
  node.mesh = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back({"wall", {wall}});
  scene.nodes.push_back(node);
}

// A slide of 8 × 6 squares, from red to yellow on blue.
static Picture make_slide() {
  auto slide = std::make_shared<Image>(80, 60, 3, PixelType::u8, Transfer::srgb);
  for (int i = 0; i < 80 * 60; ++i) {
    const int x = i % 80, y = i / 80;
    const bool is_warm = (x / 10 + y / 10) % 2 == 0;
    std::uint8_t* rgb = slide->values<std::uint8_t>().data() + std::size_t{3} * static_cast<unsigned>(i);
    rgb[0] = is_warm ? 255 : 20;
    rgb[1] = is_warm ? static_cast<std::uint8_t>(x * 3) : 60;
    rgb[2] = is_warm ? 40 : 160;
  }
  Picture picture;
  picture.name = "slide";
  picture.pixels = slide;
  return picture;
}

int main(int argc, char** argv) {
  Scene scene;
  add_wall(scene, {-4, 0, -2}, {8, 0, 0}, {0, 4, 0});       // the screen
  add_wall(scene, {-4, 0, 4}, {8, 0, 0}, {0, 0, -6});       // the floor
  add_wall(scene, {-0.4F, 0, 0}, {0.8F, 0, 0}, {0, 1, 0});  // a board that stands in the way
  scene.ambient = glm::vec3(0.02F);
  scene.pictures.push_back(make_slide());

  Light projector;
  projector.name = "lantern";
  projector.type = LightType::projector;
  projector.projection =
      Projection::perspective(Angle::degrees(30), 1, 0.1, 100);  // the width follows the slide's
  projector.slide = 0;
  projector.intensity = 400;  // candela
  scene.lights.push_back(projector);
  Node lens;
  lens.light = 0;
  lens.parent_from_node = Pose::look_at({-1, 1.2, 5}, {0, 1.6, -2}, {0, 1, 0})->world_from_view();
  scene.nodes.push_back(lens);

  const Result<Renderer> renderer = Renderer::create(std::move(scene));
  if (!renderer) return std::fputs(to_string(renderer.error()).c_str(), stderr), 1;

  RenderSettings settings;
  settings.width = 640, settings.height = 360, settings.samples = 4;
  View camera;
  camera.pose = *Pose::look_at({2.5, 2.2, 7}, {0, 1.5, -2}, {0, 1, 0});
  camera.projection = Projection::perspective(Angle::degrees(40), 640.0 / 360, 0.1, 100);
  Image picture(640, 360, 3, PixelType::u8, Transfer::srgb);
  RenderTarget target;
  target.color8 = {picture.values<std::uint8_t>().data(), 3, std::size_t{640} * 3, 1};
  if (const auto done = renderer->render_into(camera, settings, target); !done) {
    return std::fputs(to_string(done.error()).c_str(), stderr), 1;
  }
  const Result<void> written = write_image(picture, argc > 1 ? argv[1] : "minimal.png");
  if (!written) return std::fputs(to_string(written.error()).c_str(), stderr), 1;
}
