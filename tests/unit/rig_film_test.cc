// Films in rigs.
#include <gtest/gtest.h>

#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

constexpr const char* kStand = R"("type": "projector", "position": [0, 5, 0], "target": [0, 0, -5], )";

Result<Scene> load(const TemporaryFolder& folder, const std::vector<std::string>& lights) {
  std::string text = R"({"lights": [)";
  for (std::size_t i = 0; i < lights.size(); ++i)
    text += (i == 0 ? "\n{" : ",\n{") + std::string(kStand) + lights[i] + "}";
  return load_scene({}, {.rigs = {folder.write("r.json", text + "]}")}});
}

// Four pictures of 4 × 2.
void write_frames(const TemporaryFolder& folder) {
  for (const char* name : {"f.1.pgm", "f.2.pgm", "f.3.pgm", "f.4.pgm"})
    folder.write(name, std::string_view("P5 4 2 255\n........"));
}

TEST(RigFilm, KeysAndDefaults) {
  const TemporaryFolder folder;
  write_frames(folder);
  const Result<Scene> scene = load(
      folder,
      {R"("yfov_deg": 30, "film": "f.#.pgm")",
       R"("yfov_deg": 30, "film": "f.#.pgm", "fps": 12.5, "start": -3, "rate": 2, "at_end": "ping_pong")",
       R"("yfov_deg": 30, "film": "f.2.pgm", "at_end": "black")",
       R"("yfov_deg": 40, "film": "f.#.pgm", "at_end": "hold")"});
  ASSERT_TRUE(scene) << to_string(scene.error());
  ASSERT_EQ(scene->pictures.size(), 3U);  // the last is the first
  EXPECT_EQ(scene->pictures[0].file, folder / "f.#.pgm");
  EXPECT_EQ(scene->pictures[0].film, FilmTiming{});
  EXPECT_EQ(scene->pictures[1].film, (FilmTiming{12.5, -3, 2, AtEnd::ping_pong}));
  EXPECT_EQ(scene->pictures[2].film, (FilmTiming{24, 0, 1, AtEnd::black}));
  EXPECT_EQ(scene->lights[3].slide, 0);
}

// A horizontal field of view needs the film's shape.
TEST(RigFilm, HorizontalFieldOfView) {
  const TemporaryFolder folder;
  write_frames(folder);
  const Result<Scene> scene = load(folder, {R"("hfov_deg": 90, "film": "f.#.pgm")"});
  ASSERT_TRUE(scene) << to_string(scene.error());
  EXPECT_NEAR(scene->lights[0].projection.right, 1, 1e-12);
  EXPECT_NEAR(scene->lights[0].projection.top, 0.5, 1e-12);
}

TEST(RigFilm, FaultsAreLocated) {
  const TemporaryFolder folder;
  write_frames(folder);
  folder.write("slide.png", std::string_view("x"));
  const auto said = [&](const std::string& keys) {
    return messages_of(load(folder, {R"("yfov_deg": 30, )" + keys}), folder.path());
  };
  const std::string at = "r.json: line 2: lights[0].";
  EXPECT_EQ(said(R"("film": "f.#.pgm", "slide": "slide.png")"),
            at + "film: give either film or slide, not both");
  EXPECT_EQ(said(R"("slide": "slide.png", "fps": 25)"), at + "fps: belongs to a \"film\", and there is none");
  EXPECT_EQ(
      said(R"("film": "f.1.pgm", "fps": 25)"),
      at + "fps: has no effect: this file says itself how long its frames last; \"rate\" makes it faster");
  EXPECT_EQ(said(R"("film": "f.#.pgm", "fps": 0)"),
            at + "fps: expected a number greater than 0 and at most 1000000, got 0");
  EXPECT_EQ(said(R"("film": "f.#.pgm", "rate": -1)"),
            at + "rate: expected a number greater than 0 and at most 1000, got -1");
  EXPECT_EQ(said(R"("film": "f.#.pgm", "start": 2e6)"),
            at + "start: expected a number from -1000000 to 1000000, got 2000000");
  EXPECT_EQ(said(R"("film": "f.#.pgm", "at_end": "stop")"),
            at + "at_end: expected one of \"loop\", \"hold\", \"black\", \"ping_pong\", got \"stop\"");
  EXPECT_EQ(said(R"("film": "no.mp4")"), at + "film: \"no.mp4\" not found (tried \"no.mp4\")");
  EXPECT_EQ(said(R"("film": "")"), at + "film: the file name is empty");
}

TEST(RigFilm, ScenesBuiltInCode) {
  Scene scene;
  Picture film;
  film.file = "f.#.pgm";
  film.film = FilmTiming{0, 2e6, 0, static_cast<AtEnd>(9)};
  scene.pictures.push_back(film);
  scene.pictures.push_back({});
  scene.pictures.back().pixels = std::make_shared<Image>(1, 1, 3, PixelType::u8, Transfer::srgb);
  scene.pictures.back().film = FilmTiming{};
  Material screen;
  screen.base_color_texture.picture = 0;
  scene.materials.push_back(screen);
  std::string said;
  for (const Diagnostic& fault : validate(scene)) said += to_string(fault) + "\n";
  EXPECT_EQ(said,
            "pictures[0].film.frames_per_second: expected a number greater than 0, at most 1e+06, got 0\n"
            "pictures[0].film.rate: expected a number greater than 0, at most 1000, got 0\n"
            "pictures[0].film.start: expected a number from -1e+06 to 1e+06, got 2000000\n"
            "pictures[0].film.at_end: 9 is no value of the enumeration, which ends at 3\n"
            "pictures[1].film: is set, but the picture is no file\n"
            "materials[0].base_color_texture.picture: is a film; only a light's slide can be one\n");
}

}  // namespace
}  // namespace laterna
