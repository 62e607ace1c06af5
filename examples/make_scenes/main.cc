// make_scenes FOLDER: writes the example scenes, slides, intensity maps and lamps of examples/scenes/. What it
// writes is committed; run it again after a change here.
#include <cstdio>
#include <filesystem>
#include <string>

#include "glb_file.h"
#include "lamps.h"
#include "pictures.h"
#include "shapes.h"

namespace {

using namespace laterna::examples;
using laterna::Primitive;
using laterna::Result;

constexpr glm::vec3 kRight(1, 0, 0);
constexpr glm::vec3 kUp(0, 1, 0);
constexpr glm::vec3 kFront(0, 0, 1);

/// A wooden floor and a whitewashed brick wall, 12 m wide, the wall 1.6 m behind the origin.
void add_room(GlbFile& file) {
  const int boards = file.add_material({.name = "boards", .roughness = 0.7F}, paint_boards(256));
  const int bricks = file.add_material({.name = "bricks"}, paint_bricks(256));
  file.add_object("floor", rectangle({0, 0, 1.4F}, kRight, -kFront, {12, 6}, 1.2F), boards);
  file.add_object("wall", rectangle({0, 2, -1.6F}, kRight, kUp, {12, 4}, 1.0F), bricks);
}

Primitive column(glm::vec3 foot) {
  return lathe(foot,
               {{0, 0},
                {0.20F, 0},
                {0.20F, 0},
                {0.20F, 0.10F},
                {0.20F, 0.10F},
                {0.14F, 0.16F},
                {0.13F, 0.2F},
                {0.12F, 1.1F},
                {0.14F, 1.14F},
                {0.19F, 1.2F},
                {0.19F, 1.2F},
                {0.19F, 1.28F},
                {0.19F, 1.28F},
                {0, 1.28F}},
               48);
}

Primitive urn(glm::vec3 foot) {
  return lathe(foot,
               {{0, 0},
                {0.10F, 0},
                {0.10F, 0},
                {0.10F, 0.03F},
                {0.05F, 0.06F},
                {0.045F, 0.10F},
                {0.12F, 0.18F},
                {0.17F, 0.28F},
                {0.175F, 0.36F},
                {0.14F, 0.45F},
                {0.08F, 0.51F},
                {0.075F, 0.55F},
                {0.11F, 0.60F},
                {0.11F, 0.60F},
                {0.095F, 0.60F},
                {0.06F, 0.54F},
                {0.06F, 0.50F},
                {0, 0.48F}},
               48);
}

/// Figure 3: solids on a stage.
GlbFile make_stage() {
  GlbFile file;
  add_room(file);
  const int marble = file.add_material({.name = "marble", .roughness = 0.4F}, paint_marble(256));
  const int plaster =
      file.add_material({.name = "plaster", .color = {0.86F, 0.84F, 0.8F}, .roughness = 0.9F});
  const int trellis = file.add_material({.name = "trellis", .is_cut_by_alpha = true}, paint_trellis(256));
  file.add_object("column", column({-1.3F, 0, -0.45F}), marble);
  file.add_object("urn", urn({-1.3F, 1.28F, -0.45F}), plaster);
  file.add_object("plinth", box({0.25F, 0, -0.65F}, {0.95F, 0.55F, 0.05F}), marble);
  file.add_object("ball", ball({0.6F, 0.90F, -0.3F}, 0.35F, 32), plaster);
  file.add_object("ring", ring({-0.1F, 0.30F, 0.45F}, {0.5F, 0.25F, 1}, 0.24F, 0.07F, 64), plaster);
  file.add_object(
      "trellis",
      rectangle({1.75F, 0.8F, -0.75F}, glm::normalize(glm::vec3(1, 0, 0.55F)), kUp, {1.1F, 1.6F}, 1.6F),
      trellis);
  return file;
}

/// Figure 4: solids under a spotlight from above, of which each shadows the next.
GlbFile make_table() {
  GlbFile file;
  add_room(file);
  const int plaster =
      file.add_material({.name = "plaster", .color = {0.86F, 0.84F, 0.8F}, .roughness = 0.9F});
  const int red =
      file.add_material({.name = "red lacquer", .color = {0.75F, 0.16F, 0.12F}, .roughness = 0.35F});
  const int wood = file.add_material({.name = "table"}, paint_boards(256));
  Primitive table = box({-0.8F, 0.70F, -0.5F}, {0.8F, 0.76F, 0.5F});
  for (const float x : {-0.72F, 0.66F}) {
    for (const float z : {-0.42F, 0.36F}) append(table, box({x, 0, z}, {x + 0.06F, 0.70F, z + 0.06F}));
  }
  file.add_object("table", table, wood);
  file.add_object("urn", urn({-0.35F, 0.76F, -0.05F}), plaster);
  file.add_object("ring", ring({0.25F, 0.98F, 0.05F}, {1, 0.1F, 0.8F}, 0.16F, 0.06F, 64), red);
  file.add_object("ball", ball({-0.72F, 0.13F, 0.0F}, 0.13F, 32), red);
  file.add_object("column", column({-1.3F, 0, -0.4F}), plaster);
  return file;
}

GlbFile make_room() {
  GlbFile file;
  add_room(file);
  return file;
}

bool is_written(const Result<void>& result, const std::filesystem::path& file) {
  std::printf("%s\n", result ? file.c_str() : to_string(result.error()).c_str());
  return result.has_value();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_scenes FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  bool is_good = true;
  const auto scene = [&](const char* name, const GlbFile& file) {
    is_good &= is_written(file.write(folder / name), folder / name);
  };
  const auto picture = [&](const char* name, const laterna::Image& image) {
    is_good &= is_written(write_image(image, folder / name), folder / name);
  };
  scene("stage.glb", make_stage());
  scene("table.glb", make_table());
  scene("room.glb", make_room());
  picture("lake.png", paint_slide(768, 512));
  picture("star.png", paint_star(256));
  is_good &= is_written(write_downlight(folder / "downlight.ies"), folder / "downlight.ies");
  is_good &= is_written(write_wall_washer(folder / "wall_washer.ies"), folder / "wall_washer.ies");
  return is_good ? 0 : 4;
}
