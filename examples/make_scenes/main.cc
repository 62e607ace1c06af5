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

/// Dashes, 3 m long, 9 m apart, along the middle of a way that runs to −Z.
Primitive dashes(float from, float to, float width) {
  Primitive all;
  for (float z = from; z > to; z -= 9)
    append(all, rectangle({0, 0.005F, z - 1.5F}, kRight, -kFront, {width, 3}, 1));
  return all;
}

/// Row 20: a road to a wall, a car at the origin that looks along −Z, 25 m before the wall.
GlbFile make_road() {
  GlbFile file;
  const int asphalt =
      file.add_material({.name = "asphalt", .color = {0.09F, 0.09F, 0.095F}, .roughness = 0.95F});
  const int paint = file.add_material({.name = "road paint", .color = {0.75F, 0.75F, 0.72F}});
  const int grass = file.add_material({.name = "grass", .color = {0.06F, 0.10F, 0.03F}, .roughness = 1});
  const int concrete =
      file.add_material({.name = "concrete", .color = {0.55F, 0.54F, 0.52F}, .roughness = 0.9F});
  const int lacquer =
      file.add_material({.name = "lacquer", .color = {0.35F, 0.03F, 0.03F}, .roughness = 0.4F});
  const int coat = file.add_material({.name = "coat", .color = {0.30F, 0.28F, 0.22F}, .roughness = 0.9F});
  file.add_object("road", rectangle({-1.75F, 0, -10}, kRight, -kFront, {7, 34}, 1), asphalt);
  file.add_object("verge", rectangle({0, -0.02F, -10}, kRight, -kFront, {40, 34}, 1), grass);
  Primitive middle = dashes(6, -25, 0.12F);
  for (glm::vec3& p : middle.positions) p.x -= 1.75F;
  file.add_object("middle line", middle, paint);
  file.add_object("edge line", rectangle({1.6F, 0.005F, -10}, kRight, -kFront, {0.15F, 34}, 1), paint);
  file.add_object("wall", rectangle({0, 2.5F, -25}, kRight, kUp, {40, 5}, 1), concrete);
  Primitive body = box({-0.85F, 0.3F, 0.05F}, {0.85F, 0.85F, 4.2F});
  append(body, box({-0.75F, 0.85F, 1.3F}, {0.75F, 1.4F, 3.9F}));
  for (const float x : {-0.8F, 0.6F}) {
    for (const float z : {0.5F, 3.2F}) append(body, box({x, 0, z}, {x + 0.2F, 0.6F, z + 0.6F}));
  }
  file.add_object("car", body, lacquer);
  const auto person = [](glm::vec3 foot) {
    Primitive p = lathe(
        foot, {{0, 0}, {0.16F, 0}, {0.16F, 0}, {0.14F, 0.8F}, {0.22F, 1.35F}, {0.08F, 1.5F}, {0, 1.52F}}, 24);
    append(p, ball(foot + glm::vec3(0, 1.62F, 0), 0.12F, 12));
    return p;
  };
  file.add_object("walker", person({2.3F, 0, -16}), coat);
  file.add_object("other walker", person({-4.4F, 0, -19}), coat);
  Primitive posts;
  for (float z = -2; z > -25; z -= 7.5F) append(posts, box({2.0F, 0, z}, {2.1F, 0.9F, z + 0.1F}));
  file.add_object("posts", posts, paint);
  return file;
}

/// Row 20: an apron before a hangar; the aircraft stands at the origin and looks along −Z.
GlbFile make_apron() {
  GlbFile file;
  const int concrete =
      file.add_material({.name = "concrete", .color = {0.25F, 0.25F, 0.24F}, .roughness = 0.9F});
  const int paint = file.add_material({.name = "yellow paint", .color = {0.80F, 0.55F, 0.05F}});
  const int sheet = file.add_material({.name = "sheet", .color = {0.45F, 0.48F, 0.50F}, .roughness = 0.6F});
  const int dark = file.add_material({.name = "doors", .color = {0.12F, 0.14F, 0.18F}, .roughness = 0.6F});
  file.add_object("apron", rectangle({0, 0, -35}, kRight, -kFront, {120, 110}, 1), concrete);
  file.add_object("taxi line", rectangle({0, 0.005F, -35}, kRight, -kFront, {0.3F, 90}, 1), paint);
  file.add_object("hangar", rectangle({0, 7, -80}, kRight, kUp, {90, 14}, 1), sheet);
  Primitive doors;
  for (const float x : {-26.0F, 0.0F, 26.0F}) append(doors, box({x - 10, 0, -79.9F}, {x + 10, 9, -79.7F}));
  file.add_object("doors", doors, dark);
  Primitive cones;
  for (float z = -10; z > -75; z -= 10) {
    for (const float x : {-12.0F, 12.0F}) append(cones, box({x, 0, z}, {x + 0.4F, 0.8F, z + 0.4F}));
  }
  file.add_object("cones", cones, paint);
  return file;
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
  scene("road.glb", make_road());
  scene("apron.glb", make_apron());
  picture("low_beam.png", paint_low_beam());
  picture("beam.png", paint_beam(256, 128));
  picture("lake.png", paint_slide(768, 512));
  picture("star.png", paint_star(256));
  picture("rose.png", paint_rose(512));
  is_good &= is_written(write_downlight(folder / "downlight.ies"), folder / "downlight.ies");
  is_good &= is_written(write_wall_washer(folder / "wall_washer.ies"), folder / "wall_washer.ies");
  return is_good ? 0 : 4;
}
