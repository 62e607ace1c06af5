// MIT 6.837, lecture 20: slides that meet, and textures that lie on one another.
#include <fmt/format.h>

#include "laterna/blend.h"
#include "paintings.h"
#include "sets.h"

namespace laterna::app {
namespace {

constexpr glm::vec3 kRight(1, 0, 0);
constexpr glm::vec3 kUp(0, 1, 0);

/// Solids under the lake from the right and a coat of many colours from the left.
Shot two_slides(BlendMode of_the_second) {
  Shot shot = solids_set();
  Scene& scene = shot.scene;
  set_mood(scene, 0.06F);
  const int lake = add_picture(scene, "lake", paint_lake(768, 512));
  const int coat = add_picture(scene, "coat", paint_coat(256));
  add_projector(scene, "lake", {{2.8, 2.3, 3.4}, {0.1, 0.35, -0.2}}, Angle::degrees(30), lake);
  add_projector(scene, "coat", {{-3.0, 2.1, 3.0}, {-0.1, 0.35, -0.2}}, Angle::degrees(30), coat).blend =
      of_the_second;
  return shot;
}

void draw_two_slides(Sitting& sitting) {
  const Shot shot = two_slides(BlendMode::add);
  for (const std::size_t left_out : {1U, 0U}) {
    Shot alone = shot;
    alone.scene.lights.at(left_out).enabled = false;
    sitting.picture(left_out == 1 ? "The first slide alone." : "The second alone.", alone);
  }
  sitting.picture("Both: each light adds what it would by itself.", shot);
  sitting.picture("modulate: the second filters what the first throws, and passes nothing beside its frame.",
                  two_slides(BlendMode::modulate));
  sitting.picture("difference: white is where they are far apart.", two_slides(BlendMode::difference));
}

/// A board with the lake on it, and over its middle a coat of many colours.
Shot board(BlendMode mode) {
  Shot shot;
  Scene& scene = shot.scene;
  scene.ambient_is_set = true;
  const int lake = add_picture(scene, "lake", paint_lake(768, 512));
  const int material = add_material(scene, "board", glm::vec3(1), lake);
  Primitive primitive = rectangle({0, 0, 0}, kRight, kUp, {3, 2}, 1);
  // The picture once all over.
  for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
    const glm::vec3& p = primitive.positions[i];
    primitive.uv[0][i] = {p.x / 3 + 0.5F, 0.5F - p.y / 2};
  }
  add_object(scene, "board", primitive, material);
  Material& board = scene.materials.back();
  board.unlit = true;
  Sampler& sampler = board.base_color_texture.sampler;
  sampler.wrap_u = sampler.wrap_v = Wrap::clamp;
  SurfaceLayer layer;
  layer.texture.picture = add_picture(scene, "coat", paint_coat(256));
  layer.texture.uv_from_mesh_uv = {1 / 0.7F, 0, -0.15F / 0.7F, 0, 1 / 0.7F, -0.15F / 0.7F};
  layer.once = true;
  layer.blend = mode;
  board.layers.push_back(layer);
  shot.camera = {{0, 0, 5}, {0, 0, 0}};
  shot.yfov = Angle::degrees(22.7);
  shot.settings.width = 480;
  shot.settings.height = 320;
  return shot;
}

void draw_blend_modes(Sitting& sitting) {
  Shot bare = board(BlendMode::over);
  bare.scene.materials.back().layers.clear();
  sitting.picture("c: the lake by itself.", bare);
  for (const BlendModeDescription& mode : list_blend_modes()) {
    Shot shot = board(mode.mode);
    // The coat has no alpha of its own.
    if (mode.mode == BlendMode::alpha_attenuate) {
      Material& material = shot.scene.materials.back();
      const std::shared_ptr<const Image> coat = shot.scene.pictures.back().pixels;
      Image faded(coat->width(), coat->height(), 4, PixelType::u8, Transfer::srgb);
      const std::span<std::uint8_t> values = faded.values<std::uint8_t>();
      for (int y = 0, i = 0; y < coat->height(); ++y) {
        for (int x = 0; x < coat->width(); ++x, i += 4) {
          for (int c = 0; c < 3; ++c) values[static_cast<std::size_t>(i + c)] = 255;
          values[static_cast<std::size_t>(i + 3)] = static_cast<std::uint8_t>(255 * coat->value(x, y, 0));
        }
      }
      material.layers.front().texture.picture = add_picture(shot.scene, "faded coat", std::move(faded));
    }
    sitting.picture(fmt::format("{}: {}. {}.", mode.name, mode.formula, mode.meaning), shot);
  }
}

constexpr Figure kFigures[] = {
    {"two-slides", "Two slides at once", "Slide 9: projective textures as a source of illumination",
     "Where both fall on a surface their light adds up, and each casts its own shadows.",
     "Light in the world only adds. A projector that filters or takes away is a picture's device: it does "
     "so with the light of those before it in the scene, and changes nothing that comes after.",
     "\"blend\": \"modulate\" in the second projector of a rig", draw_two_slides},
    {"blend-modes", "Every way to lay one texture on another", "Slides 16 and 17: multipass and multitexture",
     "A lake, and over its middle a coat of many colours, by each of laterna render --list-blend-modes, in "
     "linear light.",
     "Of alpha_attenuate the coat's red is taken as alpha, as it has none. dot3 takes colours for "
     "directions, "
     "which these are not.",
     "\"surfaces\": [{\"material\": \"board\", \"layers\": [{\"texture\": \"coat.png\", \"blend\": "
     "\"screen\"}]}]",
     draw_blend_modes},
};

}  // namespace

Chapter mit_lecture_20_chapter() {
  return {"MIT 6.837, Lecture 20: Advanced Texture Mapping (2000)",
          "Projective textures, and several textures on one primitive.", kFigures};
}

}  // namespace laterna::app
