// The stages of a picture one by one, on one thread and each instruction set: set-up, tile raster, texture look-up,
// arriving and reflected light.
#include <benchmark/benchmark.h>

#include <memory>

#include "raster/tile_raster.h"
#include "reference/projector_scenes.h"
#include "reference/shapes.h"
#include "shade/illumination.h"
#include "shade/surface_points.h"

namespace laterna {
namespace {

constexpr int kSide = 1024;

// A torus of about 6 pixels per triangle, or a floor whose two triangles fill the picture.
Scene torus_scene() {
  Scene scene;
  reference::add_object(scene, "torus", reference::torus({0, 0, 0}, 1, 0.5F, 512));
  return scene;
}
Scene floor_scene() {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(100));
  scene.materials[0].base_color_texture.picture = reference::add_picture(
      scene, 512, 512, [](int x, int y) { return glm::u8vec3(x & 255, y & 255, (x ^ y) & 255); });
  return scene;
}
View torus_view() { return reference::look({0, 3.2, 1.6}, {0, 0, 0}, 50, 1); }
View floor_view() { return reference::look({0, 2, 0}, {0, 0, -3}, 50, 1); }

class Drawing {
 public:
  Drawing(Scene scene, const View& view, InstructionSet set)
      : owned_(reference::make_frame(std::move(scene))), view_(view, kSide, kSide), set_(set) {
    options_.pixels = {0, 0, kSide, kSide};
    options_.instruction_set = set;
    bins_.fill(view_, owned_.frame.geometry(), options_, pool_);
  }

  void set_up() { bins_.fill(view_, owned_.frame.geometry(), options_, pool_); }
  void draw_depth() {
    const raster::RasteriseDepth kernel = raster::rasterise_depth_for(set_);
    for_each_tile([&](const raster::TileTask& task) { kernel(task, depth_); });
  }
  void draw_visibility() {
    const raster::RasteriseVisibility kernel = raster::rasterise_visibility_for(set_);
    for_each_tile([&](const raster::TileTask& task) { kernel(task, depth_, ids_); });
  }

  // 256 samples of the picture's middle.
  void take_samples(shadow::SurfaceSamples& samples) {
    const raster::TileTask task = {&view_, bins_.batches(), 8, 8, 0, 0, nullptr};
    std::fill_n(depth_, raster::kTilePixels, view_.reversed_far);
    raster::rasterise_visibility_for(set_)(task, depth_, ids_);
    samples.ray = view_.homogeneous_ray();
    samples.group_count = shadow::kMaxGroups;
    for (std::size_t i = 0; i < shadow::kMaxSamples; ++i) {
      const int x = static_cast<int>(i % 4 + (i / shadow::kGroupSize) * 4);
      const int y = static_cast<int>(i % shadow::kGroupSize / 4);
      const auto from = static_cast<std::size_t>(raster::index_in_tile(x, y));
      samples.x[i] = static_cast<float>(8 * raster::kTileSide + x - view_.origin_x) + 0.5F;
      samples.y[i] = static_cast<float>(8 * raster::kTileSide + y - view_.origin_y) + 0.5F;
      samples.q[i] = depth_[from];
      samples.id[i] = ids_[from];
    }
    samples.active.fill(0xFFFF);
  }

  [[nodiscard]] std::size_t triangles_binned() const { return bins_.statistics().triangles_binned; }
  [[nodiscard]] const frame::Frame& frame() const { return owned_.frame; }
  [[nodiscard]] const raster::RasterView& view() const { return view_; }

 private:
  template <class Draw>
  void for_each_tile(Draw draw) {
    for (int y = 0; y < kSide / raster::kTileSide; ++y) {
      for (int x = 0; x < kSide / raster::kTileSide; ++x) {
        std::fill_n(depth_, raster::kTilePixels, view_.reversed_far);
        std::fill_n(ids_, raster::kTilePixels, kNoTriangle);
        draw(raster::TileTask{&view_, bins_.batches(), x, y, 0, 0, nullptr});
        benchmark::DoNotOptimize(depth_);
      }
    }
  }

  TaskPool pool_{1};
  reference::OwnedFrame owned_;
  raster::RasterView view_;
  InstructionSet set_;
  raster::BinOptions options_;
  raster::TriangleBins bins_;
  alignas(64) float depth_[raster::kTilePixels] = {};
  alignas(64) TriangleId ids_[raster::kTilePixels] = {};
};

// Millions per second.
benchmark::Counter rate(double per_iteration, const benchmark::State& state) {
  return {per_iteration * static_cast<double>(state.iterations()) / 1e6, benchmark::Counter::kIsRate};
}

void set_up(benchmark::State& state, InstructionSet set) {
  Drawing drawing(torus_scene(), torus_view(), set);
  for (auto _ : state) drawing.set_up();
  state.counters["Mtri/s"] = rate(static_cast<double>(drawing.frame().triangle_count()), state);
}

void small_triangles(benchmark::State& state, InstructionSet set) {
  Drawing drawing(torus_scene(), torus_view(), set);
  for (auto _ : state) drawing.draw_depth();
  state.counters["Mtri/s"] = rate(static_cast<double>(drawing.triangles_binned()), state);
}

void large_triangles(benchmark::State& state, InstructionSet set) {
  Drawing drawing(floor_scene(), floor_view(), set);
  for (auto _ : state) drawing.draw_visibility();
  state.counters["Mpix/s"] = rate(double{kSide} * kSide, state);
}

// What shading kernels read, for one full batch of samples of the floor.
struct ShadingBatch {
  ShadingBatch(Scene scene, InstructionSet set, int anisotropy)
      : drawing(std::move(scene), floor_view(), set) {
    drawing.take_samples(*samples);
    source = {&drawing.frame(), &drawing.view(), Interpolation::perspective, anisotropy};
    shade::find_surface_points_for(set)(source, surface(), *samples, *points);
  }
  [[nodiscard]] const frame::Surface& surface() const { return drawing.frame().surfaces[0]; }

  Drawing drawing;
  shade::PointSource source;
  std::unique_ptr<shadow::SurfaceSamples> samples = std::make_unique<shadow::SurfaceSamples>();
  std::unique_ptr<shade::SurfacePoints> points = std::make_unique<shade::SurfacePoints>();
  std::unique_ptr<shade::Irradiance> irradiance = std::make_unique<shade::Irradiance>();
};

void texture_look_up(benchmark::State& state, InstructionSet set, int anisotropy) {
  ShadingBatch batch(floor_scene(), set, anisotropy);
  const shade::FindSurfacePoints kernel = shade::find_surface_points_for(set);
  for (auto _ : state) kernel(batch.source, batch.surface(), *batch.samples, *batch.points);
  state.counters["Mpix/s"] = rate(shadow::kMaxSamples, state);
}

void arriving_light(benchmark::State& state, InstructionSet set, LightType type) {
  Scene scene = floor_scene();
  Light light = reference::projector("light", 0.5, 0.5, type == LightType::projector ? 0 : -1);
  light.type = type;
  reference::add_light(scene, light, {0.5, 4, 1}, {0, 0, -3});
  ShadingBatch batch(std::move(scene), set, 1);
  const shade::BoundLight bound(batch.drawing.frame().lights[0], batch.samples->ray, ShadingModel::pbr, 1);
  const shade::FindIrradiance kernel = shade::find_irradiance_for(set);
  for (auto _ : state) kernel(bound, *batch.samples, *batch.points, nullptr, *batch.irradiance);
  if (batch.irradiance->lit[0] == 0) state.SkipWithError("the light misses the samples");
  state.counters["Mpix/s"] = rate(shadow::kMaxSamples, state);
}

void reflected_light(benchmark::State& state, InstructionSet set, ShadingModel model) {
  Scene scene = floor_scene();
  Light light = reference::projector("light", 0.5, 0.5);
  light.type = LightType::point;
  reference::add_light(scene, light, {0.5, 4, 1}, {0, 0, -3});
  ShadingBatch batch(std::move(scene), set, 1);
  const shade::BoundLight bound(batch.drawing.frame().lights[0], batch.samples->ray, model, 1);
  shade::find_irradiance_for(set)(bound, *batch.samples, *batch.points, nullptr, *batch.irradiance);
  const auto alpha = std::make_unique<shadow::SampleArray<float>>();
  alpha->fill(1);
  const auto radiance = std::make_unique<shade::Radiance>();
  shade::ReflectionSettings settings;
  settings.model = model;
  const shade::Reflect kernel = shade::reflect_for(set);
  for (auto _ : state) {
    kernel(settings, shadow::kMaxGroups, *batch.points, *batch.irradiance, alpha->data(), false, *radiance);
  }
  state.counters["Mpix/s"] = rate(shadow::kMaxSamples, state);
}

const bool kRegistered = [] {
  for (const InstructionSet set : supported_instruction_sets()) {
    const std::string on = "/" + std::string(name_of(set));
    const auto add = [&](const std::string& name, auto run) {
      benchmark::RegisterBenchmark((name + on).c_str(), run)->Unit(benchmark::kMicrosecond);
    };
    add("triangle set-up", [set](auto& s) { set_up(s, set); });
    add("tile raster, small triangles", [set](auto& s) { small_triangles(s, set); });
    add("tile raster, large triangles", [set](auto& s) { large_triangles(s, set); });
    add("texture look-up, trilinear", [set](auto& s) { texture_look_up(s, set, 1); });
    add("texture look-up, anisotropic 8", [set](auto& s) { texture_look_up(s, set, 8); });
    add("arriving light, point", [set](auto& s) { arriving_light(s, set, LightType::point); });
    add("arriving light, slide", [set](auto& s) { arriving_light(s, set, LightType::projector); });
    add("reflected light, phong", [set](auto& s) { reflected_light(s, set, ShadingModel::phong); });
    add("reflected light, pbr", [set](auto& s) { reflected_light(s, set, ShadingModel::pbr); });
  }
  return true;
}();

}  // namespace
}  // namespace laterna
