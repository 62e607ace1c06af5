// The pictures under ../shared/scenes: all are read, and pixels are those that other programs see in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "laterna/image.h"
#include "unit/temporary_folder.h"

namespace laterna {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(LATERNA_SHARED_DIR) / "scenes";

#define SKIP_WITHOUT(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << (path).string() << " is not there"

Image read(const std::filesystem::path& file) {
  const Result<Image> image = read_image(file);
  if (image) return *image;
  ADD_FAILURE() << to_string(image.error());
  return {};
}

TEST(PictureFiles, AllAreRead) {
  SKIP_WITHOUT(kScenes);
  const std::set<std::string> endings = {".png", ".jpg", ".bmp", ".tga", ".gif", ".hdr", ".exr"};
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kScenes)) {
    if (!entry.is_regular_file() || !endings.contains(entry.path().extension())) continue;
    const Image image = read(entry.path());
    const auto bytes = image.bytes();
    EXPECT_TRUE(std::any_of(bytes.begin(), bytes.end(), [](std::byte b) { return b != std::byte{0}; }))
        << entry.path();
    ++count;
  }
  EXPECT_GT(count, 100);
}

TEST(PictureFiles, BitmapsEqualTheirPngCopies) {
  for (const char* name : {"terrain/terrain-heightmap", "md2/sydney", "md2/faerie2"}) {
    const std::filesystem::path bmp = kScenes / (std::string(name) + ".bmp"),
                                png = kScenes / (std::string(name) + ".png");
    SKIP_WITHOUT(bmp);
    SKIP_WITHOUT(png);
    const Image a = read(bmp), b = read(png);
    ASSERT_EQ(a.width(), b.width());
    ASSERT_EQ(a.height(), b.height());
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        // The PNG of a grey bitmap has one channel.
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(a.value(x, y, c), b.value(x, y, std::min(c, b.channels() - 1))) << name;
      }
    }
  }
}

struct Pixel {
  const char* file;
  int x, y;
  std::vector<int> values;
};

TEST(PictureFiles, PixelsAreThoseThatOtherProgramsSee) {
  const std::array rows = {
      Pixel{"slides/astronaut.png", 256, 100, {157, 127, 109}},
      Pixel{"slides/camera.png", 10, 20, {201}},
      Pixel{"slides/palette_color.png", 1, 1, {102, 102, 102}},
      Pixel{"slides/hubble_deep_field.jpg", 500, 300, {11, 11, 11}},
      Pixel{"video/no_time_for_that_tiny.gif", 5, 5, {151, 172, 165, 255}},
      Pixel{"meshes/spot_texture.png", 512, 300, {255, 238, 230}},
  };
  for (const Pixel& row : rows) {
    SKIP_WITHOUT(kScenes / row.file);
    const Image image = read(kScenes / row.file);
    ASSERT_EQ(image.channels(), static_cast<int>(row.values.size())) << row.file;
    for (int c = 0; c < image.channels(); ++c) {
      EXPECT_EQ(image.value(row.x, row.y, c),
                static_cast<float>(row.values[static_cast<std::size_t>(c)]) / 255.0F)
          << row.file;
    }
  }
}

TEST(PictureFiles, RadianceOfASkyOutOfAHdrFile) {
  const std::filesystem::path file = kScenes / "hdri/studio_small_05_1k.hdr";
  SKIP_WITHOUT(file);
  const Image image = read(file);
  ASSERT_EQ(image.type(), PixelType::f32);
  EXPECT_EQ(image.transfer(), Transfer::linear);
  EXPECT_FLOAT_EQ(image.value(512, 100, 0), 0.00094985962F);
  EXPECT_FLOAT_EQ(image.value(512, 100, 1), 0.00084304810F);
  EXPECT_FLOAT_EQ(image.value(512, 100, 2), 0.00076293945F);
}

TEST(PictureFiles, ExrFilesSurviveBeingWrittenAgain) {
  const std::filesystem::path file = kScenes / "hdri/sunset.exr";
  SKIP_WITHOUT(file);
  const Result<LayeredImage> image = read_layered_image(file);
  ASSERT_TRUE(image) << to_string(image.error());
  const TemporaryFolder folder;
  const std::filesystem::path copy = folder / "sunset.exr";
  const Result<void> written = write_image(*image, copy);
  ASSERT_TRUE(written) << to_string(written.error());
  const Result<LayeredImage> back = read_layered_image(copy);
  ASSERT_TRUE(back) << to_string(back.error());
  const Result<Comparison> found = compare_images(*image, *back, {});
  ASSERT_TRUE(found) << to_string(found.error());
  EXPECT_EQ(found->difference.max_error, 0);
}

}  // namespace
}  // namespace laterna
