// Photographs thrown back through their cameras, of a house whose true look is known.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../camera_path.h"
#include "contact_sheet.h"
#include "laterna/measure.h"
#include "paintings.h"
#include "sets.h"

namespace laterna::app {
namespace {

/// A house 8 m wide and 6 m high, with balconies, a chimney-like pillar and a wing. `is_painted`: as it looks; otherwise
/// the bare geometry.
Shot house(bool is_painted) {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.35F);
  const auto look = [&](const char* name, glm::vec3 color, int texture = -1) {
    return add_material(scene, name, is_painted ? color : glm::vec3(0.75F), is_painted ? texture : -1);
  };
  const int front = look("front", glm::vec3(1), add_picture(scene, "front", paint_house_front(1024, 768)));
  // The texture is a tile as high as the house; its picture is 4 : 3 like it.
  Primitive wall = rectangle({0, 3, 0}, {1, 0, 0}, {0, 1, 0}, {8, 6}, 1);
  wall.uv[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  add_object(scene, "wall", wall, front);
  add_object(scene, "left balcony", box({-3.0F, 2.05F, 0}, {-1.0F, 2.2F, 0.9F}),
             look("stone", {0.62F, 0.60F, 0.56F}));
  add_object(scene, "right balcony", box({1.0F, 4.05F, 0}, {3.0F, 4.2F, 0.9F}),
             look("stone", {0.62F, 0.60F, 0.56F}));
  add_object(scene, "pillar", box({-0.18F, 0, 1.0F}, {0.18F, 4.4F, 1.36F}),
             look("brick", {0.55F, 0.22F, 0.14F}));
  add_object(scene, "wing", box({3.0F, 0, 0}, {4.0F, 4.0F, 2.2F}), look("wing", {0.50F, 0.56F, 0.44F}));
  add_object(scene, "ground", rectangle({0, 0, 4}, {1, 0, 0}, {0, 0, -1}, {14, 8}, 2),
             look("paving", glm::vec3(1), add_picture(scene, "paving", paint_tiles(256))));
  add_sun(scene, "sun", {{4, 8, 7}, {0, 0, 0}}, {0.75F, 0.70F, 0.62F});
  shot.camera = {{0.2, 3.0, 9.6}, {0, 2.9, 0}};
  shot.yfov = Angle::degrees(46);
  return shot;
}

constexpr int kPhotoWidth = 960, kPhotoHeight = 720;

struct Stand {
  const char* name;
  Gaze gaze;
};
constexpr std::array<Stand, 2> kStands = {
    {{"left", {{-4.6, 2.2, 8.4}, {0.1, 2.9, 0}}}, {"right", {{4.4, 3.6, 8.2}, {-0.1, 2.9, 0}}}}};

/// Takes a photograph of the house and adds it to the bare one.
std::optional<LayeredImage> photograph(Sitting& sitting, const Stand& stand, Scene& bare) {
  Shot truth = house(true);
  truth.camera = stand.gaze;
  const std::optional<Drawing> drawing = sitting.prepare(truth);
  if (!drawing) return std::nullopt;
  RenderSettings settings = drawing->settings;
  settings.width = kPhotoWidth;
  settings.height = kPhotoHeight;
  View view = drawing->view;
  view.projection =
      Projection::perspective(truth.yfov, static_cast<double>(kPhotoWidth) / kPhotoHeight, 0.05, 1000);
  std::optional<LayeredImage> taken = sitting.accept(drawing->renderer.render(view, settings));
  if (!taken) return std::nullopt;
  Image pixels(kPhotoWidth, kPhotoHeight, 3, PixelType::f32, Transfer::linear);
  const std::span<float> values = pixels.values<float>();
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<float>& channel = taken->find(std::array{"R", "G", "B"}.at(c))->values;
    for (std::size_t i = 0; i < channel.size(); ++i) values[3 * i + c] = channel[i];
  }
  bare.photographs.push_back({stand.name, add_picture(bare, stand.name, std::move(pixels)), view.pose,
                              view.projection, glm::vec3(1)});
  return taken;
}

/// Of the pixels that a photograph sees: 10 log10 (1 / mean square) of the difference, in decibels. Both in linear light.
double seen_psnr(const LayeredImage& a, const LayeredImage& b) {
  const std::vector<float>& seen = a.find("photo.seen")->values;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i] <= 0) continue;
    for (const char* name : {"R", "G", "B"}) {
      const double d =
          static_cast<double>(a.find(name)->values[i]) - static_cast<double>(b.find(name)->values[i]);
      sum += d * d;
      ++count;
    }
  }
  return count == 0 || sum == 0 ? 99 : -10 * std::log10(sum / static_cast<double>(count));
}

/// Share of the surface that no photograph sees, and where: black, what is seen white.
struct Unseen {
  double percent = 0;
  LayeredImage mask;
};
Unseen find_unseen(const LayeredImage& image) {
  Unseen unseen;
  unseen.mask.width = image.width;
  unseen.mask.height = image.height;
  std::vector<float> white;
  std::size_t surface = 0;
  for (const float seen : image.find("photo.seen")->values) {
    surface += seen >= 0 ? 1U : 0U;
    unseen.percent += seen == 0 ? 1 : 0;
    white.push_back(seen == 0 ? 0.0F : 1.0F);
  }
  if (surface > 0) unseen.percent *= 100 / static_cast<double>(surface);
  for (const char* name : {"R", "G", "B"}) unseen.mask.channels.push_back({name, white});
  return unseen;
}

/// Colours between the two photographs' cameras, five on the way.
void draw_fly_by(Sitting& sitting, const Drawing& drawing) {
  std::vector<View> stops;
  for (const Photograph& photograph : drawing.renderer.scene().photographs)
    stops.push_back({photograph.pose, photograph.projection});
  RenderSettings settings = drawing.settings;
  settings.width = std::max(1, settings.width * 3 / 8);
  settings.height = std::max(1, settings.height * 3 / 8);
  std::vector<LayeredImage> frames;
  for (int frame = 0; frame < 5; ++frame) {
    auto picture = sitting.accept(drawing.renderer.render(view_on_path(stops, frame / 4.0), settings));
    if (!picture) return;
    frames.push_back(std::move(*picture));
  }
  sitting.print("A flight from the one camera to the other.", contact_sheet({frames}));
}

void draw_photographs(Sitting& sitting) {
  Shot bare = house(false);
  sitting.picture("The geometry alone.", bare);
  std::vector<LayeredImage> taken;
  for (const Stand& stand : kStands) {
    std::optional<LayeredImage> photo = photograph(sitting, stand, bare.scene);
    if (!photo) return;
    taken.push_back(std::move(*photo));
  }
  for (std::size_t i = 0; i < taken.size(); ++i)
    sitting.print(fmt::format("A photograph of the house, taken from the {}.", kStands.at(i).name), taken[i]);
  bare.scene.photograph_settings.unseen = {0.5F, 0.02F, 0.35F};
  bare.settings.layers = {Layer::photographs};
  const std::optional<Drawing> thrown = sitting.prepare(bare);
  const std::optional<Drawing> true_one = sitting.prepare(house(true));
  if (!thrown || !true_one) return;
  const auto picture = sitting.accept(thrown->renderer.render(thrown->view, thrown->settings));
  const auto truth = sitting.accept(true_one->renderer.render(true_one->view, true_one->settings));
  const Photograph& first = thrown->renderer.scene().photographs.front();
  RenderSettings own = thrown->settings;
  own.width = kPhotoWidth;
  own.height = kPhotoHeight;
  own.samples = 1;
  const auto again = sitting.accept(thrown->renderer.render({first.pose, first.projection}, own));
  if (!picture || !truth || !again) return;
  const Unseen unseen = find_unseen(*picture);
  sitting.print(
      fmt::format("Both thrown back, seen from between them, where neither was taken; purple is what neither "
                  "saw. Seen from the left one's own camera it equals that photograph at {:.0f} dB.",
                  seen_psnr(*again, taken.front())),
      *picture);
  sitting.print(
      fmt::format(
          "The house as it truly looks from there: the picture before is within {:.1f} dB of it where "
          "anything is seen.",
          seen_psnr(*picture, *truth)),
      *truth);
  sitting.print(
      fmt::format("Black: the {:.1f} % of the surface that no photograph sees, behind the pillar or the wing "
                  "from each.",
                  unseen.percent),
      unseen.mask);
  draw_fly_by(sitting, *thrown);
}

constexpr Figure kFigures[] = {
    {"photographs", "Photographs thrown back",
     "Segal et al., section 3.2, used backward; after Debevec et al. 1996",
     "A photograph is a slide of what its camera saw. Thrown back through that camera on the geometry it "
     "becomes the "
     "surfaces' own colour; hidden surfaces are never painted, and what no photograph saw is marked.",
     "The light of the day is in the photographs. Where geometry is wrong, two photographs of one detail do "
     "not meet.",
     "laterna photo mesh.ply --cameras sparse/ --photos images/ -o view.png --mask seen.png\n"
     "laterna photo mesh.ply --cameras sparse/ --photos images/ -o frame.####.png --fly all",
     draw_photographs},
};

}  // namespace

Chapter photograph_chapter() {
  return {"Photographs", "A camera's picture carried back to the surfaces that it shows.", kFigures};
}

}  // namespace laterna::app
