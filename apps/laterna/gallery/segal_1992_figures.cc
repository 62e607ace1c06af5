// Segal, Korobkin, van Widenfelt, Foran and Haeberli, Fast shadows and lighting effects using texture mapping, 1992.
#include <glm/geometric.hpp>

#include "paintings.h"
#include "sets.h"

namespace laterna::app {
namespace {

/// Solids before a wall.
Shot stage_set() {
  Shot shot = solids_set();
  Scene& scene = shot.scene;
  scene.ambient = glm::vec3(0.07F);
  add_object(scene, "wall", rectangle({0, 2, -1.3F}, {1, 0, 0}, {0, 1, 0}, {14, 4}, 1),
             add_material(scene, "whitewash", glm::vec3(0.8F)));
  shot.camera = {{1.0, 1.9, 4.6}, {0.0, 0.75, -0.4}};
  return shot;
}

void draw_slide(Sitting& sitting) {
  Shot shot = stage_set();
  const Image slide = paint_lake(768, 512);
  const int picture = add_picture(shot.scene, "lake", slide);
  Light& lantern = add_projector(shot.scene, "lantern", {{-1.6, 1.5, 3.9}, {-0.1, 0.85, -1.0}},
                                 Angle::degrees(28), picture);
  lantern.color = glm::vec3(2.2F);
  sitting.image("The slide.", slide);
  sitting.picture("Thrown on the scene, through everything: shadows are a separate matter.",
                  shot.with(ShadowTechnique::none));
  sitting.picture("With shadows: the slide is on lit regions only.", shot);
}

void draw_spotlight(Sitting& sitting) {
  Shot shot = stage_set();
  const Image map = paint_star(256);
  const int picture = add_picture(shot.scene, "star", map);
  Light& star =
      add_projector(shot.scene, "star", {{-1.0, 2.2, 3.8}, {-0.05, 0.62, -0.9}}, Angle::degrees(40), picture);
  star.slide_is_intensity = true;
  star.color = {1.5F, 1.34F, 1.08F};
  sitting.depth_map("The shadow map.", shot, "star");
  sitting.image("The intensity map of the spotlight.", map);
  sitting.picture("Both at work.", shot);
}

// "Distortion effects, such as those attributed to a shield or a lens, may be incorporated into the texture map image"
// (section 3.2); or into the lens.
void draw_lens(Sitting& sitting) {
  const LensDistortion barrel{.k1 = -0.2};
  const Projection frame = Projection::from_throw_ratio(0.8, 16.0 / 9, 0.1, 100);
  const glm::dvec2 size(frame.right - frame.left, frame.top - frame.bottom);
  const auto throw_slide = [&](const Image& slide, const LensDistortion& lens) {
    Shot shot;
    add_object(shot.scene, "wall", rectangle({0, 1.1F, 0}, {1, 0, 0}, {0, 1, 0}, {8, 5}, 1),
               add_material(shot.scene, "whitewash", glm::vec3(0.8F)));
    set_mood(shot.scene, 0.05F);
    Light& lantern = add_projector(shot.scene, "lantern", {{0, 1.1, 2}, {0, 1.1, 0}}, Angle::degrees(30),
                                   add_picture(shot.scene, "grid", slide));
    lantern.projection = frame;
    lantern.aspect_from_slide = false;
    lantern.distortion = lens;
    lantern.color = glm::vec3(1.2F);
    shot.camera = {{0, 1.1, 5.2}, {0, 1.1, 0}};
    return shot;
  };
  const Image straight = paint_grid(1024, 576, [](glm::vec2 place) { return place; });
  const Image bent = paint_grid(1024, 576, [&](glm::vec2 place) {
    // r (1 + k1 r²) solved for r as OpenCV does it.
    const glm::dvec2 seen = (glm::dvec2(place) - 0.5) * size;
    glm::dvec2 ideal = seen;
    for (int i = 0; i < 16; ++i) ideal = seen / (1 + barrel.k1 * glm::dot(ideal, ideal));
    return glm::vec2(ideal / size + 0.5);
  });
  sitting.picture("A slide of straight lines, through an ideal lens.", throw_slide(straight, {}));
  sitting.picture("The distortion held in the slide: the grid as a camera with k1 = -0.2 sees it. A barrel.",
                  throw_slide(bent, {}));
  sitting.picture("The distortion in the lens: straight lines through a lens with k1 = -0.2. A pincushion.",
                  throw_slide(straight, barrel));
  sitting.picture("Both: what such a lens has bent, it straightens.", throw_slide(bent, barrel));
}

constexpr Figure kFigures[] = {
    {"slide", "A slide projector", "Segal et al., figure 3",
     "A picture is treated as a slide and shone on arbitrary solids: perspective-correct, whatever stands in "
     "its way.",
     "Without shadows a slide paints through to hidden surfaces, as the paper's plain slide does.",
     "\"type\": \"projector\", \"slide\": \"lake.png\", \"yfov_deg\": 28", draw_slide},
    {"spotlight", "Shadow map and spotlight map", "Segal et al., figure 4",
     "The picture is what the spotlight throws, times what the shadow map lets through.", "",
     "\"type\": \"projector\", \"intensity_map\": \"star.png\"", draw_spotlight},
    {"lens", "A lens that distorts, and a slide that does", "Segal et al., section 3.2",
     "Distortion may be painted into the slide, or be the lens's, by OpenCV's coefficients. One undoes the "
     "other.",
     "Where a lens bends so much that it folds the picture over, part of the slide would be thrown nowhere: "
     "that is "
     "an error.",
     "\"type\": \"projector\", \"slide\": \"grid.png\", \"throw_ratio\": 0.8, \"distortion\": {\"k1\": -0.2}",
     draw_lens},
};

}  // namespace

Chapter segal_1992_chapter() {
  return {"Segal et al.: Fast Shadows and Lighting Effects Using Texture Mapping, 1992",
          "The look-up that slides, spotlights and shadow maps share.", kFigures};
}

}  // namespace laterna::app
