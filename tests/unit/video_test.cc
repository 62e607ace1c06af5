// Video: colours in integers, and files by the plug-in. tests/films/README.md says how the files were made.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "image/frame_reader.h"
#include "image/video_colour.h"
#include "unit/image_bytes.h"
#include "unit/test_films.h"

namespace laterna::image {
namespace {

// ------------------------------------------------------------------------------------------------------- colours

struct Weights {
  LaternaVideoMatrix matrix;
  double red, blue;
};
constexpr Weights kWeights[] = {{kVideoBt601, 0.299, 0.114},
                                {kVideoBt709, 0.2126, 0.0722},
                                {kVideoBt2020, 0.2627, 0.0593},
                                {kVideoSmpte240m, 0.212, 0.087}};

// A 1 × 1 picture of 16-bit words.
struct OnePixel {
  std::uint8_t words[3][2];
  LaternaVideoPicture picture{};
  OnePixel(int depth, std::array<int, 3> codes, LaternaVideoMatrix matrix, bool is_full) {
    picture.width = picture.height = 1;
    picture.component_count = 3;
    picture.matrix = matrix;
    picture.is_full_range = is_full ? 1 : 0;
    for (std::size_t c = 0; c < 3; ++c) {
      words[c][0] = static_cast<std::uint8_t>(codes[c] & 255);
      words[c][1] = static_cast<std::uint8_t>(codes[c] >> 8);
      picture.components[c] = {words[c], 2, 2, 0, depth};
    }
  }
};

// Against the standards' equations in floating point: never more than rounding apart.
TEST(VideoColour, FollowsTheStandards) {
  VideoColour colour;
  for (const Weights& weights : kWeights) {
    for (const int depth : {8, 10, 12}) {
      for (const bool is_full : {false, true}) {
        const double unit = std::pow(2.0, depth - 8), codes = std::pow(2.0, depth);
        const double largest = depth == 8 ? 255 : 65535;
        for (int i = 0; i < 500; ++i) {
          const auto code = [&](int step) { return i * step % static_cast<int>(codes); };
          const std::array<int, 3> yuv = {code(37), code(61), code(101)};
          const OnePixel pixel(depth, yuv, weights.matrix, is_full);
          const Image image = colour.convert(pixel.picture);
          const double y = is_full ? yuv[0] / (codes - 1) : (yuv[0] - 16 * unit) / (219 * unit);
          const double chroma = is_full ? codes - 1 : 224 * unit;
          const double cb = (yuv[1] - codes / 2) / chroma, cr = (yuv[2] - codes / 2) / chroma;
          const double r = y + 2 * (1 - weights.red) * cr, b = y + 2 * (1 - weights.blue) * cb;
          const double g = (y - weights.red * r - weights.blue * b) / (1 - weights.red - weights.blue);
          const std::array<double, 3> expected = {r, g, b};
          for (int c = 0; c < 3; ++c) {
            const double value = std::clamp(expected[static_cast<std::size_t>(c)], 0.0, 1.0) * largest;
            ASSERT_LE(std::abs(image.value(0, 0, c) * largest - value), 0.5001 + 1e-2 * (largest > 255))
                << weights.matrix << " " << depth << " " << is_full << " " << i;
          }
        }
      }
    }
  }
}

TEST(VideoColour, BlackWhiteAndThePrimariesOfBt601) {
  VideoColour colour;
  const auto rgb = [&](int y, int cb, int cr) {
    const OnePixel pixel(8, {y, cb, cr}, kVideoBt601, false);
    const Image image = colour.convert(pixel.picture);
    const auto v = image.values<std::uint8_t>();
    return std::array<int, 3>{v[0], v[1], v[2]};
  };
  EXPECT_EQ(rgb(16, 128, 128), (std::array{0, 0, 0}));
  EXPECT_EQ(rgb(235, 128, 128), (std::array{255, 255, 255}));
  EXPECT_EQ(rgb(81, 90, 240), (std::array{254, 0, 0}));  // the 8-bit codes nearest to red, green and blue
  EXPECT_EQ(rgb(145, 54, 34), (std::array{0, 255, 1}));
  EXPECT_EQ(rgb(41, 240, 110), (std::array{0, 0, 255}));
  EXPECT_EQ(rgb(0, 128, 128), (std::array{0, 0, 0}));
  EXPECT_EQ(rgb(255, 128, 128), (std::array{255, 255, 255}));
}

// Chroma of a block goes to each of its pixels; odd sizes end with part of a block.
TEST(VideoColour, ChromaIsSpreadOverItsBlock) {
  const std::uint8_t luma[15] = {100, 100, 100, 100, 100, 100, 100, 100, 100, 100, 100, 100, 100, 100, 100};
  const std::uint8_t cb[6] = {128, 128, 128, 128, 128, 128}, cr[6] = {100, 120, 140, 160, 180, 200};
  LaternaVideoPicture picture{};
  picture.width = 5;
  picture.height = 3;
  picture.component_count = 3;
  picture.components[0] = {luma, 5, 1, 0, 8};
  picture.components[1] = {cb, 3, 1, 0, 8};
  picture.components[2] = {cr, 3, 1, 0, 8};
  picture.matrix = kVideoBt709;
  picture.chroma_shift_x = picture.chroma_shift_y = 1;
  const Image image = VideoColour().convert(picture);
  VideoColour colour;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      const OnePixel pixel(8, {100, 128, cr[(y / 2) * 3 + x / 2]}, kVideoBt709, false);
      EXPECT_EQ(image.value(x, y, 0), colour.convert(pixel.picture).value(0, 0, 0)) << x << " " << y;
    }
  }
}

// Packed words of either byte order, and components of differing depth: R 5, G 6, B 5 bits.
TEST(VideoColour, PackedRgb) {
  const std::uint8_t little[2] = {0xE0, 0xFF}, big[2] = {0xFF, 0xE0};  // 0xFFE0: yellow
  for (const bool is_big : {false, true}) {
    const std::uint8_t* word = is_big ? big : little;
    LaternaVideoPicture picture{};
    picture.width = picture.height = 1;
    picture.component_count = 3;
    picture.is_full_range = 1;
    picture.is_big_endian = is_big ? 1 : 0;
    picture.matrix = kVideoRgb;
    const std::uint8_t* high = word + (is_big ? 0 : 1);
    const std::uint8_t* low = word + (is_big ? 1 : 0);
    picture.components[0] = {high, 2, 2, 3, 5};
    picture.components[1] = {word, 2, 2, 5, 6};
    picture.components[2] = {low, 2, 2, 0, 5};
    const Image image = VideoColour().convert(picture);
    EXPECT_EQ(image.type(), PixelType::u8);
    EXPECT_EQ(image.value(0, 0, 0), 1);
    EXPECT_EQ(image.value(0, 0, 1), 1);
    EXPECT_EQ(image.value(0, 0, 2), 0);
  }
}

// ------------------------------------------------------------------------------------------------------- files

class VideoFile : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!laterna::testing::has_video()) GTEST_SKIP() << video_support().description;
  }
  static std::unique_ptr<FrameReader> open(const std::string& name) {
    OpenedFilm film = open_film(laterna::testing::test_film(name), 24);
    EXPECT_TRUE(film) << (film ? "" : to_string(film.error()));
    return film ? std::move(*film) : nullptr;
  }
};

// The grey that luma comes to, limited range.
int grey(int luma) { return static_cast<int>(std::lround((luma - 16) * 255 / 219.0)); }

int first_value(FrameReader& film, std::size_t number) {
  const Result<Image> image = film.read(number);
  EXPECT_TRUE(image) << number << ": " << (image ? "" : to_string(image.error()));
  return image ? image->values<std::uint8_t>()[0] : -1;
}

// Frame k has luma 20 + 8 k. Every sixth is a key frame, and two frames before each of them need the group before.
TEST_F(VideoFile, FramesByNumberFromAnySide) {
  const auto film = open("steps.mp4");
  ASSERT_NE(film, nullptr);
  EXPECT_TRUE(film->warnings().empty());
  EXPECT_EQ(film->header().format, "QuickTime / MOV, h264");
  EXPECT_EQ(film->header().width, 16);
  EXPECT_EQ(film->header().height, 16);
  ASSERT_EQ(film->header().frames, 24U);
  EXPECT_EQ(film->header().duration, 1);
  for (std::size_t k = 0; k < 24; ++k) EXPECT_EQ(film->times().begins[k], static_cast<double>(k) / 24);
  for (std::size_t k = 0; k < 24; ++k) EXPECT_EQ(first_value(*film, k), grey(20 + 8 * static_cast<int>(k)));
  for (std::size_t k = 24; k-- > 0;) EXPECT_EQ(first_value(*film, k), grey(20 + 8 * static_cast<int>(k)));
  for (std::size_t i = 0; i < 60; ++i) {
    const std::size_t k = i * 7 % 24;
    EXPECT_EQ(first_value(*film, k), grey(20 + 8 * static_cast<int>(k))) << k;
  }
}

TEST_F(VideoFile, FramesOfUnequalLength) {
  const auto film = open("uneven.mkv");
  ASSERT_NE(film, nullptr);
  EXPECT_EQ(film->times().begins, (std::vector<double>{0, 0.04, 0.1, 0.3, 0.31}));
  // BT.601, 4:4:4: red, green, blue, white, black.
  const std::array<std::array<int, 3>, 5> expected = {
      {{254, 0, 0}, {0, 255, 1}, {0, 0, 255}, {255, 255, 255}, {0, 0, 0}}};
  for (const std::size_t k : {4, 3, 2, 1, 0, 1, 2, 3, 4}) {
    const Image image = film->read(k).value();
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(image.values<std::uint8_t>()[c], expected[k][c]) << k;
  }
}

// A container that knows only when frames are decoded: they are shown in the order in which they come out.
TEST_F(VideoFile, TimesOfDecodingOnly) {
  const auto film = open("counted.avi");
  ASSERT_NE(film, nullptr);
  ASSERT_EQ(film->header().frames, 12U);
  for (const std::size_t k : {0, 1, 2, 11, 5, 4, 3, 7})
    EXPECT_EQ(first_value(*film, k), grey(30 + 16 * static_cast<int>(k))) << k;
}

// A ramp of luma 64 + 876 i / 63 at 10 bits, 4:2:2.
TEST_F(VideoFile, TenBits) {
  const auto film = open("ten_bits.mkv");
  ASSERT_NE(film, nullptr);
  const Image image = film->read(0).value();
  ASSERT_EQ(image.type(), PixelType::u16);
  for (int i = 0; i < 64; ++i) {
    const double expected = (876 * i / 63) / 876.0 * 65535;
    EXPECT_LE(std::abs(image.values<std::uint16_t>()[static_cast<std::size_t>(i) * 3] - expected), 0.5) << i;
  }
}

// Cameras and encoders with threads write frames as several slices: they are whole.
TEST_F(VideoFile, FramesOfSeveralSlices) {
  const auto film = open("slices.mp4");
  ASSERT_NE(film, nullptr);
  ASSERT_EQ(film->header().frames, 3U);
  for (const std::size_t k : {0, 2, 1}) {
    const Result<Image> image = film->read(k);
    ASSERT_TRUE(image) << to_string(image.error());
    EXPECT_EQ(image->width(), 64);
  }
}

TEST_F(VideoFile, DoctorNamesTheLibraries) {
  EXPECT_NE(video_support().description.find("libavcodec "), std::string::npos);
}

}  // namespace
}  // namespace laterna::image
