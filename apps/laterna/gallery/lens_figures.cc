// What lenses do to slides, and slides that change: focus, throw and shift, films.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "contact_sheet.h"
#include "laterna/lens.h"
#include "paintings.h"
#include "sets.h"

namespace laterna::app {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---------------------------------------------------------------------------------------------- focus

constexpr double kFocus = 4;

/// Three boards at these distances from a projector that stands over the origin, each under a third of its slide.
constexpr std::array<double, 3> kBoards = {2.5, kFocus, 7};

Shot boards_in_the_beam() {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.12F);
  add_floor(scene, 24);
  const int white = add_material(scene, "board", glm::vec3(0.85F));
  for (int i = 0; i < 3; ++i) {
    const auto d = static_cast<float>(kBoards.at(static_cast<std::size_t>(i)));
    const float side = 0.3F * d;
    const glm::vec3 centre(side * static_cast<float>(i - 1), 1.2F, -d);
    add_object(scene, "board",
               box(centre - glm::vec3(side / 2, side / 2, 0.03F), centre + glm::vec3(side / 2, side / 2, 0)),
               white);
    add_object(
        scene, "post",
        box({centre.x - 0.03F, 0, centre.z - 0.03F}, {centre.x + 0.03F, centre.y - side / 2, centre.z}),
        white);
  }
  Light& lantern = add_projector(scene, "lantern", {{0, 1.2, 0}, {0, 1.2, -1}}, Angle::degrees(30),
                                 add_picture(scene, "chart", paint_focus_chart(1536, 512)));
  lantern.projection = Projection::from_throw_ratio(1 / 0.9, 3, 0.1, kInfinity);
  lantern.color = glm::vec3(1.1F);
  lantern.aperture = {0.06, kFocus};
  shot.camera = {{0.25, 1.95, 1.0}, {0.12, 1.22, -3}};
  shot.yfov = Angle::degrees(25);
  shot.settings.width = 960;
  shot.settings.height = 400;
  return shot;
}

/// Root of the mean square of the difference of two pictures, over R, G and B.
double rms_difference(const LayeredImage& a, const LayeredImage& b) {
  double sum = 0;
  std::size_t count = 0;
  for (const char* name : {"R", "G", "B"}) {
    const Channel* x = a.find(name);
    const Channel* y = b.find(name);
    for (std::size_t i = 0; i < x->values.size(); ++i, ++count) {
      const auto difference = static_cast<double>(x->values[i]) - static_cast<double>(y->values[i]);
      sum += difference * difference;
    }
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
}

/// Pixels and metres of the pictures of discs.
constexpr int kDiscSide = 320;
constexpr double kDiscMetres = 0.32;
/// The slide is 1 / kDotThrow of the distance wide, and its dot that share of it.
constexpr double kDotThrow = 6;
constexpr float kDotShare = 1.0F / 48;

/// The disc that a point of the slide becomes on a wall square to the axis, `distance` metres from the lens.
std::optional<LayeredImage> picture_of_disc(Sitting& sitting, double distance, int accumulate) {
  Shot shot;
  shot.camera = {{0, 0, 0}, {0, 0, -1}};
  add_object(shot.scene, "wall",
             rectangle({0, 0, static_cast<float>(-distance)}, {1, 0, 0}, {0, 1, 0}, {2, 2}, 1),
             add_material(shot.scene, "white", glm::vec3(1)));
  Light& lantern = add_projector(shot.scene, "lantern", {{0, 0, 0}, {0, 0, -1}}, Angle::degrees(10),
                                 add_picture(shot.scene, "dot", paint_dot(1024, kDotShare)));
  lantern.projection = Projection::from_throw_ratio(kDotThrow, 1, 0.1, kInfinity);
  lantern.aperture = {0.1, kFocus};
  const std::optional<Drawing> drawing = sitting.prepare(shot);
  if (!drawing) return std::nullopt;
  RenderSettings settings = drawing->settings;
  settings.width = settings.height = kDiscSide;
  settings.samples = 1;
  settings.accumulate = accumulate;
  const View square_on = {Pose(),
                          Projection::orthographic(kDiscMetres / 2, kDiscMetres / 2, 0, 2 * distance)};
  return sitting.accept(drawing->renderer.render(square_on, settings));
}

/// The diameter of the disc over which the light of the dot is spread, in metres: over a disc of diameter D the square of
/// the distance from the middle is D²/8 in the mean, and the dot's own size adds its own.
double diameter_of_disc(const LayeredImage& picture, double dot_metres) {
  const std::vector<float>& green = picture.find("G")->values;
  double light = 0;
  double moment = 0;
  for (int y = 0; y < kDiscSide; ++y) {
    for (int x = 0; x < kDiscSide; ++x) {
      const auto value = static_cast<double>(green[static_cast<std::size_t>(y * kDiscSide + x)]);
      const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) * (kDiscMetres / kDiscSide) - kDiscMetres / 2;
      light += value;
      moment += value * glm::dot(place, place);
    }
  }
  return std::sqrt(std::max(8 * moment / light - dot_metres * dot_metres, 0.0));
}

/// As bright as the eye wants it: the same light is spread over discs of different sizes.
LayeredImage evened(LayeredImage picture) {
  for (Channel& channel : picture.channels) {
    if (channel.name == "A") continue;
    const float most = *std::ranges::max_element(channel.values);
    for (float& value : channel.values) value = most > 0 ? 0.8F * value / most : 0;
  }
  return picture;
}

void draw_discs(Sitting& sitting) {
  std::vector<std::vector<LayeredImage>> rows(2);
  std::array<std::string, 2> measured;
  std::string expected;
  for (const double distance : {2.5, 6.0, 8.0}) {
    expected += fmt::format("{}{:.0f} mm", expected.empty() ? "" : ", ",
                            1000 * 2 * 0.1 * std::abs(distance - kFocus) / kFocus);
    for (std::size_t way = 0; way < 2; ++way) {
      const std::optional<LayeredImage> disc = picture_of_disc(sitting, distance, way == 0 ? 1 : 256);
      if (!disc) return;
      measured.at(way) +=
          fmt::format("{}{:.0f}", measured.at(way).empty() ? "" : ", ",
                      1000 * diameter_of_disc(*disc, static_cast<double>(kDotShare) * distance / kDotThrow));
      rows[way].push_back(evened(*disc));
    }
  }
  sitting.print(
      fmt::format(
          "A point of the slide on walls 2.5, 6 and 8 m away, through a lens of 10 cm radius focused at 4 m. "
          "Above by discs: {} mm wide; below the mean over 256 points of the lens: {} "
          "mm. "
          "2 R |d - f| / f is {}. Each picture is 32 cm wide, and as bright as the next.",
          measured[0], measured[1], expected),
      contact_sheet(rows));
}

void draw_focus(Sitting& sitting) {
  const Shot fast = boards_in_the_beam();
  Shot sharp = fast;
  sharp.scene.lights.front().aperture = {};
  Shot truth = fast;
  truth.settings.samples = 1;
  truth.settings.accumulate = 64;
  truth.settings.shadows = ShadowTechnique::exact;
  sitting.picture("A pinhole: sharp on boards at 2.5, 4 and 7 m.", sharp);
  sitting.picture("A lens of 6 cm radius focused at 4 m, by discs of the slide: the default.", fast);
  const std::optional<Drawing> by_discs = sitting.prepare(fast);
  const std::optional<Drawing> by_points = sitting.prepare(truth);
  if (!by_discs || !by_points) return;
  const auto a = sitting.accept(by_discs->renderer.render(by_discs->view, by_discs->settings));
  auto b = sitting.accept(by_points->renderer.render(by_points->view, by_points->settings));
  if (!a || !b) return;
  const std::string caption = fmt::format(
      "The mean over 64 points of the lens, with exact shadows: the truth. The picture above differs "
      "from it by {:.4f} of white (root mean square).",
      rms_difference(*a, *b));
  sitting.print(caption, std::move(*b));
  draw_discs(sitting);
}

// ---------------------------------------------------------------------------------------------- throw and shift

/// A table with a projector on it, 3 m before a wall.
struct ThrownGrid {
  double throw_ratio = 1.5;
  glm::dvec2 shift{0};
  LensDistortion lens;
};

Shot room_with_projector(const ThrownGrid& wanted) {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.10F);
  add_floor(scene, 10);
  add_object(scene, "wall", rectangle({0, 1.6F, -3}, {1, 0, 0}, {0, 1, 0}, {9, 3.2F}, 1),
             add_material(scene, "whitewash", glm::vec3(0.8F)));
  const int boards =
      add_material(scene, "boards", glm::vec3(1), add_picture(scene, "boards", paint_boards(128)));
  Primitive table = box({-0.45F, 0.82F, -0.1F}, {0.45F, 0.88F, 0.6F});
  for (const float x : {-0.4F, 0.4F}) append(table, box({x - 0.03F, 0, 0}, {x + 0.03F, 0.82F, 0.06F}));
  for (const float x : {-0.4F, 0.4F}) append(table, box({x - 0.03F, 0, 0.5F}, {x + 0.03F, 0.82F, 0.56F}));
  add_object(scene, "table", table, boards);
  add_object(scene, "housing", box({-0.16F, 0.89F, 0.02F}, {0.16F, 1.03F, 0.4F}),
             add_material(scene, "housing", glm::vec3(0.15F)));
  const Image grid = paint_grid(1024, 576, [](glm::vec2 place) { return place; });
  Light& lantern = add_projector(scene, "lantern", {{0, 0.96, 0}, {0, 0.96, -1}}, Angle::degrees(30),
                                 add_picture(scene, "grid", grid));
  lantern.aspect_from_slide = false;
  lantern.projection = Projection::from_throw_ratio(wanted.throw_ratio, 16.0 / 9, 0.1, kInfinity)
                           .shifted(wanted.shift.x, wanted.shift.y);
  lantern.distortion = wanted.lens;
  lantern.color = glm::vec3(1.1F);
  shot.camera = {{2.5, 2.2, 2.9}, {-0.25, 1.05, -1.9}};
  shot.yfov = Angle::degrees(42);
  return shot;
}

/// Width of the picture on the wall along its middle row, and the heights of its lower and upper side there, in metres.
std::string size_on_wall(Sitting& sitting, const Shot& shot) {
  const std::optional<Drawing> drawing = sitting.prepare(shot);
  if (!drawing) return {};
  const auto on_wall = [&](double s, double t) {
    return sitting.accept(drawing->renderer.world_from_slide("lantern", {s, t}, 3)).value_or(glm::dvec3(0));
  };
  return fmt::format("It is {:.2f} m wide, from {:.2f} to {:.2f} m above the floor",
                     on_wall(1, 0.5).x - on_wall(0, 0.5).x, on_wall(0.5, 1).y, on_wall(0.5, 0).y);
}

void draw_throw(Sitting& sitting) {
  const auto show = [&](const char* what, const ThrownGrid& wanted) {
    const Shot shot = room_with_projector(wanted);
    sitting.picture(fmt::format("{}. {}.", what, size_on_wall(sitting, shot)), shot);
  };
  show("Throw ratio 1.5 at 3 m, no shift", {});
  show("The same, shifted up by half its height: the lower side is as high as the lens", {1.5, {0, 0.5}, {}});
  show("Throw ratio 1.0, shifted by 0.3 widths to the right and half a height up", {1.0, {0.3, 0.5}, {}});
  show("A barrel: k1 = +0.25", {1.5, {0, 0.5}, {.k1 = 0.25}});
  show("A pincushion: k1 = -0.25", {1.5, {0, 0.5}, {.k1 = -0.25}});
  show("A lens that sits askew: p1 = 0.03, p2 = -0.03", {1.5, {0, 0.5}, {.p1 = 0.03, .p2 = -0.03}});
}

// ---------------------------------------------------------------------------------------------- films

constexpr int kFilmFrames = 5;

/// The film's frames as files, for as long as the figure is drawn.
class FilmFiles {
 public:
  explicit FilmFiles(Sitting& sitting) : folder_(sitting.folder()) {
    for (int k = 0; k < kFilmFrames; ++k) {
      frames_.push_back(paint_leader(256, 192, k, kFilmFrames));
      if (const Result<void> written = write_image(frames_.back(), file(k)); !written)
        sitting.accept(Result<int>(tl::unexpected(written.error())));
    }
  }
  ~FilmFiles() {
    std::error_code ignored;
    for (int k = 0; k < kFilmFrames; ++k) std::filesystem::remove(file(k), ignored);
  }
  FilmFiles(const FilmFiles&) = delete;
  FilmFiles& operator=(const FilmFiles&) = delete;

  [[nodiscard]] std::filesystem::path pattern() const { return folder_ / "films-frame.#.png"; }

 private:
  [[nodiscard]] std::filesystem::path file(int k) const {
    return folder_ / fmt::format("films-frame.{}.png", k);
  }
  std::filesystem::path folder_;
  std::vector<Image> frames_;
};

/// A screen, and before it a ball that stands in the film's light.
Shot cinema(const std::filesystem::path& film, AtEnd at_end) {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.10F);
  add_floor(scene, 8);
  add_object(scene, "screen", box({-1.2F, 0.25F, -1.1F}, {1.2F, 2.05F, -1.05F}),
             add_material(scene, "screen", glm::vec3(0.85F)));
  add_object(scene, "ball", ball({0.75F, 0.3F, -0.35F}, 0.3F),
             add_material(scene, "clay", {0.62F, 0.24F, 0.12F}));
  Picture picture;
  picture.name = film.string();
  picture.file = film;
  picture.film = FilmTiming{.frames_per_second = 1, .start = 0, .rate = 1, .at_end = at_end};
  scene.pictures.push_back(picture);
  Light& lantern = add_projector(scene, "cinema", {{0.4, 1.35, 4}, {0, 1.15, -1}}, Angle::degrees(19.5),
                                 static_cast<int>(scene.pictures.size()) - 1);
  lantern.color = glm::vec3(1.05F);
  shot.camera = {{-0.7, 1.6, 3.2}, {0.05, 1.05, -1}};
  shot.settings.width = 160;
  shot.settings.height = 120;
  return shot;
}

/// The stage at 0, 1, 2, … seconds.
std::vector<LayeredImage> row_of_time(Sitting& sitting, const Shot& shot) {
  std::vector<LayeredImage> row;
  std::optional<Drawing> drawing = sitting.prepare(shot);
  if (!drawing) return row;
  constexpr int kSeconds = 9;
  for (int second = 0; second < kSeconds; ++second) {
    if (!sitting.accept(drawing->renderer.set_time(second))) return row;
    std::optional<LayeredImage> picture =
        sitting.accept(drawing->renderer.render(drawing->view, drawing->settings));
    if (!picture) return row;
    row.push_back(std::move(*picture));
  }
  return row;
}

void draw_films(Sitting& sitting) {
  const FilmFiles film(sitting);
  std::vector<std::vector<LayeredImage>> rows;
  for (const AtEnd at_end : {AtEnd::hold, AtEnd::loop, AtEnd::ping_pong, AtEnd::black})
    rows.push_back(row_of_time(sitting, cinema(film.pattern(), at_end)));
  sitting.print(
      "A film of five frames, one each second, at 0, 1, ... 8 s. What follows its end, from the top: hold, "
      "loop, "
      "ping_pong, black. As many dots as frames have been shown, the hand at that part of the dial.",
      contact_sheet(rows));
  Shot close = cinema(film.pattern(), AtEnd::hold);
  close.settings.width = 640;
  close.settings.height = 480;
  std::optional<Drawing> drawing = sitting.prepare(close);
  if (!drawing || !sitting.accept(drawing->renderer.set_time(3.5))) return;
  sitting.print(
      "At 3.5 s: the last frame that has begun is the fourth. What stands in the beam wears the film.",
      drawing->renderer.render(drawing->view, drawing->settings));
}

constexpr Figure kFigures[] = {
    {"focus", "A lens that is open", "After Haeberli and Akeley 1990",
     "An open lens throws a sharp slide at one distance only. Nearer and farther each of its points is a "
     "disc, "
     "and the disc's width follows from the lens and the distances alone.",
     "The fast way blurs slide and shadow apart: where a shadow's edge crosses something in the slide it is "
     "off.",
     "\"aperture_radius\": 0.06, \"focus\": 4 in the projector; --accumulate 64 for the truth", draw_focus},
    {"throw", "Throw ratio, lens shift, barrels and pincushions", "What data sheets and calibrations say",
     "Throw ratio is distance over width. Shift moves the picture by fractions of its own size without "
     "keystone. "
     "OpenCV's coefficients bend its lines.",
     "Distortion that folds the picture over is refused with the angle of the fold.",
     "\"throw_ratio\": 1.5, \"lens_shift\": [0, 0.5], \"distortion\": {\"k1\": 0.25}\n"
     "laterna info scene.glb --rig rig.json     # where its picture lands, and how large it is",
     draw_throw},
    {"films", "Films, and what follows their end", "Slides that change with time",
     "Numbered pictures, GIFs and videos are slides with a clock. Frame k is the same picture whether it is "
     "drawn "
     "alone or in a series.",
     "",
     "\"film\": \"leader.####.png\", \"fps\": 1, \"at_end\": \"ping_pong\"\n"
     "laterna render scene.glb --rig film.json --frames 0:99 --fps 25 -o out.####.png",
     draw_films},
};

}  // namespace

Chapter lens_chapter() {
  return {"Lenses and films",
          "The projector as a physical thing: its lens, where its picture lands, and slides that move.",
          kFigures};
}

}  // namespace laterna::app
