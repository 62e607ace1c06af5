// What has come after the four documents: each of Laterna's techniques beside the others.
#include <array>

#include "sets.h"

namespace laterna::app {
namespace {

void draw_techniques(Sitting& sitting) {
  Shot shot = solids_set();
  add_morning_sun(shot.scene);
  for (const TechniqueDescription& technique : list_techniques())
    sitting.measured(shot.with(technique.technique), shot.with(ShadowTechnique::raytraced));
}

void draw_exact(Sitting& sitting) {
  Shot shot = fence_set();
  shot.settings.samples = 1;
  ShadowSettings& shadow = shot.scene.lights.front().shadow;
  const Detail part = {0.36, 0.40, 0.16, 0.16, 6};
  shadow.filter = ShadowFilter::bilinear;
  sitting.detail("A map of 2048 texels, four comparisons weighted.", shot, part);
  shadow.filter = ShadowFilter::refined;
  sitting.detail("The same map, refined.", shot, part);
  sitting.detail("Exact: each sample against every triangle in its way.", shot.with(ShadowTechnique::exact),
                 part);
  sitting.detail("Traced rays.", shot.with(ShadowTechnique::raytraced), part);
}

/// The fence before a light of half a metre by half a metre.
Shot fence_before_a_window() {
  Shot shot = fence_set();
  Light& light = shot.scene.lights.front();
  light.type = LightType::projector;
  light.projection =
      Projection::perspective(Angle::degrees(70), 1, 0.1, std::numeric_limits<double>::infinity());
  light.source.width = 0.5;
  light.source.height = 0.5;
  return shot;
}

void draw_soft(Sitting& sitting) {
  const Shot shot = fence_before_a_window();
  Shot smoothed = shot.with(ShadowTechnique::silhouette);
  smoothed.scene.lights.front().shadow.smooth = 10;
  sitting.picture("A silhouette, smoothed ten times: as soft at the foot of the fence as far from it.",
                  smoothed);
  sitting.picture(
      "Percentage-closer soft shadows (pcss): as soft as the light's size and the distances make them.",
      shot.with(ShadowTechnique::pcss));
  Shot truth = shot.with(ShadowTechnique::exact);
  truth.settings.samples = 1;
  truth.settings.accumulate = 256;
  sitting.picture("The mean of 256 exact pictures, each lit from another point of the light.", truth);
}

/// Railings along a street of 120 metres, and the sun across it.
Shot street() {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.2F);
  const int paving = add_material(scene, "paving", glm::vec3(0.70F, 0.68F, 0.64F));
  add_object(scene, "paving", rectangle({0, 0, -56}, {1, 0, 0}, {0, 0, -1}, {24, 128}, 2), paving);
  Primitive railings;
  for (const float x : {-1.6F, 1.6F}) {
    append(railings, box({x - 0.03F, 0.86F, -116}, {x + 0.03F, 0.94F, 4}));
    for (int post = 0; post < 240; ++post) {
      const float z = 3.9F - 0.5F * static_cast<float>(post);
      append(railings, box({x - 0.035F, 0, z - 0.035F}, {x + 0.035F, 0.86F, z + 0.035F}));
      if (post % 4 == 0) append(railings, ball({x, 1.02F, z}, 0.1F));
    }
  }
  add_object(scene, "railings", railings, add_material(scene, "paint", {0.62F, 0.24F, 0.12F}));
  add_sun(scene, "sun", {{-3, 2.6, 0.8}, {0, 0, 0}}, {0.95F, 0.90F, 0.80F});
  shot.camera = {{0.3, 1.7, 5.2}, {0, 0.5, -1}};
  return shot;
}

void draw_cascades(Sitting& sitting) {
  Shot shot = street();
  ShadowSettings& shadow = shot.scene.lights.front().shadow;
  shadow.resolution = 1024;
  shadow.filter = ShadowFilter::bilinear;
  sitting.picture("One map of 1024 texels for the whole street.", shot.with(ShadowTechnique::map));
  sitting.picture("Four cascades of 1024 texels each, the nearest the finest.",
                  shot.with(ShadowTechnique::cascades));
}

/// A window of three panes, one behind the other, before the sun.
Shot stained_glass() {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.10F);
  add_floor(scene);
  const int frame = add_material(scene, "lead", glm::vec3(0.12F));
  constexpr std::array<glm::vec3, 3> kColours = {
      {{0.95F, 0.25F, 0.15F}, {0.98F, 0.80F, 0.20F}, {0.20F, 0.45F, 0.95F}}};
  for (std::size_t i = 0; i < kColours.size(); ++i) {
    const int pane = add_material(scene, "pane", kColours.at(i), -1, 0.2F);
    Material& glass = scene.materials[static_cast<std::size_t>(pane)];
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color.w = 0.85F;
    glass.double_sided = true;
    const float x = -0.75F + 0.5F * static_cast<float>(i);
    const float z = 0.25F * static_cast<float>(i) - 0.3F;
    add_object(scene, "pane", rectangle({x + 0.25F, 0.75F, z}, {1, 0, 0}, {0, 1, 0}, {0.9F, 1.0F}, 1), pane);
    Primitive rim = box({x - 0.23F, 0.22F, z - 0.02F}, {x + 0.73F, 0.27F, z + 0.02F});
    append(rim, box({x - 0.23F, 1.23F, z - 0.02F}, {x + 0.73F, 1.28F, z + 0.02F}));
    append(rim, box({x - 0.25F, 0, z - 0.02F}, {x - 0.2F, 1.28F, z + 0.02F}));
    append(rim, box({x + 0.7F, 0, z - 0.02F}, {x + 0.75F, 1.28F, z + 0.02F}));
    add_object(scene, "frame", rim, frame);
  }
  add_sun(scene, "sun", {{-0.6, 2.6, -2.4}, {0, 0, 0}}, {1.05F, 1.0F, 0.92F});
  shot.camera = {{1.9, 2.2, 3.9}, {0.1, 0.3, 0.45}};
  return shot;
}

void draw_glass(Sitting& sitting) {
  const Shot shot = stained_glass();
  sitting.picture("Shadow maps.", shot.with(ShadowTechnique::map));
  sitting.picture("Exact.", shot.with(ShadowTechnique::exact));
  sitting.picture("Traced rays.", shot.with(ShadowTechnique::raytraced));
}

constexpr Figure kFigures[] = {
    {"exact", "Exact against map", "After Johnson et al. 2005 and Aila and Laine 2004",
     "One sample per pixel, enlarged. Exact shadows have no resolution and no bias: their edge runs where "
     "the ray's does.",
     "Only hard shadows are exact in this sense; a light with a size needs many points.",
     "laterna render scene.glb --shadows exact -o exact.png", draw_exact},
    {"soft", "Soft as the light is large", "After Fernando 2005; the article's further reading",
     "A penumbra is narrow where caster and receiver touch and wide where they are far apart. Smoothing "
     "cannot know that.",
     "pcss looks at one map from the light's middle: what hides behind the first caster it does not see, so "
     "that where "
     "penumbrae of several casters overlap it is off.",
     "\"size\": [0.5, 0.5] in the light, and --shadows pcss", draw_soft},
    {"cascades", "Parallel-split shadow maps", "After Zhang et al. 2006; the article's further reading",
     "A street of 120 metres in the sun. One map spends as many texels on its far end as on what is before "
     "the eye.",
     "Four maps cost four times the memory, and more to draw; where two meet the sharpness of edges changes.",
     "laterna render street.glb --rig sun.json --shadows cascades -o street.png", draw_cascades},
    {"stained-glass", "Stained glass", "What is see-through tints what it lets through",
     "Three panes. Where their shadows overlap, light has come through both, and is what each lets through "
     "of red, green "
     "and blue, multiplied.",
     "Glass here neither bends light nor focuses it.", "\"alphaMode\": \"BLEND\" in the glTF, nothing else",
     draw_glass},
    {"techniques", "Every technique, its cost and its error", "All of laterna render --list-techniques",
     "One scene and one sun. Times are of this machine, for this small scene, and include everything that a "
     "picture takes; "
     "a pixel is counted where more than half of its light is wrong.",
     "What a number of pixels does not tell is where they are: look at the ring, the plinth and the "
     "contacts.",
     "laterna render scene.glb --shadows NAME --json -o NAME.png", draw_techniques},
};

}  // namespace

Chapter later_chapter() {
  return {"After the four texts", "What has been thought of since, and all of it side by side.", kFigures};
}

}  // namespace laterna::app
