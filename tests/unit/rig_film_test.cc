// Films in rigs.
#include <gtest/gtest.h>

#include <array>

#include "laterna/render.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

constexpr const char* kStandOfFilm = R"("type": "projector", "position": [0, 5, 0], "target": [0, 0, -5], )";

Result<Scene> load(const TemporaryFolder& folder, const std::vector<std::string>& lights) {
  std::string text = R"({"lights": [)";
  for (std::size_t i = 0; i < lights.size(); ++i)
    text += (i == 0 ? "\n{" : ",\n{") + std::string(kStandOfFilm) + lights[i] + "}";
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

// A file whose own name has a # or %d in it is what was meant, before any pattern.
TEST(RigFilm, NamesThatLookLikePatterns) {
  const TemporaryFolder folder;
  for (const char* name : {"night#1.pgm", "half%d.pgm"}) {
    folder.write(name, std::string_view("P5 4 2 255\n........"));
    EXPECT_FALSE(is_numbered(folder / name));
    const Result<Scene> scene = load(folder, {R"("yfov_deg": 30, "film": ")" + std::string(name) + '"'});
    ASSERT_TRUE(scene) << to_string(scene.error());
    const Result<FilmHeader> header = read_film_header(scene->pictures[0].file);
    ASSERT_TRUE(header) << to_string(header.error());
    EXPECT_EQ(header->frames, 1U);
  }
  EXPECT_TRUE(is_numbered(folder / "night#.pgm"));
}

TEST(RigFilm, WhichFrameIsShown) {
  const TemporaryFolder folder;
  write_frames(folder);
  const FilmTiming timing{.frames_per_second = 2, .start = 1, .rate = 1, .at_end = AtEnd::black};
  const auto shown = [&](double time) { return find_film_frame(folder / "f.#.pgm", timing, time).value(); };
  EXPECT_EQ(shown(0.9), std::nullopt);
  EXPECT_EQ(shown(1), 0U);
  EXPECT_EQ(shown(2.4), 2U);
  EXPECT_EQ(shown(3.1), std::nullopt);
  EXPECT_FALSE(find_film_frame(folder / "g.#.pgm", timing, 0));
}

// A film given as a slide: the message says where it belongs.
TEST(RigFilm, AVideoAsASlide) {
  const TemporaryFolder folder;
  const std::array<std::pair<const char*, std::string>, 3> files = {
      {{"clip.mp4", std::string("\0\0\0\x20", 4) + "ftypisom........"},
       {"clip.mkv", "\x1a\x45\xdf\xa3............"},
       {"clip.avi", "RIFF....AVI LIST...."}}};
  for (const auto& [name, content] : files) {
    folder.write(name, std::string_view(content));
    const std::string said =
        messages_of(load(folder, {R"("hfov_deg": 30, "slide": ")" + std::string(name) + '"'}), folder.path());
    EXPECT_EQ(said.rfind("r.json: line 2: lights[0].slide: " + std::string(name) + ": expected a PNG", 0), 0U)
        << said;
    EXPECT_NE(said.find("film: a rig's \"film\" takes it, not its \"slide\""), std::string::npos) << said;
  }
}

// A film that ends early is told of when it becomes a light's slide later, once.
TEST(RigFilm, WarningsOfAFilmThatASlideBecomes) {
  const TemporaryFolder folder;
  // A GIF of one pixel whose second frame is cut off.
  const std::string gif("GIF89a\1\0\1\0\x80\0\0\0\0\0\xff\xff\xff\x2c\0\0\0\0\1\0\1\0\0\2\2D\1\0\x2c\0\0",
                        37);
  folder.write("cut.gif", std::string_view(gif));
  Result<Scene> scene = load(folder, {R"("yfov_deg": 30)"});
  ASSERT_TRUE(scene) << to_string(scene.error());
  Picture film;
  film.name = "cut.gif";
  film.file = folder / "cut.gif";
  film.film = FilmTiming{};
  scene->pictures.push_back(film);
  Result<Renderer> renderer = Renderer::create(*scene);
  ASSERT_TRUE(renderer) << to_string(renderer.error());
  const std::size_t before = renderer->scene().warnings.size();
  Light light = renderer->scene().lights[0];
  light.slide = 0;
  const Result<void> set = renderer->set_light(0, light);
  ASSERT_TRUE(set) << to_string(set.error());
  ASSERT_EQ(renderer->scene().warnings.size(), before + 1);
  EXPECT_NE(renderer->scene().warnings.back().message.find("the file ends here"), std::string::npos);
  light.slide = -1;
  ASSERT_TRUE(renderer->set_light(0, light));
  light.slide = 0;
  light.slide_is_intensity = true;  // another use: loaded again
  ASSERT_TRUE(renderer->set_light(0, light));
  EXPECT_EQ(renderer->scene().warnings.size(), before + 1);
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
