// Pictures in memory.
#include "laterna/image.h"

#include <gtest/gtest.h>

#include <limits>

namespace laterna {
namespace {

TEST(Image, IsZeroFilledAndInterleavedFromTheTop) {
  Image image(3, 2, 2, PixelType::u16, Transfer::linear);
  EXPECT_EQ(image.bytes().size(), 24U);
  EXPECT_EQ(image.value(2, 1, 1), 0);
  image.values<std::uint16_t>()[((1 * 3) + 2) * 2 + 1] = 65535;
  EXPECT_EQ(image.value(2, 1, 1), 1);
  EXPECT_TRUE(image.has_alpha());
  EXPECT_FALSE(image.empty());
}

TEST(Image, HandsOutValuesOfItsOwnTypeOnly) {
  Image image(2, 2, 1, PixelType::f32, Transfer::linear);
  EXPECT_EQ(image.values<float>().size(), 4U);
  EXPECT_TRUE(image.values<std::uint8_t>().empty());
  EXPECT_TRUE(std::as_const(image).values<std::uint16_t>().empty());
}

TEST(Image, EightBitValuesAreFractionsOf255) {
  Image image(1, 1, 1, PixelType::u8, Transfer::srgb);
  image.values<std::uint8_t>()[0] = 51;
  EXPECT_EQ(image.value(0, 0, 0), 51 / 255.0F);
}

TEST(Image, ASizeOutOfRangeMakesAnEmptyPicture) {
  const auto is_empty = [](int width, int height, int channels) {
    const Image image(width, height, channels, PixelType::u8, Transfer::srgb);
    return image.empty() && image.bytes().empty();
  };
  EXPECT_TRUE(is_empty(0, 1, 1));
  EXPECT_TRUE(is_empty(1, -1, 1));
  EXPECT_TRUE(is_empty(1, kMaxImageSide + 1, 1));
  EXPECT_TRUE(is_empty(1, 1, 0));
  EXPECT_TRUE(is_empty(1, 1, 5));
  EXPECT_FALSE(is_empty(kMaxImageSide, 1, 4));
}

TEST(LayeredImage, FindsChannelsByName) {
  const LayeredImage image{1, 1, {{"R", {1}}, {"light.sun.R", {2}}}, {}};
  ASSERT_NE(image.find("light.sun.R"), nullptr);
  EXPECT_EQ(image.find("light.sun.R")->values[0], 2);
  EXPECT_EQ(image.find("r"), nullptr);
}

}  // namespace
}  // namespace laterna
