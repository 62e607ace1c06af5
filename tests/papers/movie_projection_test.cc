// Segal et al. 1992, section 3.1: slides that change with time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>

#include "reference/everything.h"
#include "reference/projector_scenes.h"
#include "unit/temporary_folder.h"
#include "unit/test_films.h"

namespace laterna {
namespace {

using namespace reference;

constexpr int kFrames = 24;
constexpr double kLens = 4;  // metres from the wall's first place

// Frame k: column k of 24 is white.
void write_frames(const TemporaryFolder& folder) {
  for (int k = 0; k < kFrames; ++k) {
    Image image(kFrames, 1, 3, PixelType::u8, Transfer::srgb);
    std::fill_n(image.values<std::uint8_t>().begin() + std::ptrdiff_t{3} * k, 3, std::uint8_t{255});
    const std::string number = std::to_string(100 + k);
    ASSERT_TRUE(write_image(image, folder / ("slide." + number + ".png")));
  }
}

struct Stage {
  Scene scene;
  int wall = -1;
};

// A wall 8 m wide, and a projector whose frame is as wide there as it is far away.
Stage stage(Picture picture) {
  Stage s;
  s.wall = add_object(s.scene, "wall", wall(4, 1, 0));
  s.scene.pictures.push_back(std::move(picture));
  Light light = projector("cinema", 0.5, 0.1, 0);
  light.attenuation = Attenuation::none;
  light.shadow.resolution = 128;
  add_light(s.scene, light, {0, 0, kLens}, {0, 0, 0});
  return s;
}

Picture film(const std::filesystem::path& file, AtEnd at_end) {
  Picture picture;
  picture.file = file;
  picture.film = FilmTiming{.at_end = at_end};
  return picture;
}

Picture still(const std::filesystem::path& file) {
  Picture picture;
  picture.file = file;
  return picture;
}

constexpr int kWidth = 480, kHeight = 60;
constexpr double kPixelsPerMetre = 60;

LayeredImage draw(const Renderer& renderer, RenderStatistics* statistics = nullptr) {
  Result<LayeredImage> image =
      renderer.render(square_on(0.5, 8), papers_settings(kWidth, kHeight), {}, statistics);
  EXPECT_TRUE(image);
  return image ? std::move(*image) : LayeredImage{};
}

// The slide's column that is white on a wall at `distance`, −1 where none is.
int white_column(const LayeredImage& image, double distance) {
  int found = -1;
  for (int k = 0; k < kFrames; ++k) {
    const double x = distance * ((k + 0.5) / kFrames - 0.5);
    const float red = at(image, "R", static_cast<int>(kWidth / 2 + x * kPixelsPerMetre), kHeight / 2);
    if (red > 0.9F) found = found == -1 ? k : -2;
  }
  return found;
}

// Row 12: frame k of a 24-frame sequence on a moving wall shows slide k, bit for bit what the still shows.
TEST(MovieProjection, FrameKShowsSlideKOnAMovingReceiver) {
  const TemporaryFolder folder;
  write_frames(folder);
  Stage s = stage(film(folder / "slide.###.png", AtEnd::hold));
  Renderer renderer = make_renderer(s.scene);
  for (int k = 0; k < kFrames; ++k) {
    const double z = -0.05 * k;
    const glm::dmat4 place = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, z));
    EXPECT_EQ(renderer.set_time(k / 24.0).value(), k == 0 ? 0 : 1);
    EXPECT_EQ(renderer.time(), k / 24.0);
    ASSERT_TRUE(renderer.set_transform(s.wall, place));
    const LayeredImage moving = draw(renderer);
    EXPECT_EQ(white_column(moving, kLens - z), k);

    Stage at_rest = stage(still(folder / ("slide." + std::to_string(100 + k) + ".png")));
    at_rest.scene.nodes[static_cast<std::size_t>(at_rest.wall)].parent_from_node = place;
    EXPECT_TRUE(same_bits(moving, draw(make_renderer(at_rest.scene)))) << k;
  }
}

// Row 12: the policies, and a renderer made for a time equals one that came there.
TEST(MovieProjection, LoopHoldBlackAndPingPong) {
  const TemporaryFolder folder;
  write_frames(folder);
  struct Policy {
    AtEnd at_end;
    int before, after_one, after_two;  // 1 frame before the start, and 1 and 2 frames after the end
  };
  for (const Policy p : {Policy{AtEnd::loop, 0, 0, 1}, Policy{AtEnd::hold, 0, 23, 23},
                         Policy{AtEnd::black, -1, -1, -1}, Policy{AtEnd::ping_pong, 0, 22, 21}}) {
    const Stage s = stage(film(folder / "slide.###.png", p.at_end));
    Renderer renderer = make_renderer(s.scene);
    const auto column = [&](int frame) {
      EXPECT_TRUE(renderer.set_time(frame / 24.0));
      const LayeredImage image = draw(renderer);
      RendererOptions options;
      options.time = frame / 24.0;
      const Result<Renderer> there = Renderer::create(s.scene, options);
      EXPECT_TRUE(there && same_bits(image, draw(*there)));
      return white_column(image, kLens);
    };
    EXPECT_EQ(column(-1), p.before);
    EXPECT_EQ(column(23), 23);
    EXPECT_EQ(column(24), p.after_one);
    EXPECT_EQ(column(25), p.after_two);
    EXPECT_EQ(column(5), 5);
  }
}

// From frame to frame only the film's picture is made anew: shadow maps are kept, and what shows the same frame is left alone.
TEST(MovieProjection, ShadowMapsAreKeptFromFrameToFrame) {
  const TemporaryFolder folder;
  write_frames(folder);
  const Stage s = stage(film(folder / "slide.###.png", AtEnd::loop));
  Renderer renderer = make_renderer(s.scene);
  RenderStatistics statistics;
  draw(renderer, &statistics);
  EXPECT_EQ(statistics.maps_drawn, 1);
  for (int k = 1; k < 30; ++k) {
    EXPECT_EQ(renderer.set_time(k / 24.0).value(), 1);
    EXPECT_EQ(renderer.set_time(k / 24.0 + 0.02).value(), 0);  // the same frame
    draw(renderer, &statistics);
    EXPECT_EQ(statistics.maps_drawn, 0);
    EXPECT_EQ(statistics.maps_kept, 1);
  }
}

// A frame that cannot be read leaves time and film as they were.
TEST(MovieProjection, AFrameThatCannotBeReadIsAnError) {
  const TemporaryFolder folder;
  write_frames(folder);
  folder.write("slide.105.png", "no picture");
  const Stage s = stage(film(folder / "slide.###.png", AtEnd::loop));
  Renderer renderer = make_renderer(s.scene);
  ASSERT_TRUE(renderer.set_time(4 / 24.0));
  const Result<int> broken = renderer.set_time(5 / 24.0);
  ASSERT_FALSE(broken);
  EXPECT_NE(to_string(broken.error()).find("slide.105.png"), std::string::npos);
  EXPECT_EQ(renderer.time(), 4 / 24.0);
  EXPECT_EQ(white_column(draw(renderer), kLens), 4);
  EXPECT_EQ(renderer.set_time(6 / 24.0).value(), 1);
  EXPECT_EQ(white_column(draw(renderer), kLens), 6);
  EXPECT_FALSE(renderer.set_time(2 * kMaxSceneTime));
  EXPECT_FALSE(renderer.set_time(std::numeric_limits<double>::quiet_NaN()));
}

// A video file does the same: frame k has luma 20 + 8 k.
TEST(MovieProjection, VideoFrameByFrame) {
  if (!testing::has_video()) GTEST_SKIP() << video_support().description;
  const Stage s = stage(film(testing::test_film("steps.mp4"), AtEnd::hold));
  Renderer renderer = make_renderer(s.scene);
  for (const int k : {0, 1, 2, 3, 9, 10, 23, 30, 8, 7, 6}) {
    ASSERT_TRUE(renderer.set_time(k / 24.0));
    Scene one = s.scene;
    const auto grey = static_cast<std::uint8_t>(std::lround((4 + 8 * std::min(k, 23)) * 255 / 219.0));
    one.pictures[0] = {};
    auto pixels = std::make_shared<Image>(16, 16, 3, PixelType::u8, Transfer::srgb);
    std::ranges::fill(pixels->values<std::uint8_t>(), grey);
    one.pictures[0].pixels = pixels;
    EXPECT_TRUE(same_bits(draw(renderer), draw(make_renderer(one)))) << k;
  }
}

}  // namespace
}  // namespace laterna
