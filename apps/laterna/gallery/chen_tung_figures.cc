// Chen and Tung, Real-time shadow rendering using projective texture (document 001).
#include <fmt/format.h>

#include <array>

#include "paintings.h"
#include "sets.h"

namespace laterna::app {
namespace {

void draw_colour(Sitting& sitting) {
  Shot shot = parade_set(Ground::plane).with(ShadowTechnique::silhouette);
  ShadowSettings& shadow = add_morning_sun(shot.scene).shadow;
  sitting.picture("Opacity 1, black: of the sun nothing is left, only what comes from the sky.", shot);
  shadow.opacity = 0.5F;
  sitting.picture("Opacity 0.5: see-through black.", shot);
  shadow.opacity = 1;
  shadow.color = {0.18F, 0.24F, 0.62F};
  sitting.picture("Opacity 1, blue.", shot);
}

void draw_many_points(Sitting& sitting) {
  Shot shot = fence_set().with(ShadowTechnique::map);
  Light& sun = shot.scene.lights.front();
  sun.type = LightType::projector;
  sun.projection =
      Projection::perspective(Angle::degrees(70), 1, 0.1, std::numeric_limits<double>::infinity());
  sun.source.width = 0.5;
  sun.source.height = 0.5;
  shot.settings.samples = 1;
  for (const int points : {1, 4, 16, 64}) {
    shot.settings.accumulate = points;
    sitting.picture(points == 1 ? std::string("1 point: hard.") : fmt::format("{} points.", points), shot);
  }
}

void draw_smoothing(Sitting& sitting) {
  Shot shot = parade_set(Ground::plane).with(ShadowTechnique::silhouette);
  ShadowSettings& shadow = add_morning_sun(shot.scene).shadow;
  shadow.resolution = 128;
  shot.settings.width = 400;
  shot.settings.height = 300;
  for (int passes = 0; passes <= 10; ++passes) {
    shadow.smooth = passes;
    sitting.detail(fmt::format("n = {}", passes), shot, {0.28, 0.36, 0.5, 0.5, 2});
  }
}

void draw_procedure(Sitting& sitting) {
  Shot shot = solids_set().with(ShadowTechnique::silhouette);
  add_lamp(shot.scene, "lamp", {{-2.4, 2.3, 2.6}, {-0.1, 0.2, 0}}, Angle::degrees(32), {0.95F, 0.90F, 0.80F});
  sitting.picture("The scene without shadows.", shot.with(ShadowTechnique::none));
  sitting.light_view("First part: the models as the light sees them. Each becomes a silhouette.", shot,
                     "lamp");
  sitting.picture("Second part: each silhouette thrown on the models behind it.", shot);
  sitting.picture("The same by traced rays.", shot.with(ShadowTechnique::raytraced));
}

void draw_plane_and_hills(Sitting& sitting) {
  for (const Ground ground : {Ground::plane, Ground::hills}) {
    Shot shot = parade_set(ground).with(ShadowTechnique::silhouette);
    const std::string where = ground == Ground::plane ? "plane" : "terrain of 256 × 256 heights";
    Shot one = shot;
    add_morning_sun(one.scene);
    sitting.picture("One light, " + where + ".", one);
    set_mood(shot.scene, 0.08F);
    add_sun(shot.scene, "warm", {{-3.4, 3.6, 3.0}, {0, 0, 0}}, {0.60F, 0.36F, 0.20F});
    add_sun(shot.scene, "green", {{0.4, 3.6, 3.4}, {0, 0, 0}}, {0.22F, 0.34F, 0.22F});
    add_sun(shot.scene, "blue", {{3.6, 3.4, 2.2}, {0, 0, 0}}, {0.20F, 0.28F, 0.46F});
    sitting.picture("Three lights, " + where + ".", shot);
  }
}

void draw_soft_models(Sitting& sitting) {
  for (const Ground ground : {Ground::plane, Ground::hills}) {
    Shot shot = parade_set(ground).with(ShadowTechnique::silhouette);
    ShadowSettings& shadow = add_morning_sun(shot.scene).shadow;
    shadow.resolution = 256;
    shadow.smooth = 6;
    sitting.picture(ground == Ground::plane ? "On a plane." : "On a terrain.", shot);
  }
}

/// One walker, or two close together, the one in the other's light.
Shot walkers(int count) {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.22F);
  add_floor(scene);
  add_walker(scene, "in front", 0, {-0.55F, 0, 0.5F}, 0.7F);
  if (count > 1) add_walker(scene, "behind", 1, {0.2F, 0, -0.25F}, -0.5F);
  add_sun(scene, "sun", {{-3.4, 2.9, 3.0}, {0, 0, 0}}, {0.95F, 0.90F, 0.80F});
  shot.camera = {{0.9, 1.9, 4.2}, {0.1, 0.88, 0}};
  return shot;
}

void draw_skins(Sitting& sitting) {
  const Shot shot = walkers(2);
  Shot as_printed = shot.with(ShadowTechnique::silhouette);
  for (Node& node : as_printed.scene.nodes) node.receives_shadow = node.name == "floor";
  sitting.picture("As in the paper: the skin covers the shadow that should lie on it.", as_printed);
  sitting.picture("Light times skin: the shadow is on the skin.", shot.with(ShadowTechnique::silhouette));
}

void draw_moving(Sitting& sitting) {
  for (const float x : {1.35F, 0.6F, -0.15F}) {
    Shot shot = walkers(1).with(ShadowTechnique::silhouette);
    Scene& scene = shot.scene;
    add_object(scene, "cart", box({x - 0.45F, 0, -0.9F}, {x + 0.45F, 0.5F, -0.2F}),
               add_material(scene, "boards", glm::vec3(1), add_picture(scene, "boards", paint_boards(256))));
    sitting.picture(x > 1   ? "A cart behind the model …"
                    : x > 0 ? "… moves …"
                            : "… through a standing shadow.",
                    shot);
  }
}

void draw_sizes(Sitting& sitting) {
  Shot shot = fence_set();
  shot.settings.samples = 1;
  ShadowSettings& shadow = shot.scene.lights.front().shadow;
  const Detail part = {0.30, 0.36, 0.30, 0.30, 3};
  shadow.filter = ShadowFilter::nearest;
  for (const int resolution : {128, 256, 512, 1024}) {
    shadow.resolution = resolution;
    sitting.detail(fmt::format("{0} × {0} texels, the nearest taken.", resolution), shot, part);
  }
  shadow.filter = ShadowFilter::refined;
  shadow.resolution = 128;
  sitting.detail(
      "128 × 128 texels, and the triangles that they saw asked (refined, the default): straight edges, and "
      "specks where no "
      "texel saw what stands there.",
      shot, part);
}

constexpr Figure kFigures[] = {
    {"shadow-colour", "The colour of shadows", "Chen and Tung, figure 3",
     "The receiver's own texture stays visible within the shadow. Unless told otherwise shadows are what is "
     "physically "
     "left: the light of the other lights and of the sky.",
     "A shadow lighter than its lamp's absence is an artist's choice, not physics: two such lamps leave too "
     "much light.",
     "\"shadow\": {\"technique\": \"silhouette\", \"opacity\": 0.5, \"color\": [0, 0, 0]}", draw_colour},
    {"many-points", "A soft shadow by many points", "Chen and Tung, figure 4",
     "A light of half a metre by half a metre stands for 1, 4, 16 and 64 points. Where their shadows overlap "
     "it is darker.",
     "Few points show as steps: four give five levels of light at an edge, however large the picture.",
     "\"size\": [0.5, 0.5] in the light, and: laterna render scene.glb --rig lamp.json --accumulate 64 -o "
     "soft.png",
     draw_many_points},
    {"smoothing", "A soft shadow by smoothing", "Chen and Tung, figures 5 and 6",
     "Each texel of the silhouette becomes the mean of its eight neighbours, n times over.",
     "The edge is as soft at the feet, where a real shadow is sharp, as at the head. A light's true size "
     "needs pcss or many points.",
     "\"shadow\": {\"technique\": \"silhouette\", \"resolution\": 128, \"smooth\": 10}", draw_smoothing},
    {"occluders-and-receivers", "Many occluders, many receivers", "Chen and Tung, figures 7 to 11",
     "Each model is both. Its silhouette is thrown on those that are farther from the light, and on no "
     "others.",
     "A silhouette knows no depth within its model, so nothing shadows itself: the rays show what is missing "
     "at the root "
     "of the teapot's spout, under its lid and on the urn's foot.",
     "laterna render scene.glb --rig lamp.json --shadows silhouette -o silhouette.png", draw_procedure},
    {"plane-and-terrain", "Plane and terrain, one light and several", "Chen and Tung, figures 21 to 23",
     "What falls on hills follows them. Each light has its own shadows; where two meet only the third light "
     "is left.",
     "The terrain is told to throw no shadow: as a silhouette, which knows no depths, it would shade the "
     "feet that stand in it. So its hills do not shadow each other; map and exact can do both.",
     "laterna render hills.glb --rig lights.json --shadows silhouette -o hills.png", draw_plane_and_hills},
    {"smooth-models", "Smoothed shadows on plane and terrain", "Chen and Tung, figure 24",
     "The technique of the paper whole: silhouettes of 256 texels, smoothed six times.", "",
     "\"shadow\": {\"technique\": \"silhouette\", \"resolution\": 256, \"smooth\": 6}", draw_soft_models},
    {"moving", "Moving receivers", "Chen and Tung, figure 25",
     "The cart moves and the light does not: shadows stay where they were in the world, and bend over what "
     "comes.",
     "",
     "laterna render frame0001.glb --rig sun.json --shadows silhouette -o frame0001.png\nand so on, one "
     "scene for each place of the cart",
     draw_moving},
    {"skins", "The paper's own failure: textured models as receivers", "Chen and Tung, section 4",
     "\"Because the MD2 textures will cover the shadow texture, so the MD2 model can not render the shadow "
     "texture.\" In "
     "Laterna a shadow is light that is missing, and light and texture are multiplied.",
     "The left picture is staged: the models are told to receive no shadow.",
     "\"nodes\": [{\"name\": \"behind\", \"receives_shadow\": false}] gives the left one", draw_skins},
    {"map-sizes", "Aliasing, and the size of the shadow texture", "Chen and Tung, figures 26 and 27",
     "The same detail of a 640 × 480 picture. With the nearest texel the error at edges halves each time the "
     "texels do.",
     "Classic maps show their texels wherever a pixel is finer. The default shows triangles instead, but "
     "knows only those "
     "that some texel saw: it too needs texels finer than what throws the shadow.",
     "\"shadow\": {\"resolution\": 256, \"filter\": \"nearest\"}", draw_sizes},
};

}  // namespace

Chapter chen_tung_chapter() {
  return {"Chen and Tung: Real-Time Shadow Rendering Using Projective Texture",
          "Silhouettes, seen from the light, thrown on what is behind. Where Debian's assimp-testmodels are "
          "installed, those who walk are MD2 models that run, as in the paper; elsewhere mannequins.",
          kFigures};
}

}  // namespace laterna::app
