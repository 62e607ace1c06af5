// Mip chains against area-weighted means taken in double.
#include "image/mip_chain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace laterna::image {
namespace {

// One level in double, r g b a per texel.
struct Level {
  int width, height;
  std::vector<std::array<double, 4>> texels;
  [[nodiscard]] const std::array<double, 4>& at(int x, int y) const {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

// IEC 61966-2-1.
double decoded_srgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

Level base_level(const Image& image, bool decodes_srgb) {
  Level level = {image.width(), image.height(), {}};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      std::array<double, 4> rgba = {0, 0, 0, 1};
      for (int c = 0; c < 3; ++c) {
        const double stored = image.value(x, y, image.channels() >= 3 ? c : 0);
        rgba[static_cast<std::size_t>(c)] = decodes_srgb ? decoded_srgb(stored) : stored;
      }
      if (image.has_alpha()) rgba[3] = image.value(x, y, image.channels() - 1);
      level.texels.push_back(rgba);
    }
  }
  return level;
}

// How much of source texel i lies under destination texel k, in source texels.
double overlap(int i, int k, int from, int to) {
  const double begin = static_cast<double>(k) * from / to, end = static_cast<double>(k + 1) * from / to;
  return std::max(0.0, std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i)));
}

Level halved(const Level& from) {
  Level to = {std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      std::array<double, 4> sum = {};
      double area = 0;
      for (int j = 0; j < from.height; ++j) {
        for (int i = 0; i < from.width; ++i) {
          const double weight = overlap(i, x, from.width, to.width) * overlap(j, y, from.height, to.height);
          area += weight;
          for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * from.at(i, j)[c];
        }
      }
      for (double& value : sum) value /= area;
      to.texels.push_back(sum);
    }
  }
  return to;
}

Image noise(int width, int height, int channels, PixelType type, Transfer transfer) {
  std::mt19937 random(static_cast<unsigned>(width * 1000 + height * 10 + channels));
  Image image(width, height, channels, type, transfer);
  for (std::uint8_t& value : image.values<std::uint8_t>()) value = static_cast<std::uint8_t>(random());
  for (std::uint16_t& value : image.values<std::uint16_t>()) value = static_cast<std::uint16_t>(random());
  for (float& value : image.values<float>()) value = std::uniform_real_distribution<float>(0, 100)(random);
  return image;
}

// A texel of `chain` against the exact value: off by no more than half a step of its format.
void expect_texel(const MipChain& chain, int level, int x, int y, const std::array<double, 4>& exact,
                  bool has_alpha) {
  const std::array<float, 4> got = texel(chain, level, x, y);
  for (std::size_t c = 0; c < 3; ++c) {
    switch (chain.format) {
      case TexelFormat::colour: {
        const double step = c < 2 ? 1.0 / 2047 : 1.0 / 1023;
        ASSERT_NEAR(std::sqrt(static_cast<double>(got[c])), std::sqrt(exact[c]), 0.5 * step + 1e-6);
        break;
      }
      case TexelFormat::data:
        ASSERT_NEAR(got[c], exact[c], 0.5 / 255 + 1e-6);
        break;
      case TexelFormat::wide:
        ASSERT_NEAR(got[c], exact[c], 2e-6 * std::max(1.0, exact[c]));
        break;
    }
  }
  if (has_alpha) {
    ASSERT_NEAR(got[3], exact[3], 0.5 / 255 + 1e-6);
  } else {
    ASSERT_EQ(got[3], 1.0F);
  }
}

// The bits of all levels, of every plane there is.
void expect_same(const MipChain& a, const MipChain& b) {
  EXPECT_EQ(a.format, b.format);
  EXPECT_EQ(a.texel_count, b.texel_count);
  EXPECT_EQ(a.texels, b.texels);
  EXPECT_EQ(a.wide, b.wide);
  EXPECT_EQ(a.alpha, b.alpha);
}

void expect_area_means(const Image& image, MipUse use) {
  const MipChain chain = make_mip_chain(image, use, InstructionSet::scalar);
  for (const InstructionSet set : supported_instruction_sets()) {
    SCOPED_TRACE(name_of(set));
    expect_same(make_mip_chain(image, use, set), chain);
  }
  const bool decodes = use != MipUse::data && image.transfer() == Transfer::srgb;
  const bool has_alpha =
      image.has_alpha() && (use == MipUse::colour_with_alpha || chain.format == TexelFormat::data);
  Level exact = base_level(image, decodes);
  for (int level = 0; level < chain.level_count; ++level) {
    const MipLevel& size = chain.levels[static_cast<std::size_t>(level)];
    ASSERT_EQ(size.width, exact.width);
    ASSERT_EQ(size.height, exact.height);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) expect_texel(chain, level, x, y, exact.at(x, y), has_alpha);
    }
    if (level + 1 == chain.level_count) break;
    exact = halved(exact);
  }
  EXPECT_EQ(exact.width, 1);
  EXPECT_EQ(exact.height, 1);
}

constexpr std::pair<int, int> kSizes[] = {{1, 1},  {2, 1},  {1, 7},   {16, 16}, {17, 9},
                                          {31, 5}, {64, 3}, {45, 27}, {3, 3},   {70, 35}};

TEST(MipChain, EveryLevelIsTheAreaWeightedMeanInLinearLight) {
  for (const auto& [width, height] : kSizes) {
    for (int channels = 1; channels <= 4; ++channels) {
      for (const MipUse use : {MipUse::colour, MipUse::colour_with_alpha, MipUse::data}) {
        for (const PixelType type : {PixelType::u8, PixelType::u16, PixelType::f32}) {
          for (const Transfer transfer : {Transfer::srgb, Transfer::linear}) {
            SCOPED_TRACE(testing::Message() << width << "x" << height << " channels " << channels << " use "
                                            << static_cast<int>(use) << " type " << static_cast<int>(type));
            Image image = noise(width, height, channels, type, transfer);
            // Alpha, and float values under a curve, lie in [0, 1].
            const auto components = static_cast<std::size_t>(channels);
            std::span<float> values = image.values<float>();
            for (std::size_t i = 0; i < values.size(); ++i) {
              const bool is_alpha = image.has_alpha() && i % components == components - 1;
              if (is_alpha || transfer == Transfer::srgb) values[i] /= 100;
            }
            expect_area_means(image, use);
          }
        }
      }
    }
  }
}

TEST(MipChain, ABlackAndWhiteCheckerTurnsToHalfTheLight) {
  Image checker(8, 8, 3, PixelType::u8, Transfer::srgb);
  std::span<std::uint8_t> values = checker.values<std::uint8_t>();
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = (i / 3 % 8 + i / 24) % 2 == 0 ? 255 : 0;
  const MipChain chain = make_mip_chain(checker, MipUse::colour);
  for (int level = 1; level < chain.level_count; ++level) {
    for (const float value :
         {texel(chain, level, 0, 0)[0], texel(chain, level, 0, 0)[1], texel(chain, level, 0, 0)[2]}) {
      EXPECT_NEAR(value, 0.5F, 1e-3F);
    }
  }
}

TEST(MipChain, EightBitColourComesBackWithinAFractionOfACode) {
  Image ramp(256, 1, 3, PixelType::u8, Transfer::srgb);
  std::span<std::uint8_t> values = ramp.values<std::uint8_t>();
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint8_t>(i / 3);
  const MipChain chain = make_mip_chain(ramp, MipUse::colour);
  const auto encoded = [](double linear) {
    return 255 * (linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
  };
  for (int code = 0; code < 256; ++code) {
    const std::array<float, 4> t = texel(chain, 0, code, 0);
    // The curve over the root is steepest, 1.446, where its two parts meet: half a step of 11 or 10 bits
    // comes to this.
    EXPECT_NEAR(encoded(t[0]), code, 0.0902) << code;
    EXPECT_NEAR(encoded(t[1]), code, 0.0902) << code;
    EXPECT_NEAR(encoded(t[2]), code, 0.1804) << code;
  }
}

// Large 16-bit pictures are decoded by a table, small ones by the curve itself: the same bits.
TEST(MipChain, SixteenBitsByTableAndByCurve) {
  Image large(256, 256, 1, PixelType::u16, Transfer::srgb);
  for (std::size_t code = 0; code < 65536; ++code)
    large.values<std::uint16_t>()[code] = static_cast<std::uint16_t>(code);
  const MipChain by_table = make_mip_chain(large, MipUse::colour);
  Image row(256, 1, 1, PixelType::u16, Transfer::srgb);
  for (int y = 0; y < 256; y += 5) {
    std::copy_n(large.values<std::uint16_t>().begin() + std::ptrdiff_t{256} * y, 256,
                row.values<std::uint16_t>().begin());
    const MipChain by_curve = make_mip_chain(row, MipUse::colour);
    for (int x = 0; x < 256; ++x)
      ASSERT_EQ(texel(by_table, 0, x, y), texel(by_curve, 0, x, 0)) << x << " " << y;
  }
}

}  // namespace
}  // namespace laterna::image
