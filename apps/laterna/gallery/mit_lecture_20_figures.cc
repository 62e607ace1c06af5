// MIT 6.837, lecture 20: slides as light and as paint, slides that meet, and textures that lie on one another.
#include <fmt/format.h>

#include "baking_figures.h"
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

/// A tiled floor that runs away from the camera.
Shot long_floor() {
  Shot shot;
  Scene& scene = shot.scene;
  scene.ambient_is_set = true;
  // One rectangle of two triangles: what a per-vertex divide does to it shows from edge to edge.
  add_object(scene, "floor", rectangle({0, 0, -3}, kRight, {0, 0, -1}, {3, 9}, 1),
             add_material(scene, "tiles", glm::vec3(1), add_picture(scene, "tiles", paint_tiles(256))));
  scene.materials.back().unlit = true;
  shot.camera = {{0, 1.1, 2.6}, {0, 0.15, -2}};
  shot.settings.anisotropy = 8;
  return shot;
}

void draw_labels(Sitting& sitting) {
  Shot shot = long_floor();
  sitting.picture("Homogeneous coordinates at the corners, one division per pixel.", shot);
  shot.settings.interpolation = Interpolation::affine;
  sitting.picture(
      "Divided at the corners and interpolated on the screen: each triangle bends in its own way.", shot);
}

/// A wall larger than the slide that is thrown on it, and one behind the projector.
Shot wall_before_projector(Outside outside) {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.1F);
  add_floor(scene);
  const int whitewash = add_material(scene, "whitewash", glm::vec3(0.8F));
  add_object(scene, "wall", rectangle({0, 1.5F, -2}, kRight, kUp, {6, 3}, 1), whitewash);
  add_object(scene, "behind", box({2.2F, 0, 1.3F}, {3.0F, 1.4F, 1.4F}), whitewash);
  Light& lantern = add_projector(scene, "lantern", {{1.2, 1.2, 0.8}, {-0.2, 1.4, -2}}, Angle::degrees(24),
                                 add_picture(scene, "lake", paint_lake(768, 512)));
  lantern.outside = outside;
  shot.camera = {{0, 2.4, 6.2}, {0.2, 1.15, -1}};
  shot.settings.width = 480;
  shot.settings.height = 320;
  return shot;
}

void draw_outside(Sitting& sitting) {
  sitting.picture("black: a slide has a frame.", wall_before_projector(Outside::black));
  sitting.picture("clamp, as the lecture's code does: its last rows go on for ever.",
                  wall_before_projector(Outside::clamp));
  sitting.picture("repeat.", wall_before_projector(Outside::repeat));
  sitting.picture("mirror.", wall_before_projector(Outside::mirror));
}

/// Solids that a camera beside them has photographed, or that a projector there shines on.
void draw_reflectance(Sitting& sitting) {
  const Gaze from = {{-1.9, 1.9, 3.6}, {0.0, 0.4, -0.2}};
  const Image slide = paint_lake(768, 512);
  Shot light = solids_set();
  set_mood(light.scene, 0.12F);
  add_projector(light.scene, "lantern", from, Angle::degrees(30), add_picture(light.scene, "lake", slide));
  sitting.picture("As light: the solids' own colours times the slide's.", light);

  Shot paint = solids_set();
  set_mood(paint.scene, 0.12F);
  Photograph photograph;
  photograph.name = "lake";
  photograph.picture = add_picture(paint.scene, "lake", slide);
  if (const auto pose = Pose::look_at(from.from, from.to, {0, 1, 0})) photograph.pose = *pose;
  photograph.projection = Projection::perspective(Angle::degrees(30), 1.5, 0.1, 100);
  paint.scene.photographs.push_back(photograph);
  paint.scene.photograph_settings.unseen = {0.5F, 0.02F, 0.4F};
  sitting.picture("As paint: the colour of a surface is what the camera saw there. Pink was seen by nobody.",
                  paint);
  paint.scene.photograph_settings.are_lit = true;
  add_morning_sun(paint.scene);
  sitting.picture("The painted solids under a sun of another day.", paint);
}

/// Distances from the lamp as they lie in the map, and the same thrown back on the scene.
void draw_distances(Sitting& sitting) {
  Shot shot = solids_set();
  set_mood(shot.scene, 0.12F);
  add_lamp(shot.scene, "lamp", {{-1.9, 2.6, 3.0}, {0.1, 0.4, -0.2}}, Angle::degrees(22), glm::vec3(1.1F));
  ShadowSettings& shadow = shot.scene.lights.back().shadow;
  shadow.depth = ShadowDepth::radial;
  sitting.depth_map("The map: near the light is light, far is dark, and white is where nothing is.", shot,
                    "lamp");
  sitting.projected_depth("The same map as a slide.", shot, "lamp");
  sitting.picture("Compared by the length of the way to the light, as the lecture has it.", shot);
  shadow.depth = ShadowDepth::planar;
  sitting.picture("Compared along the light's axis: the same shadows.", shot);
}

constexpr Figure kFigures[] = {
    {"labels", "Ordinary textures", "Slides 2 to 5: label textures, and the mapping process",
     "One rectangle of two triangles, seen along its length.",
     "The second picture is what hardware without a division per pixel showed. It is here to be looked at "
     "alone.",
     "laterna render scene.glb --interpolation affine -o affine.png", draw_labels},
    {"outside", "Beside the slide, and behind the lens", "Slides 6 to 8: the projector's code",
     "The board at the right stands behind the projector, and gets nothing.",
     "The lecture's code clamps, and does not ask what is behind the lens: there the slide would appear once "
     "more, "
     "upside down.",
     "\"outside\": \"clamp\" in a projector of a rig", draw_outside},
    {"reflectance", "A picture as light, and as paint", "Slide 10: projective textures and reflectance",
     "The same picture from the same place.",
     "One photograph knows one side of things; laterna photo takes many.",
     "laterna photo scene.glb --cameras cameras.json -o painted.png", draw_reflectance},
    {"distances", "A shadow map is a picture of distances", "Slide 11: the shadow map picture",
     "What is farther than the map says lies in shadow.", "",
     "\"shadow\": {\"depth\": \"radial\"}; laterna depthmap scene.glb --light lamp --projected -o map.png",
     draw_distances},
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
    {"quake", "Textures, light maps, and both", "Slides 18 to 20: light maps in Quake",
     "A texture repeats over every wall, and one coarse map of light, seen once only, lies over all of it.",
     "Shadows are as coarse as the map, and a byte has 256 steps.",
     "laterna bake scene.glb -o baked.glb --density 4 --quake quake.png", draw_quake},
    {"baked", "Baked, and live", "Slides 18 to 20: light maps", "The same picture, at no cost for lamps.",
     "Highlights, and what moves, are not in it.",
     "laterna bake scene.glb --rig lamps.json -o baked.glb --density 96", draw_baked},
};

}  // namespace

Chapter mit_lecture_20_chapter() {
  return {"MIT 6.837, Lecture 20: Advanced Texture Mapping (2000)",
          "Projective textures, and several textures on one primitive.", kFigures};
}

}  // namespace laterna::app
