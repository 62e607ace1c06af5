// Wikipedia, Shadow mapping, as of 2010 (document 003).
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

void draw_darkness(Sitting& sitting) {
  Shot shot = solids_set();
  shot.scene.ambient = glm::vec3(0.05F);
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
