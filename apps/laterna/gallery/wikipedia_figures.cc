// Wikipedia, Shadow mapping, as of 2010 (document 003).
#include <fmt/format.h>

#include <algorithm>

#include "sets.h"

namespace laterna::app {
namespace {

void draw_steps(Sitting& sitting) {
  Shot shot = solids_set();
  add_lamp(shot.scene, "lamp", {{-2.4, 2.6, 2.4}, {-0.1, 0.2, 0}}, Angle::degrees(32), {0.95F, 0.90F, 0.80F});
  sitting.picture("The scene without shadows.", shot.with(ShadowTechnique::none));
  sitting.light_view("The scene from the light's point of view.", shot, "lamp");
  sitting.depth_map("Its depth map from there.", shot, "lamp");
  sitting.projected_depth("The depth map projected onto the scene.", shot, "lamp");
  sitting.failures("Where the depth test fails: black.", shot, "lamp");
  sitting.picture("The final scene.", shot);
}

void draw_filters(Sitting& sitting) {
  Shot shot = fence_set();
  shot.settings.samples = 1;
  ShadowSettings& shadow = shot.scene.lights.front().shadow;
  shadow.resolution = 256;
  const Detail part = {0.30, 0.36, 0.30, 0.30, 3};
  shadow.filter = ShadowFilter::nearest;
  sitting.detail("The nearest texel: jagged.", shot, part);
  shadow.filter = ShadowFilter::bilinear;
  sitting.detail("Four comparisons, weighted: a ramp.", shot, part);
  shadow.filter = ShadowFilter::percentage_closer;
  sitting.detail("3 × 3 comparisons, averaged: ten levels.", shot, part);
  shadow.filter = ShadowFilter::refined;
  sitting.detail("The triangles that the texels saw, tested themselves: the default.", shot, part);
}

/// A board close over a block, the sun high above.
Shot board_over_block() {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.2F);
  add_floor(scene, 4);
  add_object(scene, "block", box({-0.7F, 0, -0.6F}, {0.7F, 0.9F, 0.6F}),
             add_material(scene, "plaster", {0.74F, 0.72F, 0.68F}));
  add_object(scene, "board", box({-1.0F, 1.2F, -0.9F}, {0.35F, 1.24F, 0.4F}),
             add_material(scene, "clay", {0.62F, 0.24F, 0.12F}));
  add_sun(scene, "sun", {{-0.9, 3.0, 0.7}, {0, 0, 0}}, {0.95F, 0.90F, 0.80F});
  ShadowSettings& shadow = scene.lights.front().shadow;
  shadow.resolution = 128;
  shadow.kernel = 7;
  shot.settings.samples = 1;
  shot.camera = {{1.9, 2.5, 2.9}, {0.05, 0.6, 0}};
  return shot;
}

struct WrongPixel {
  int width = 0, height = 0;  // of the picture
  int x = 0, y = 0;
  float averaged = 0, closer = 0;  // what arrives
};

// In the board's shadow, and so by percentage-closer filtering: where averaged depths err most.
WrongPixel find_wrong_pixel(Sitting& sitting, const Shot& averaged, const Shot& closer, const Shot& rays) {
  Shot boardless = rays;
  for (Node& node : boardless.scene.nodes) node.casts_shadow = node.name != "board";
  const Visibility truth = sitting.visibility(rays, "sun");
  const Visibility without = sitting.visibility(boardless, "sun");
  const Visibility by_averages = sitting.visibility(averaged, "sun");
  const Visibility by_closer = sitting.visibility(closer, "sun");
  WrongPixel worst;
  worst.width = truth.width;
  worst.height = truth.height;
  for (std::size_t i = 0; i < truth.values.size(); ++i) {
    if (truth.values[i] > 0 || without.values[i] == 0 || by_closer.values[i] >= 0.5F) continue;
    if (by_averages.values[i] - by_closer.values[i] <= worst.averaged - worst.closer) continue;
    const auto place = static_cast<int>(i);
    worst = {truth.width,         truth.height,          place % truth.width,
             place / truth.width, by_averages.values[i], by_closer.values[i]};
  }
  return worst;
}

void draw_averages(Sitting& sitting) {
  Shot averaged = board_over_block();
  averaged.scene.lights.front().shadow.filter = ShadowFilter::averaged_depths;
  Shot closer = board_over_block();
  closer.scene.lights.front().shadow.filter = ShadowFilter::percentage_closer;
  sitting.picture("Traced rays: a board over a block.", closer.with(ShadowTechnique::raytraced));
  for (Shot* shot : {&averaged, &closer}) {
    for (Node& node : shot->scene.nodes) node.visible = node.name != "board";
  }
  const Shot rays = closer.with(ShadowTechnique::raytraced);
  const WrongPixel wrong = find_wrong_pixel(sitting, averaged, closer, rays);
  constexpr double kPart = 0.15;
  const auto begin = [](int pixel, int side) {
    return std::clamp((pixel + 0.5) / std::max(side, 1) - kPart / 2, 0.0, 1 - kPart);
  };
  const Detail part = {begin(wrong.x, wrong.width), begin(wrong.y, wrong.height), kPart, kPart, 6};
  sitting.picture("Averaged depths. The board still casts its shadow but is not drawn.", averaged);
  sitting.picture("Percentage-closer filtering, likewise.", closer);
  sitting.detail(fmt::format("Averaged depths. Pixel ({}, {}), in the middle, is in the board's shadow, and "
                             "yet gets {:.0f} % of "
                             "the light.",
                             wrong.x, wrong.y, 100 * static_cast<double>(wrong.averaged)),
                 averaged, part);
  sitting.detail(
      fmt::format("Percentage-closer: that pixel gets {:.0f} %.", 100 * static_cast<double>(wrong.closer)),
      closer, part);
  sitting.detail("Traced rays: it gets nothing.", rays, part);
}

void draw_darkness(Sitting& sitting) {
  Shot shot = solids_set();
  shot.scene.ambient = glm::vec3(0.05F);
  shot.scene.phong = PhongHighlight{0.5F, 12};
  ShadowSettings& shadow = add_morning_sun(shot.scene).shadow;
  sitting.picture("Only ambient light in shadow: curves look flat.", shot);
  shadow.ambient = 0.25F;
  sitting.picture("Shadow ambient 0.25: a quarter of the light arrives all the same.", shot);
  shadow.ambient = 0;
  shadow.fill = 0.25F;
  sitting.picture("Dim fill 0.25: diffuse only, without highlights.", shot);
}

constexpr Figure kFigures[] = {
    {"steps", "Shadow mapping, step by step", "Wikipedia, the article's pictures",
     "First the scene from the light, of which only depth is kept; then, from the eye, each point is looked "
     "up there, and is "
     "in shadow where the map holds something nearer.",
     "The map holds one depth per texel: it can be no finer than its texels, if nothing is done about it.",
     "laterna render scene.glb --rig lamp.json --from-light lamp -o from-lamp.png\n"
     "laterna depthmap scene.glb --rig lamp.json --light lamp -o depth.png\n"
     "laterna render scene.glb --rig lamp.json --debug project-depth:lamp -o projected.png\n"
     "laterna render scene.glb --rig lamp.json --layers visibility --layer-pictures layers -o scene.png",
     draw_steps},
    {"filters", "Nearest against filtered", "Wikipedia, \"Depth map test\"",
     "\"If interpolation cannot be done, the shadow will appear to have a sharp jagged edge.\" A map of 256 "
     "texels, read in "
     "four ways; the same detail enlarged.",
     "Weighted comparisons hide the staircase behind a blur that is as wide as a texel, whatever the light's "
     "size.",
     "\"shadow\": {\"resolution\": 256, \"filter\": \"percentage_closer\"}", draw_filters},
    {"averaged-depths", "Averaging depths is a mistake",
     "MIT 6.837, lecture 20, on percentage-closer filtering",
     "The same map of 128 texels, 7 × 7 of them asked. Their mean depth, of board, block and floor, is the "
     "depth of nothing: "
     "it may lie behind the block, and what is in shadow turns light. Comparing first and averaging the "
     "answers does not "
     "do that.",
     "Percentage-closer filtering is no more than a blur: as wide close to the caster as far from it.",
     "\"shadow\": {\"resolution\": 128, \"filter\": \"averaged_depths\", \"kernel\": 7}", draw_averages},
    {"darkness", "How dark a shadow is", "Wikipedia, \"Drawing the scene\"",
     "\"This is usually adjusted to also include a dim diffuse light to keep curved surfaces from appearing "
     "flat in "
     "shadow\"; the article's own pictures used GL_ARB_shadow_ambient.",
     "Neither is what light does. Both are off unless asked for.",
     "\"shadow\": {\"ambient\": 0.25} or \"shadow\": {\"fill\": 0.25}", draw_darkness},
};

}  // namespace

Chapter wikipedia_chapter() {
  return {"Wikipedia: Shadow mapping, as of 2010",
          "Williams' method of 1978, and what hardware of the time made of it.", kFigures};
}

}  // namespace laterna::app
