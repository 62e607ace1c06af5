#include "drawing.h"

#include <algorithm>

#include "reference/projector_scenes.h"

namespace laterna {
namespace {

reference::OwnedFrame make_torus(int segments) {
  Scene scene;
  reference::add_object(scene, "torus", reference::torus({0, 0, 0}, 1, 0.5F, segments));
  return reference::make_frame(std::move(scene));
}

int add_pattern(Scene& scene) {
  return reference::add_picture(scene, 512, 512,
                                [](int x, int y) { return glm::u8vec3(x & 255, y & 255, (x ^ y) & 255); });
}

void add_floor_light(Scene& scene, LightType type, int slide) {
  Light light = reference::projector(type == LightType::point ? "point" : "slide", 0.8, 0.8, slide);
  light.type = type;
  light.intensity = 20;
  light.shadow.resolution = 1024;
  reference::add_light(scene, light, {0.5, 4, 1}, {0, 0, -3});
}

reference::OwnedFrame make_lit_floor() {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(100));
  const int pattern = add_pattern(scene);
  scene.materials[0].base_color_texture.picture = pattern;
  reference::add_object(scene, "ball", reference::sphere({0.2F, 0.5F, -2.2F}, 0.5F, 64));
  add_floor_light(scene, LightType::point, -1);
  add_floor_light(scene, LightType::projector, pattern);
  return reference::make_frame(std::move(scene));
}

reference::OwnedFrame make_floor() {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(100));
  return reference::make_frame(std::move(scene));
}

}  // namespace

const frame::Frame& small_triangles() {
  static const reference::OwnedFrame owned = make_torus(256);
  return owned.frame;
}
const frame::Frame& wide_triangles() {
  static const reference::OwnedFrame owned = make_torus(60);
  return owned.frame;
}
const frame::Frame& floor_triangles() {
  static const reference::OwnedFrame owned = make_floor();
  return owned.frame;
}
const frame::Frame& lit_floor() {
  static const reference::OwnedFrame owned = make_lit_floor();
  return owned.frame;
}
View torus_view() { return reference::look({0, 3.2, 1.6}, {0, 0, 0}, 50, 1); }
View floor_view() { return reference::look({0, 2, 0}, {0, 0, -3}, 50, 1); }

Drawing::Drawing(const frame::Frame& frame, const View& view, InstructionSet set)
    : frame_(frame), view_(view, kDrawingSide, kDrawingSide), set_(set) {
  options_.pixels = {0, 0, kDrawingSide, kDrawingSide};
  options_.instruction_set = set;
  sort_into_tiles();
}

void Drawing::sort_into_tiles() { bins_.fill(view_, frame_.geometry(), options_, pool_); }

template <class Draw>
void Drawing::for_each_tile(Draw draw) {
  constexpr int kTiles = kDrawingSide / raster::kTileSide;
  for (int tile = 0; tile < kTiles * kTiles; ++tile) {
    std::fill_n(depth_, raster::kTilePixels, view_.reversed_far);
    std::fill_n(ids_, raster::kTilePixels, kNoTriangle);
    draw(raster::TileTask{&view_, bins_.batches(), tile % kTiles, tile / kTiles, 0, 0, nullptr});
  }
}

void Drawing::draw_depth() {
  const raster::RasteriseDepth kernel = raster::rasterise_depth_for(set_);
  for_each_tile([&](const raster::TileTask& task) { kernel(task, depth_); });
}

void Drawing::draw_visibility() {
  const raster::RasteriseVisibility kernel = raster::rasterise_visibility_for(set_);
  for_each_tile([&](const raster::TileTask& task) { kernel(task, depth_, ids_); });
}

std::size_t Drawing::count_covered() {
  const raster::RasteriseVisibility kernel = raster::rasterise_visibility_for(set_);
  std::size_t covered = 0;
  for_each_tile([&](const raster::TileTask& task) {
    kernel(task, depth_, ids_);
    covered += static_cast<std::size_t>(
        std::count_if(ids_, ids_ + raster::kTilePixels, [](TriangleId id) { return id != kNoTriangle; }));
  });
  return covered;
}

void Drawing::take_samples(int x, int y, shadow::SurfaceSamples& samples) {
  const raster::TileTask task = {&view_, bins_.batches(), x / raster::kTileSide, y / raster::kTileSide, 0,
                                 0,      nullptr};
  std::fill_n(depth_, raster::kTilePixels, view_.reversed_far);
  raster::rasterise_visibility_for(set_)(task, depth_, ids_);
  samples.ray = view_.homogeneous_ray();
  samples.group_count = shadow::kMaxGroups;
  samples.active.fill(0xFFFF);
  for (int i = 0; i < static_cast<int>(shadow::kMaxSamples); ++i) {
    // Four rows of four blocks of 4 × 4 pixels.
    const int block = i / raster::kBlockPixels;
    const int pixel_x = x + block % 4 * raster::kBlockSide + i % raster::kBlockSide;
    const int pixel_y = y + block / 4 * raster::kBlockSide + i / raster::kBlockSide % raster::kBlockSide;
    const auto from = static_cast<std::size_t>(
        raster::index_in_tile(pixel_x % raster::kTileSide, pixel_y % raster::kTileSide));
    const auto to = static_cast<std::size_t>(i);
    samples.x[to] = static_cast<float>(pixel_x - view_.origin_x) + 0.5F;
    samples.y[to] = static_cast<float>(pixel_y - view_.origin_y) + 0.5F;
    samples.q[to] = depth_[from];
    samples.id[to] = ids_[from];
  }
}

FloorSamples::FloorSamples(int x, int y, InstructionSet set, int anisotropy)
    : drawing(lit_floor(), floor_view(), set),
      source{&drawing.frame(), &drawing.view(), Interpolation::perspective, anisotropy} {
  drawing.take_samples(x, y, *samples);
  shade::find_surface_points_for(set)(source, surface(), *samples, *points);
}

const frame::Surface& FloorSamples::surface() const { return drawing.frame().surfaces[0]; }

}  // namespace laterna
