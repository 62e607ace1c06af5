// Scenes left as they are at one instant: waves by their phase, films by their frame.
#include "laterna/still_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "laterna/mirrors.h"
#include "shade/water_waves.h"
#include "unit/temporary_folder.h"

namespace laterna {
namespace {

constexpr double kTurn = 2 * 3.14159265358979323846;

double height_at(const Wave& wave, double along, double seconds) {
  const double speed = wave.speed.value_or(std::sqrt(9.80665 * wave.length / kTurn));
  return std::sin(kTurn * (along - speed * seconds) / wave.length + wave.phase);
}

TEST(StillScene, WavesHaveThePhaseOfTheirTime) {
  for (const double phase : {0.0, -kMaxWavePhase, kMaxWavePhase, 3.3}) {
    for (const std::optional<double> speed : {std::optional<double>(), {0.8}, {-1.7}, {0.0}}) {
      for (const double seconds : {0.0, 0.01, -3.7, 4321.1}) {
        Wave wave;
        wave.length = 0.37;
        wave.speed = speed;
        wave.phase = phase;
        Wave still = wave;
        still.phase = phase_at(wave, seconds);
        still.speed = 0;
        EXPECT_LE(std::abs(still.phase), kMaxWavePhase) << phase << ", " << seconds;
        EXPECT_NEAR(height_at(still, 0.123, 99), height_at(wave, 0.123, seconds), 1e-9)
            << phase << ", " << seconds;
        EXPECT_EQ(phase_at(still, 77.7), still.phase);
        EXPECT_EQ(phase_at(wave, 0), wave.phase);
      }
    }
  }
}

// Not only nearly: normals lead to pixels of the mirrored picture, and a last bit can choose another one.
TEST(StillScene, StilledWavesHaveTheNormalsOfTheirTimeBitForBit) {
  Mirror moving;
  moving.waves = {{{1, 0, 0.3}, 0.5, 0.01, {}, 0.4}, {{-1, 0, 1}, 0.77, 0.01, 0.9, -kMaxWavePhase}};
  constexpr double kSeconds = 1234.56;
  Mirror still = moving;
  for (Wave& wave : still.waves) {
    wave.phase = phase_at(wave, kSeconds);
    wave.speed = 0;
  }
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 place(0.37 * i, 0.2, -0.11 * i);
    const glm::dvec3 expected = shade::normal_on_waves(moving, {0, 1, 0}, place, 1e-3, kSeconds);
    EXPECT_EQ(shade::normal_on_waves(still, {0, 1, 0}, place, 1e-3, 0), expected) << i;
    EXPECT_EQ(shade::normal_on_waves(still, {0, 1, 0}, place, 1e-3, 77.7), expected) << i;
  }
}

// A wave, a clip that lifts its node to 3 m within a second, and a film of two frames of one pixel.
Scene moving_scene(const std::filesystem::path& film) {
  Scene scene;
  Mirror water;
  water.waves.emplace_back();
  scene.materials.emplace_back().mirror = std::make_shared<const Mirror>(water);
  Node& node = scene.nodes.emplace_back();
  node.name = "raft";
  node.transform.emplace();
  Clip& clip = scene.clips.emplace_back();
  KeyFrames& keys = clip.keys.emplace_back();
  keys.times = {0, 1};
  keys.values = {0, 0, 0, 0, 3, 0};
  ClipChannel& channel = clip.channels.emplace_back();
  channel.target = 0;
  channel.keys = 0;
  Picture& picture = scene.pictures.emplace_back();
  picture.file = film;
  picture.film = FilmTiming{.frames_per_second = 2, .at_end = AtEnd::black};
  return scene;
}

TEST(StillScene, NothingMovesAnyMore) {
  const TemporaryFolder folder;
  folder.write("f.0.pgm", std::string_view("P5 1 1 255\n\x10"));
  folder.write("f.1.pgm", std::string_view("P5 1 1 255\n\x20"));
  for (const auto& [seconds, shown, height] : {std::tuple(0.75, 0x20, 2.25), std::tuple(5.25, 0, 0.75)}) {
    Scene scene = moving_scene(folder.path() / "f.#.pgm");
    EXPECT_TRUE(changes_with_time(scene));
    const Result<std::vector<Diagnostic>> stilled = make_still(scene, seconds);
    ASSERT_TRUE(stilled) << to_string(stilled.error());
    EXPECT_TRUE(stilled->empty());
    EXPECT_FALSE(changes_with_time(scene));
    EXPECT_TRUE(validate(scene).empty());
    EXPECT_EQ(scene.nodes[0].parent_from_node[3].y, height);
    const Picture& picture = scene.pictures[0];
    ASSERT_NE(picture.pixels, nullptr);
    EXPECT_EQ(static_cast<int>(picture.pixels->bytes()[0]), shown);
  }
}

TEST(StillScene, AnErrorLeavesTheSceneAsItWas) {
  const TemporaryFolder folder;
  folder.write("f.0.pgm", std::string_view("P5 1 1 255\n\x10"));
  folder.write("f.1.pgm", std::string_view("P5 1 1 255\n"));
  Scene scene = moving_scene(folder.path() / "f.#.pgm");
  const Result<std::vector<Diagnostic>> torn = make_still(scene, 0.75);
  ASSERT_FALSE(torn);
  EXPECT_EQ(torn.error().failure, Failure::bad_input);
  EXPECT_NE(to_string(torn.error()).find("f.1.pgm"), std::string::npos) << to_string(torn.error());
  for (const double seconds : {2e6, -2e6, std::numeric_limits<double>::quiet_NaN()}) {
    const Result<std::vector<Diagnostic>> beyond = make_still(scene, seconds);
    ASSERT_FALSE(beyond);
    EXPECT_EQ(beyond.error().failure, Failure::bad_usage);
  }
  EXPECT_EQ(scene.clips.size(), 1U);
  EXPECT_TRUE(scene.pictures[0].film);
  EXPECT_FALSE(scene.materials[0].mirror->waves[0].speed);
}

}  // namespace
}  // namespace laterna
