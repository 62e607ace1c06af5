// Texture look-ups on every instruction set against reference::look_up.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "base/aligned_vector.h"
#include "kernels/vector_functions.h"
#include "reference/texture.h"

namespace laterna::kernels {
namespace {

using image::MipChain;
using image::MipUse;

constexpr std::size_t kProbes = 1024;

struct LookupPlaces {
  AlignedVector<float> u, v, du_dx, dv_dx, du_dy, dv_dy;
  LookupPlaces() {
    for (AlignedVector<float>* a : {&u, &v, &du_dx, &dv_dx, &du_dy, &dv_dy}) a->assign(kProbes, 0.0F);
  }
  [[nodiscard]] reference::TextureProbe at(std::size_t i) const {
    return {u[i], v[i], du_dx[i], dv_dx[i], du_dy[i], dv_dy[i]};
  }
};

struct Samples {
  AlignedVector<float> r, g, b, a;
  Samples() {
    for (AlignedVector<float>* c : {&r, &g, &b, &a}) c->assign(kProbes, -1.0F);
  }
  [[nodiscard]] std::array<float, 4> at(std::size_t i) const { return {r[i], g[i], b[i], a[i]}; }
};

struct Texture {
  MipChain chain;
  Sampler sampler;
  int anisotropy = 1;
};

Samples look_up(const Texture& t, const LookupPlaces& p, InstructionSet set) {
  Samples s;
  look_up_texture_for(set)(
      {&t.chain, t.sampler, t.anisotropy, p.u, p.v, p.du_dx, p.dv_dx, p.du_dy, p.dv_dy, s.r, s.g, s.b, s.a});
  return s;
}

// Noise: every texel differs from its neighbours.
Image noise(int width, int height, int channels, PixelType type, Transfer transfer, unsigned seed) {
  std::mt19937 random(seed);
  Image image(width, height, channels, type, transfer);
  for (std::uint8_t& value : image.values<std::uint8_t>()) value = static_cast<std::uint8_t>(random());
  for (std::uint16_t& value : image.values<std::uint16_t>()) value = static_cast<std::uint16_t>(random());
  for (float& value : image.values<float>()) value = std::uniform_real_distribution<float>(0, 1)(random);
  return image;
}

// Footprints of all sizes and shapes, from 1/16 of a texel to more than the picture, anywhere in and around
// it.
LookupPlaces random_probes(const MipChain& chain, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-2.5F, 3.5F), log_size(-4, 8), log_ratio(0, 5),
      angle(0, 6.2831853F);
  LookupPlaces p;
  for (std::size_t i = 0; i < kProbes; ++i) {
    p.u[i] = place(random);
    p.v[i] = place(random);
    const float longer = std::exp2(log_size(random));
    const float shorter = longer * std::exp2(-log_ratio(random));
    const float turn = angle(random);
    const bool x_is_longer = (random() & 1U) != 0;
    const float x = x_is_longer ? longer : shorter, y = x_is_longer ? shorter : longer;
    const auto w = static_cast<float>(chain.width()), h = static_cast<float>(chain.height());
    p.du_dx[i] = x * std::cos(turn) / w;
    p.dv_dx[i] = x * std::sin(turn) / h;
    p.du_dy[i] = -y * std::sin(turn) / w;
    p.dv_dy[i] = y * std::cos(turn) / h;
  }
  return p;
}

void expect_as_reference(const Texture& t, const LookupPlaces& p, InstructionSet set,
                         const std::string& what) {
  const Samples got = look_up(t, p, set);
  int ambiguous = 0;
  for (std::size_t i = 0; i < kProbes; ++i) {
    const reference::TextureSample expected = reference::look_up(t.chain, t.sampler, t.anisotropy, p.at(i));
    ambiguous += expected.is_ambiguous ? 1 : 0;
    if (expected.is_ambiguous) continue;
    for (std::size_t c = 0; c < 4; ++c) {
      // Values lie in [0, 1]. A coordinate of size 64 keeps 2^-18 of a texel, and levels are a logarithm
      // away.
      const double value = expected.rgba[c];
      ASSERT_NEAR(got.at(i)[c], value, 4e-5) << what << ", probe " << i << ", channel " << c;
    }
  }
  EXPECT_LT(ambiguous, static_cast<int>(kProbes / 50)) << what;
}

class TextureLookup : public testing::TestWithParam<InstructionSet> {};

constexpr Wrap kWraps[] = {Wrap::repeat, Wrap::mirror, Wrap::clamp};
constexpr Filter kFilters[] = {Filter::nearest, Filter::linear};
constexpr MipFilter kMipFilters[] = {MipFilter::none, MipFilter::nearest, MipFilter::linear};

std::string describe(const Sampler& s, int anisotropy) {
  return "wrap " + std::to_string(static_cast<int>(s.wrap_u)) + "," +
         std::to_string(static_cast<int>(s.wrap_v)) + " magnify " +
         std::to_string(static_cast<int>(s.magnify)) + " minify " +
         std::to_string(static_cast<int>(s.minify)) + " mip " + std::to_string(static_cast<int>(s.mip)) +
         " anisotropy " + std::to_string(anisotropy);
}

TEST_P(TextureLookup, EveryFilterAndWrapModeIsAsDefined) {
  unsigned seed = 1;
  // Odd sizes too: levels are then no exact halves.
  for (const auto& [width, height] : {std::pair{64, 32}, std::pair{45, 27}}) {
    Texture t;
    t.chain = image::make_mip_chain(noise(width, height, 4, PixelType::u8, Transfer::srgb, 3),
                                    MipUse::colour_with_alpha);
    for (const Wrap wrap : kWraps) {
      for (const Filter magnify : kFilters) {
        for (const Filter minify : kFilters) {
          for (const MipFilter mip : kMipFilters) {
            for (const int anisotropy : {1, 3, 16}) {
              t.sampler = {wrap, kWraps[seed % 3], magnify, minify, mip};
              t.anisotropy = anisotropy;
              expect_as_reference(t, random_probes(t.chain, ++seed), GetParam(),
                                  describe(t.sampler, anisotropy));
            }
          }
        }
      }
    }
  }
}

TEST_P(TextureLookup, EveryTexelFormatIsReadWithItsAlpha) {
  struct Format {
    PixelType type;
    Transfer transfer;
    MipUse use;
    image::TexelFormat expected;
  };
  const Format formats[] = {
      {PixelType::u8, Transfer::srgb, MipUse::colour_with_alpha, image::TexelFormat::colour},
      {PixelType::u8, Transfer::srgb, MipUse::colour, image::TexelFormat::colour},
      {PixelType::u8, Transfer::srgb, MipUse::data, image::TexelFormat::data},
      {PixelType::u8, Transfer::linear, MipUse::colour_with_alpha, image::TexelFormat::wide},
      {PixelType::u16, Transfer::srgb, MipUse::colour_with_alpha, image::TexelFormat::wide},
      {PixelType::u16, Transfer::linear, MipUse::data, image::TexelFormat::wide},
      {PixelType::f32, Transfer::linear, MipUse::colour_with_alpha, image::TexelFormat::wide},
  };
  unsigned seed = 100;
  for (const Format& format : formats) {
    for (int channels = 1; channels <= 4; ++channels) {
      Texture t;
      t.chain =
          image::make_mip_chain(noise(33, 20, channels, format.type, format.transfer, seed), format.use);
      ASSERT_EQ(t.chain.format, format.expected);
      t.anisotropy = 4;
      expect_as_reference(
          t, random_probes(t.chain, ++seed), GetParam(),
          "use " + std::to_string(static_cast<int>(format.use)) + " channels " + std::to_string(channels));
    }
  }
}

TEST_P(TextureLookup, APictureOfOneTexelHasOneColour) {
  Texture t;
  t.chain =
      image::make_mip_chain(noise(1, 1, 4, PixelType::f32, Transfer::linear, 9), MipUse::colour_with_alpha);
  t.anisotropy = 16;
  const std::array<float, 4> expected = image::texel(t.chain, 0, 0, 0);
  const Samples got = look_up(t, random_probes(t.chain, 4), GetParam());
  for (std::size_t i = 0; i < kProbes; ++i) {
    for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(got.at(i)[c], expected[c], 2e-6);
  }
}

// Whatever the coordinates, a look-up stays within the picture and its values within the picture's.
TEST_P(TextureLookup, CoordinatesThatAreNoPlaceReadATexel) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const float wild[] = {kInfinity,  -kInfinity,  std::nanf(""), 1e30F, -1e30F,
                        8388608.0F, 16777217.0F, -0.0F,         1e-40F};
  Texture t;
  t.chain =
      image::make_mip_chain(noise(45, 27, 4, PixelType::u8, Transfer::srgb, 5), MipUse::colour_with_alpha);
  std::mt19937 random(6);
  for (const Wrap wrap : kWraps) {
    for (const int anisotropy : {1, 16}) {
      t.sampler.wrap_u = t.sampler.wrap_v = wrap;
      t.anisotropy = anisotropy;
      LookupPlaces p;
      for (AlignedVector<float>* a : {&p.u, &p.v, &p.du_dx, &p.dv_dx, &p.du_dy, &p.dv_dy}) {
        for (float& value : *a) value = wild[random() % std::size(wild)];
      }
      const Samples got = look_up(t, p, GetParam());
      for (std::size_t i = 0; i < kProbes; ++i) {
        for (const float value : got.at(i)) {
          ASSERT_GE(value, 0.0F) << i;
          ASSERT_LE(value, 1.00001F) << i;
        }
      }
    }
  }
}

TEST_P(TextureLookup, GivesTheSameBitsAsScalar) {
  Texture t;
  t.chain =
      image::make_mip_chain(noise(45, 64, 4, PixelType::u8, Transfer::srgb, 5), MipUse::colour_with_alpha);
  for (const int anisotropy : {1, 2, 8, 16}) {
    t.anisotropy = anisotropy;
    const LookupPlaces p = random_probes(t.chain, static_cast<unsigned>(anisotropy));
    const Samples expected = look_up(t, p, InstructionSet::scalar);
    const Samples got = look_up(t, p, GetParam());
    for (const auto channel : {&Samples::r, &Samples::g, &Samples::b, &Samples::a}) {
      ASSERT_EQ(std::memcmp((got.*channel).data(), (expected.*channel).data(), kProbes * sizeof(float)), 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, TextureLookup, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::kernels
