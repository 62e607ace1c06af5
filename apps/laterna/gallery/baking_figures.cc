#include "baking_figures.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "laterna/bake.h"
#include "laterna/quake_surfaces.h"
#include "paintings.h"
#include "sitting.h"
#include "solids.h"

namespace laterna::app {
namespace {

constexpr double kQuakeDensity = 4;  // luxels per metre: a luxel to 25 cm, Quake's own is about 50
constexpr double kFineDensity = 96;
constexpr float kHalf = 3, kHeight = 3;  // of the room

void add_wall(Scene& scene, const char* name, glm::vec3 foot, glm::vec3 right, int material) {
  const glm::vec3 middle = foot + glm::vec3(0, kHeight / 2, 0);
  add_object(scene, name, rectangle(middle, right, {0, 1, 0}, {2 * kHalf, kHeight}, 1.5F), material);
}

// A cellar with crates under two lamps.
Shot cellar() {
  Shot shot;
  Scene& scene = shot.scene;
  const int boards =
      add_material(scene, "boards", glm::vec3(1), add_picture(scene, "boards", paint_boards(128)), 1);
  const int tiles =
      add_material(scene, "tiles", glm::vec3(0.9F), add_picture(scene, "tiles", paint_tiles(128)), 1);
  add_object(scene, "floor", rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {2 * kHalf, 2 * kHalf}, 1), tiles);
  add_wall(scene, "back", {0, 0, -kHalf}, {1, 0, 0}, boards);
  add_wall(scene, "left", {-kHalf, 0, 0}, {0, 0, -1}, boards);
  add_wall(scene, "right", {kHalf, 0, 0}, {0, 0, 1}, boards);
  add_object(scene, "crate", box({-1.8F, 0, -2}, {-0.8F, 1, -1}), boards);
  add_object(scene, "small crate", box({-1.5F, 1, -1.8F}, {-1, 1.5F, -1.3F}), boards);
  add_object(scene, "pillar", box({0.9F, 0, -1.6F}, {1.3F, kHeight, -1.2F}), tiles);
  add_lamp(scene, "lantern", {{2.4, 2.6, 1.6}, {-0.6, 0, -1.6}}, Angle::degrees(38), {1, 0.78F, 0.5F})
      .intensity = 0.9F;
  add_lamp(scene, "hatch", {{-0.6, 4.5, 1.2}, {-1, 0, -1.2}}, Angle::degrees(20), {0.6F, 0.75F, 1})
      .intensity = 0.8F;
  set_mood(scene, 0.05F);
  shot.camera = {{0.5, 1.7, 4.2}, {-0.2, 1, -1.5}};
  shot.yfov = Angle::degrees(50);
  return shot;
}

std::optional<BakedScene> bake(Sitting& sitting, const Shot& shot, double density) {
  BakeSettings settings;
  settings.density = density;
  return sitting.accept(bake_light(shot.scene, settings));
}

}  // namespace

void draw_quake(Sitting& sitting) {
  const Shot shot = cellar();
  const std::optional<BakedScene> baked = bake(sitting, shot, kQuakeDensity);
  const std::optional<Drawing> drawing = sitting.prepare(shot);
  if (!baked || !drawing) return;
  QuakeSettings settings;
  settings.width = drawing->settings.width;
  settings.height = drawing->settings.height;
  std::optional<QuakeWalk> walk = sitting.accept(QuakeWalk::create(baked->scene, settings));
  if (!walk) return;
  sitting.image("Textures alone.", walk->draw(drawing->view, QuakePicture::texture));
  sitting.image("Light maps alone: a byte for every 25 cm.",
                walk->draw(drawing->view, QuakePicture::light_map));
  sitting.image("The product, kept as combined surfaces.", walk->draw(drawing->view, QuakePicture::product));
  walk->draw(drawing->view, QuakePicture::product);
  const QuakeStatistics& statistics = walk->statistics();
  sitting.picture(
      fmt::format(
          "The lamps themselves. Of the {} surfaces that two of the pictures at the left asked for, {} were "
          "found in the cache, which holds {:.1f} MB.",
          statistics.asked, statistics.found, static_cast<double>(statistics.bytes) / (1 << 20)),
      shot);
}

void draw_baked(Sitting& sitting) {
  const Shot live = cellar();
  std::optional<BakedScene> baked = bake(sitting, live, kFineDensity);
  if (!baked) return;
  Shot still = live;
  still.scene = std::move(baked->scene);
  sitting.picture("Two lamps and their shadows.", live);
  sitting.picture(fmt::format("No lamps: {} luxels, {:.0f} to a metre.", baked->report.luxels, kFineDensity),
                  still);
  const std::optional<Drawing> lit = sitting.prepare(live), shown = sitting.prepare(still);
  if (!lit || !shown) return;
  const auto truth = sitting.accept(lit->renderer.render(lit->view, lit->settings)),
             copy = sitting.accept(shown->renderer.render(shown->view, shown->settings));
  if (!truth || !copy) return;
  const auto comparison = sitting.accept(compare_images(*copy, *truth, {}));
  if (!comparison) return;
  sitting.print(fmt::format("Where they differ, four times as bright: by the lamps' broad highlights, which "
                            "no light map holds, and "
                            "at the edges of shadows by a luxel. Root mean square {:.4f}.",
                            comparison->difference.rms_error),
                difference_picture(*copy, *truth, 4));
}

}  // namespace laterna::app
