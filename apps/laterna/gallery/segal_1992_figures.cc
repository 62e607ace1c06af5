// Segal, Korobkin, van Widenfelt, Foran and Haeberli, Fast shadows and lighting effects using texture mapping, 1992.
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

constexpr Figure kFigures[] = {
    {"slide", "A slide projector", "Segal et al., figure 3",
     "A picture is treated as a slide and shone on arbitrary solids: perspective-correct, whatever stands in "
     "its way.",
     "Without shadows a slide paints through to hidden surfaces, as the paper's plain slide does.",
     "\"type\": \"projector\", \"slide\": \"lake.png\", \"yfov_deg\": 28", draw_slide},
    {"spotlight", "Shadow map and spotlight map", "Segal et al., figure 4",
     "The picture is what the spotlight throws, times what the shadow map lets through.", "",
     "\"type\": \"projector\", \"intensity_map\": \"star.png\"", draw_spotlight},
};

}  // namespace

Chapter segal_1992_chapter() {
  return {"Segal et al.: Fast Shadows and Lighting Effects Using Texture Mapping, 1992",
          "The look-up that slides, spotlights and shadow maps share.", kFigures};
}

}  // namespace laterna::app
