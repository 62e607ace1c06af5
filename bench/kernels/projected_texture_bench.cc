// What projected light costs beside plain texturing (Segal et al. 1992, section 5: the same, about 10⁵ polygons a second
// per pass). Whole pictures of 1920 × 1080 with one texture look-up per sample: by the surface's own coordinates, or by
// equation 7 from a projector without shadows, in the papers' model.
#include <benchmark/benchmark.h>

#include "reference/projector_scenes.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;

enum class Surface { plain, textured, projected };

int add_checks(Scene& scene) {
  return reference::add_picture(scene, 512, 512, [](int x, int y) {
    return (x / 32 + y / 32) % 2 == 0 ? glm::u8vec3(220, 180, 90) : glm::u8vec3(30, 60, 110);
  });
}

// `primitive` seen from +Z, the picture on it as its texture or thrown from the camera's side.
Scene scene_of(Primitive primitive, Surface what) {
  Scene scene;
  reference::add_object(scene, "object", std::move(primitive));
  const int picture = add_checks(scene);
  scene.ambient_is_set = true;
  if (what == Surface::textured) scene.materials[0].base_color_texture.picture = picture;
  if (what != Surface::projected) scene.ambient = glm::vec3(1);
  if (what == Surface::projected) {
    Light light = reference::projector("slide", 1.2, 0.8, picture);
    light.shadow.technique = ShadowTechnique::none;
    reference::add_light(scene, light, {0.3, 0.2, 3}, {0, 0, 0});
  }
  return scene;
}

void draw(benchmark::State& state, Primitive primitive, Surface what, double yfov_deg) {
  const Renderer renderer = reference::make_renderer(scene_of(std::move(primitive), what));
  const View view = reference::look({0, 0, 3}, {0, 0, 0}, yfov_deg, double{kWidth} / kHeight);
  const RenderSettings settings = reference::papers_settings(kWidth, kHeight);
  std::vector<std::uint8_t> pixels(std::size_t{kWidth} * kHeight * 3);
  RenderTarget target;
  target.color8 = {pixels.data(), 3, std::size_t{kWidth} * 3, 1};
  RenderStatistics statistics;
  for (auto _ : state) statistics = renderer.render_into(view, settings, target).value();
  const auto pictures = static_cast<double>(state.iterations()) / 1e6;
  state.counters["Mpix/s"] = {pictures * kWidth * kHeight, benchmark::Counter::kIsRate};
  state.counters["Mtri/s"] = {pictures * static_cast<double>(statistics.triangles),
                              benchmark::Counter::kIsRate};
}

const bool kRegistered = [] {
  constexpr std::pair<const char*, Surface> kKinds[] = {
      {"plain", Surface::plain}, {"textured", Surface::textured}, {"projected", Surface::projected}};
  for (const auto& [name, what] : kKinds) {
    // Two triangles that fill the picture; two million of which about half face the eye.
    const auto wall = [what = what](auto& s) { draw(s, reference::wall(3, 2, 0), what, 30); };
    const auto mesh = [what = what](auto& s) { draw(s, reference::sphere({0, 0, 0}, 1, 1448), what, 40); };
    benchmark::RegisterBenchmark((std::string("picture of two triangles, ") + name).c_str(), wall)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
    benchmark::RegisterBenchmark((std::string("picture of 2 M triangles, ") + name).c_str(), mesh)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
  return true;
}();

}  // namespace
}  // namespace laterna
