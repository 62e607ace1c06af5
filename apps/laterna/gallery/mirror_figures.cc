// What Chen and Tung leave to the future: "reflection, not shadow". Mirrors and water.
#include <algorithm>
#include <utility>

#include "laterna/mirrors.h"
#include "paintings.h"
#include "sitting.h"

namespace laterna::app {
namespace {

int add_mirror(Scene& scene, const char* name, Primitive primitive, const Mirror& mirror,
               glm::vec3 color = glm::vec3(0.1F)) {
  const int material = add_material(scene, name, color);
  scene.materials.back().mirror = std::make_shared<const Mirror>(mirror);
  return add_object(scene, name, std::move(primitive), material);
}

/// A show of slides on a screen at the back, a pot and a ball before it, and a tiled floor.
Shot show() {
  Shot shot;
  Scene& scene = shot.scene;
  add_object(scene, "screen", rectangle({0, 1.5F, -3}, {1, 0, 0}, {0, 1, 0}, {4.4F, 3}, 1),
             add_material(scene, "screen", glm::vec3(0.85F)));
  add_object(scene, "pot", teapot({0.5F, 0, -1.2F}, 1.3F),
             add_material(scene, "glaze", {0.16F, 0.38F, 0.44F}));
  add_object(scene, "ball", ball({-0.7F, 0.35F, -1.6F}, 0.35F),
             add_material(scene, "clay", {0.62F, 0.24F, 0.12F}));
  Light& projector = add_projector(scene, "lantern", {{0.6, 1.7, 3.4}, {0, 1.3, -3}}, Angle::degrees(22),
                                   add_picture(scene, "lake", paint_lake(512, 384)));
  projector.attenuation = Attenuation::none;
  projector.intensity = 1.1;
  set_mood(scene, 0.12F);
  shot.settings.accumulate = 4;  // of four samples each
  return shot;
}

Shot room() {
  Shot shot = show();
  add_floor(shot.scene, 9);
  // At the left, in a frame.
  const glm::vec3 middle(-2, 1.3F, -1.2F), right(0, 0, -1);
  add_object(shot.scene, "frame", box({-2.12F, 0.08F, -2.52F}, {-2.02F, 2.52F, 0.12F}),
             add_material(shot.scene, "wood", {0.30F, 0.17F, 0.07F}));
  add_mirror(shot.scene, "mirror", rectangle(middle, right, {0, 1, 0}, {2.4F, 2.2F}, 1), {});
  shot.camera = {{2.4, 1.7, 2.6}, {-0.7, 1, -1.9}};
  shot.yfov = Angle::degrees(42);
  return shot;
}

void draw_room(Sitting& sitting) {
  const Shot shot = room();
  sitting.picture("The screen, the slide on it and the shadows in the slide are in the mirror too.", shot);
  sitting.detail("At the frame's edge.", shot, {0.1, 0.25, 0.2, 0.2});
  Shot floor = show();
  Mirror polished;
  polished.ior = 1.5F;
  add_mirror(floor.scene, "floor", rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {9, 9}, 1), polished,
             {0.12F, 0.10F, 0.09F});
  floor.camera = {{1.2, 0.9, 2.4}, {-0.2, 0.8, -2.4}};
  floor.yfov = Angle::degrees(40);
  sitting.picture("A floor of polished stone: glancing looks are mirrored most.", floor);
  polished.roughness = 0.3F;
  floor.scene.materials.back().mirror = std::make_shared<const Mirror>(polished);
  sitting.picture("The same floor, rough: what stands on it is sharp where it stands.", floor);
}

void draw_facing(Sitting& sitting) {
  Shot shot = show();
  add_floor(shot.scene, 9);
  Mirror silver;
  silver.reflectance = {0.86F, 0.92F, 0.88F};
  add_mirror(shot.scene, "left", rectangle({-2, 1.4F, -1}, {0, 0, -1}, {0, 1, 0}, {3, 2.6F}, 1), silver);
  add_mirror(shot.scene, "right", rectangle({2, 1.4F, -1}, {0, 0, 1}, {0, 1, 0}, {3, 2.6F}, 1), silver);
  shot.camera = {{1.5, 1.6, 1.4}, {-2, 1.1, -1.6}};
  shot.yfov = Angle::degrees(50);
  for (const int depth : {1, 2, 6}) {
    shot.settings.mirror_depth = depth;
    sitting.picture("Mirrors seen one in the other, --mirror-depth " + std::to_string(depth) + ".", shot);
  }
}

// Seen through: what lies below is refracted, and the water's colour comes with the way that light goes in it.
void draw_below(Sitting& sitting, Shot shot, Mirror water) {
  Scene& scene = shot.scene;
  water.volume = {{0.35F, 0.75F, 0.85F}, 1};
  add_object(scene, "sunk", ball({0.55F, -0.25F, 0.2F}, 0.25F),
             add_material(scene, "brick", {0.62F, 0.24F, 0.12F}));
  add_object(scene, "post", box({-0.65F, -0.5F, 0.1F}, {-0.55F, 0.5F, 0.2F}),
             add_material(scene, "oak", {0.30F, 0.17F, 0.07F}));
  const auto pond = std::find_if(scene.materials.begin(), scene.materials.end(),
                                 [](const Material& material) { return material.name == "water"; });
  const std::vector<Wave> waves = std::exchange(water.waves, {});
  for (const bool is_refracted : {false, true}) {
    Mirror clear = water;
    if (!is_refracted) clear.volume.reset();
    pond->mirror = std::make_shared<const Mirror>(clear);
    pond->base_color.a = is_refracted ? 0.1F : 0.3F;
    sitting.picture(is_refracted ? "Refracted: the post bends and the ball is flat, as rays have it."
                                 : "Seen straight through: the post goes on as if there were no water.",
                    shot);
  }
  water.waves = waves;
  pond->mirror = std::make_shared<const Mirror>(water);
  sitting.picture("Refracted by waves.", shot);
}

void draw_water(Sitting& sitting) {
  Shot shot = show();
  Scene& scene = shot.scene;
  add_object(
      scene, "bottom", rectangle({0, -0.5F, 0}, {1, 0, 0}, {0, 0, -1}, {9, 9}, 1),
      add_material(scene, "sand", {0.55F, 0.47F, 0.32F}, add_picture(scene, "tiles", paint_tiles(256))));
  Mirror water;
  water.ior = 1.333F;
  add_mirror(scene, "water", rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {9, 9}, 1), water,
             {0.05F, 0.16F, 0.18F});
  scene.materials.back().alpha_mode = AlphaMode::blend;
  scene.materials.back().base_color.a = 0.45F;
  shot.camera = {{0.9, 0.8, 2.4}, {-0.2, 0.7, -2.4}};
  shot.yfov = Angle::degrees(42);
  sitting.picture("Still water.", shot);
  water.waves = {{{1, 0, 0.4}, 0.9, 0.006, {}, 0},
                 {{-0.3, 0, 1}, 0.53, 0.005, {}, 0},
                 {{0.5, 0, -1}, 0.31, 0.002, {}, 0}};
  scene.materials.back().mirror = std::make_shared<const Mirror>(water);
  sitting.picture("Three trains of waves.", shot);
  draw_below(sitting, std::move(shot), water);
}

constexpr Figure kFigures[] = {
    {"mirror", "A mirror, and polished stone", "Chen and Tung, future work: mirror",
     "A picture of the mirrored camera is looked up pixel by pixel; so what is lit by a slide, and what is "
     "in shadow, is so in "
     "the mirror.",
     "Light itself does not go by way of the mirror: no bright patch lies on the floor before it.",
     "\"surfaces\": [{\"material\": \"glass\", \"mirror\": {}}], and {\"ior\": 1.5, \"roughness\": 0.3}",
     draw_room},
    {"facing-mirrors", "Mirrors in mirrors", "Chen and Tung, future work: reflecting models",
     "The mirrored view has mirrored views of its own, each cut off at its mirror.",
     "At the set depth mirrors are plain grey surfaces.",
     "laterna render room.glb --rig r.json --mirror-depth 6", draw_facing},
    {"water", "Water", "Chen and Tung, future work: water",
     "Fresnel's equations: what lies below is seen near by, and the screen farther off. Waves bend the look, "
     "and with a volume what lies below is refracted.",
     "Light that falls into the water is not bent: its shadows and slides lie where straight rays leave "
     "them.",
     "\"mirror\": {\"ior\": 1.333, \"waves\": [{\"direction\": [1, 0, 0.4], \"length\": 0.9, \"amplitude\": "
     "0.006}], \"volume\": {\"attenuation_color\": [0.35, 0.75, 0.85], \"attenuation_distance\": 1}}",
     draw_water},
};

}  // namespace

Chapter mirror_chapter() {
  return {"Mirrors and water", "Reflection, not shadow: what Chen and Tung leave to the future.", kFigures};
}

}  // namespace laterna::app
