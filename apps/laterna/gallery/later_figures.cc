// What has come after the four documents: each of Laterna's techniques beside the others.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "paintings.h"
#include "sets.h"

namespace laterna::app {
namespace {

void draw_techniques(Sitting& sitting) {
  Shot shot = solids_set();
  add_morning_sun(shot.scene);
  sitting.techniques(shot);
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

/// Two boards in the sun, one far above the other; their shadows meet on the floor before them.
Shot two_boards() {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.15F);
  add_floor(scene, 5);
  const int boards =
      add_material(scene, "boards", glm::vec3(1), add_picture(scene, "boards", paint_boards(256)));
  add_object(scene, "low", box({-1.1F, 0.8F, -1.0F}, {1.1F, 0.84F, 0.2F}), boards);
  add_object(scene, "high", box({-1.8F, 5.0F, -4.6F}, {0, 5.04F, -2.4F}), boards);
  add_sun(scene, "sun", {{0, 3, -2.2}, {0, 0, 0}}, {0.95F, 0.90F, 0.80F});
  ShadowSettings& shadow = scene.lights.front().shadow;
  shadow.resolution = 512;
  shadow.blur = 6;
  shot.camera = {{0.5, 2.4, 3.6}, {0, 0.2, 0}};
  return shot;
}

/// The most of a light that arrives where a ray finds none, in the ray's picture or in any pixel near it: what is left
/// out is the blur of edges.
double most_bleeding(const Visibility& found, const Visibility& truth) {
  const int near = std::max(1, truth.width / 40);
  const auto at = [&](const Visibility& v, int x, int y) {
    return v.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(v.width) +
                    static_cast<std::size_t>(x)];
  };
  const auto is_deep_in_shadow = [&](int x, int y) {
    for (int j = std::max(y - near, 0); j <= std::min(y + near, truth.height - 1); ++j) {
      for (int i = std::max(x - near, 0); i <= std::min(x + near, truth.width - 1); ++i) {
        if (at(truth, i, j) > 0) return false;
      }
    }
    return true;
  };
  float most = 0;
  for (int y = 0; y < found.height; ++y) {
    for (int x = 0; x < found.width; ++x) {
      if (at(found, x, y) > most && is_deep_in_shadow(x, y)) most = at(found, x, y);
    }
  }
  return static_cast<double>(most);
}

void draw_bleeding(Sitting& sitting) {
  Shot shot = two_boards().with(ShadowTechnique::variance);
  const Visibility truth = sitting.visibility(shot.with(ShadowTechnique::raytraced), "sun");
  const auto show = [&](const char* what, ShadowMoments moments, float reduction) {
    ShadowSettings& shadow = shot.scene.lights.front().shadow;
    shadow.moments = moments;
    shadow.bleeding_reduction = reduction;
    const double most = most_bleeding(sitting.visibility(shot, "sun"), truth);
    sitting.picture(most > 0
                        ? fmt::format("{}: up to {:.2g} % of the light bleeds through.", what, 100 * most)
                        : fmt::format("{}: nothing bleeds through.", what),
                    shot);
  };
  show("Depth and its square, no reduction", ShadowMoments::variance, 0);
  show("The same, reduction 0.3", ShadowMoments::variance, 0.3F);
  show("Exponentials of depth, no reduction", ShadowMoments::exponential, 0);
  show("The same, reduction 0.2: the default", ShadowMoments::exponential, 0.2F);
  sitting.picture("Traced rays: where both boards stand before the sun it is dark.",
                  shot.with(ShadowTechnique::raytraced));
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
    {"bleeding", "Light that bleeds through two casters",
     "After Donnelly and Lauritzen 2006; the article's further reading",
     "A variance map holds the mean of depths and their spread. Where the edge of the far board's shadow "
     "crosses the "
     "near board's, the spread is large, and Chebyshev's inequality cannot rule out that light arrives: a "
     "bright seam "
     "within the shadow.",
     "Reduction cuts off what is below it, and darkens the outer half of soft edges with it; exponentials "
     "lose what is "
     "far behind instead, and bleed only where casters stand close together.",
     "\"shadow\": {\"technique\": \"variance\", \"moments\": \"variance\", \"bleeding_reduction\": 0.3}",
     draw_bleeding},
    {"stained-glass", "Stained glass", "What is see-through tints what it lets through",
     "Three panes. Where their shadows overlap, light has come through both, and is what each lets through "
     "of red, green "
     "and blue, multiplied.",
     "Glass here neither bends light nor focuses it.", "\"alphaMode\": \"BLEND\" in the glTF, nothing else",
     draw_glass},
    {"techniques", "Every technique, its cost and its error", "All of laterna render --list-techniques",
     "One scene and one sun. The numbers are those of laterna accuracy, against traced rays, with one sample "
     "per pixel; times are of this machine, all its threads together.",
     "What a number of pixels does not tell is where they are: look at the ring, the plinth and the "
     "contacts.",
     "laterna accuracy scene.glb --rig sun.json --techniques all --difference wrong.png", draw_techniques},
};

}  // namespace

Chapter later_chapter() {
  return {"After the four texts", "What has been thought of since, and all of it side by side.", kFigures};
}

}  // namespace laterna::app
