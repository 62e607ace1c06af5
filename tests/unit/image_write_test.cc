// Pictures that are written and read back.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

#include "base/elementary.h"
#include "unit/image_bytes.h"

namespace laterna {
namespace {

using namespace laterna::testing;
using Depth = WriteOptions::Depth;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Every code at least once, not the same in neighbouring channels.
template <class T>
Image gradient(int width, int height, int channels, PixelType type) {
  Image image(width, height, channels, type, Transfer::srgb);
  unsigned value = 0;
  for (T& code : image.values<T>()) code = static_cast<T>(value += type == PixelType::u8 ? 37 : 4099);
  return image;
}

LayeredImage layered(int width, int height, std::vector<Channel> channels) {
  return {width, height, std::move(channels), {}};
}

LayeredImage read_back(const std::filesystem::path& file) {
  const Result<LayeredImage> image = read_layered_image(file);
  if (image) return *image;
  ADD_FAILURE() << to_string(image.error());
  return {};
}

void expect_written(const Result<void>& result) { ASSERT_TRUE(result) << to_string(result.error()); }

std::string message_of(const Result<void>& result) { return result ? "no error" : to_string(result.error()); }

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(WritePng, HoldsExactlyThePixelsOfEveryKind) {
  const TemporaryFolder directory;
  for (const int channels : {1, 2, 3, 4}) {
    for (const PixelType type : {PixelType::u8, PixelType::u16}) {
      const Image image = type == PixelType::u8 ? gradient<std::uint8_t>(61, 67, channels, type)
                                                : gradient<std::uint16_t>(61, 67, channels, type);
      expect_written(write_image(image, directory / "a.PNG"));
      const Result<Image> back = read_image(directory / "a.PNG");
      ASSERT_TRUE(back) << to_string(back.error());
      EXPECT_EQ(back->channels(), channels);
      EXPECT_EQ(back->type(), type);
      EXPECT_TRUE(
          std::equal(image.bytes().begin(), image.bytes().end(), back->bytes().begin(), back->bytes().end()));
    }
  }
}

TEST(WritePng, SaysThatItIsSrgbUnlessThePixelsAreData) {
  const TemporaryFolder directory;
  Image image(1, 1, 1, PixelType::u8, Transfer::srgb);
  expect_written(write_image(image, directory / "colour.png"));
  image.set_transfer(Transfer::linear);
  expect_written(write_image(image, directory / "data.png"));
  const auto has_srgb_chunk = [&](std::string_view name) {
    const Bytes file = load(directory / name), chunk = png_chunk("sRGB", bytes({0}));
    return std::search(file.begin(), file.end(), chunk.begin(), chunk.end()) != file.end();
  };
  EXPECT_TRUE(has_srgb_chunk("colour.png"));
  EXPECT_FALSE(has_srgb_chunk("data.png"));
}

TEST(WritePng, EncodesLinearLight) {
  const TemporaryFolder directory;
  const LayeredImage image =
      layered(2, 1, {{"B", {0.5F, 0}}, {"G", {1, 2}}, {"R", {0.0F, 0.2158605F}}, {"Z", {9, 9}}});
  expect_written(write_image(image, directory / "a.png"));
  EXPECT_EQ(values_u8(*read_image(directory / "a.png")), (std::vector{0, 255, 188, 128, 255, 0}));
  expect_written(write_image(image, directory / "b.png", {.depth = Depth::bits16}));
  EXPECT_EQ(values_u16(*read_image(directory / "b.png"))[2],
            static_cast<int>(65535 * srgb_from_linear(0.5) + 0.5));
}

TEST(WritePng, ExposureMultipliesLightButNotAlpha) {
  const TemporaryFolder directory;
  const LayeredImage image = layered(1, 1, {{"A", {1}}, {"Y", {0.25F}}});
  expect_written(write_image(image, directory / "a.png", {.exposure = 2}));
  EXPECT_EQ(values_u8(*read_image(directory / "a.png")), (std::vector{188, 255}));
  Image pixels(1, 1, 1, PixelType::u8, Transfer::srgb);
  pixels.values<std::uint8_t>()[0] = 137;  // 0.2502 in linear light
  expect_written(write_image(pixels, directory / "b.png", {.exposure = 2}));
  EXPECT_EQ(values_u8(*read_image(directory / "b.png")), (std::vector{188}));
}

TEST(WritePng, DividesColoursByAlpha) {
  const TemporaryFolder directory;
  const LayeredImage image =
      layered(3, 1, {{"R", {0.25F, 0.5F, 0}}, {"G", {0.5F, 0, 0}}, {"B", {0, 0, 0}}, {"A", {0.5F, 1, 0}}});
  expect_written(write_image(image, directory / "a.png"));
  EXPECT_EQ(values_u8(*read_image(directory / "a.png")),
            (std::vector{188, 255, 0, 128, 188, 0, 0, 255, 0, 0, 0, 0}));
}

TEST(WritePng, ChangesDepthThroughLinearLight) {
  const TemporaryFolder directory;
  const Image image = gradient<std::uint8_t>(16, 16, 3, PixelType::u8);
  expect_written(write_image(image, directory / "a.png", {.depth = Depth::bits16}));
  const Image wide = *read_image(directory / "a.png");
  for (std::size_t i = 0; i < 768; ++i) ASSERT_EQ(values_u16(wide)[i], values_u8(image)[i] * 257);
  expect_written(write_image(wide, directory / "b.png", {.depth = Depth::bits8}));
  EXPECT_EQ(values_u8(*read_image(directory / "b.png")), values_u8(image));
}

TEST(WriteExr, FloatsRoundTripBitForBit) {
  const TemporaryFolder directory;
  const std::vector<float> values = {0,      -0.0F,   1.0F / 3, -kInfinity,   kInfinity,
                                     1e-45F, 3.4e38F, -7e-39F,  std::nanf("")};
  const LayeredImage image = layered(3, 3, {{"R", values}, {"light.sun.R", values}});
  expect_written(write_image(image, directory / "a.exr", {.depth = Depth::single}));
  const LayeredImage back = read_back(directory / "a.exr");
  ASSERT_EQ(back.channels.size(), 2U);
  EXPECT_TRUE(same_bits(back.find("R")->values, values));
  EXPECT_TRUE(same_bits(back.find("light.sun.R")->values, values));
}

TEST(WriteExr, KeepsColoursAsHalfAndDataAsFloat) {
  const TemporaryFolder directory;
  const float third = 1.0F / 3, half_third = 0.333251953125F;
  std::vector<Channel> channels;
  for (const char* name : {"A", "B", "G", "R", "albedo.R", "light.Zoe.R"})
    channels.push_back({name, {third}});
  for (const char* name : {"Z", "P.X", "N.Z", "uv.slide.u", "id.object", "lux.Y", "visibility.sun"}) {
    channels.push_back({name, {third}});
  }
  expect_written(write_image(layered(1, 1, channels), directory / "a.exr"));
  const LayeredImage back = read_back(directory / "a.exr");
  ASSERT_EQ(back.channels.size(), channels.size());
  for (std::size_t i = 0; i < channels.size(); ++i) {
    EXPECT_EQ(back.find(channels[i].name)->values[0], i < 6 ? half_third : third) << channels[i].name;
  }
  expect_written(write_image(layered(1, 1, channels), directory / "b.exr", {.depth = Depth::half}));
  EXPECT_EQ(read_back(directory / "b.exr").find("Z")->values[0], half_third);
}

TEST(WriteExr, DoesNotWriteInfinityForLargeValues) {
  const TemporaryFolder directory;
  const LayeredImage image = layered(2, 1,
                                     {{"B", {65519, 1.0F / 3}},
                                      {"G", {65520, 1.0F / 3}},
                                      {"R", {kInfinity, 1.0F / 3}},
                                      {"Y", {-1e9F, 1.0F / 3}}});
  expect_written(write_image(image, directory / "a.exr"));
  const LayeredImage back = read_back(directory / "a.exr");
  EXPECT_EQ(back.find("B")->values, (std::vector{65504.0F, 0.333251953125F}));
  EXPECT_EQ(back.find("G")->values, image.find("G")->values);
  EXPECT_EQ(back.find("R")->values, (std::vector{kInfinity, 0.333251953125F}));
  EXPECT_EQ(back.find("Y")->values, image.find("Y")->values);
}

TEST(WriteExr, KeepsMetadata) {
  const TemporaryFolder directory;
  LayeredImage image = layered(1, 1, {{"Y", {1}}});
  image.metadata = {{"laterna.shadows", "map"}, {"an unusual key", "line one\nline two"}, {"empty", ""}};
  expect_written(write_image(image, directory / "a.exr"));
  EXPECT_EQ(read_back(directory / "a.exr").metadata, image.metadata);
}

TEST(WriteExr, HoldsNothingButThePicture) {
  const TemporaryFolder directory;
  const LayeredImage image = layered(64, 64, {{"Y", std::vector<float>(4096, 0.5F)}});
  expect_written(write_image(image, directory / "a.exr", {.threads = 1}));
  std::filesystem::create_directory(directory / "elsewhere");
  expect_written(write_image(image, directory / "elsewhere/another_name.exr", {.threads = 2}));
  EXPECT_EQ(load(directory / "a.exr"), load(directory / "elsewhere/another_name.exr"));
}

TEST(WriteImage, BytesDoNotDependOnTheNumberOfThreads) {
  const TemporaryFolder directory;
  // Several of the strips in which a PNG is compressed.
  LayeredImage image = layered(257, 531, {{"R", {}}, {"G", {}}, {"B", {}}, {"A", {}}});
  float value = 0;
  for (Channel& channel : image.channels) {
    for (int i = 0; i < 257 * 531; ++i) channel.values.push_back(value = std::fmod(value + 0.37F, 1.0F));
  }
  for (const std::string ending : {".png", ".exr", ".hdr", ".pfm"}) {
    expect_written(write_image(image, directory / ("one" + ending), {.threads = 1}));
    for (const int threads : {0, 2, 5}) {
      expect_written(write_image(image, directory / ("more" + ending), {.threads = threads}));
      EXPECT_EQ(load(directory / ("one" + ending)), load(directory / ("more" + ending))) << ending << threads;
    }
  }
}

TEST(WritePfm, RoundTripsBitForBit) {
  const TemporaryFolder directory;
  const std::vector<float> values = {0, -0.0F, 1.0F / 3, kInfinity, 1e-45F, 3e38F};
  expect_written(
      write_image(layered(2, 3, {{"R", values}, {"B", values}, {"G", values}}), directory / "a.pfm"));
  const LayeredImage back = read_back(directory / "a.pfm");
  ASSERT_EQ(back.channels.size(), 3U);
  for (const Channel& channel : back.channels) EXPECT_TRUE(same_bits(channel.values, values)) << channel.name;
  expect_written(write_image(layered(2, 3, {{"lux.Y", values}}), directory / "b.pfm"));
  EXPECT_TRUE(same_bits(read_back(directory / "b.pfm").find("Y")->values, values));
}

TEST(WritePfm, IsWhatItsDescriptionSays) {
  const TemporaryFolder directory;
  expect_written(write_image(layered(1, 2, {{"Y", {1, 2}}}), directory / "a.pfm"));
  EXPECT_EQ(load(directory / "a.pfm"), bytes("Pf\n1 2\n-1.0\n") + bytes({0, 0, 0, 0x40, 0, 0, 0x80, 0x3F}));
}

TEST(WriteHdr, RoundsToSharedExponents) {
  const TemporaryFolder directory;
  const LayeredImage image = layered(6, 1,
                                     {{"R", {1, 0.999F, 1e-40F, -1, std::nanf(""), kInfinity}},
                                      {"G", {0.5F, 0, 0, 0.25F, 0, 1}},
                                      {"B", {0.001F, 0, 0, 0, 0, 0}}});
  expect_written(write_image(image, directory / "a.hdr"));
  const LayeredImage back = read_back(directory / "a.hdr");
  EXPECT_EQ(back.find("R")->values, (std::vector{1.0F, 1.0F, 0.0F, 0.0F, 0.0F, 255.0F * 0x1p119F}));
  EXPECT_EQ(back.find("G")->values, (std::vector{0.5F, 0.0F, 0.0F, 0.25F, 0.0F, 0.0F}));
  EXPECT_EQ(back.find("B")->values, (std::vector{0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F}));
}

TEST(WriteHdr, WhatWasReadIsWrittenUnchanged) {
  const TemporaryFolder directory;
  LayeredImage image = layered(300, 5, {{"R", {}}, {"G", {}}, {"B", {}}});
  for (int i = 0; i < 1500; ++i) {
    const float magnitude = std::ldexp(1.0F, i % 40 - 20);
    image.channels[0].values.push_back(i % 7 < 5 ? 1.0F : magnitude);  // runs and literals
    image.channels[1].values.push_back(magnitude * static_cast<float>(i % 11));
    image.channels[2].values.push_back(3);
  }
  expect_written(write_image(image, directory / "a.hdr"));
  const LayeredImage once = read_back(directory / "a.hdr");
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < 1500; ++i) {
      const float largest = std::max({image.channels[0].values[i], image.channels[1].values[i], 3.0F});
      ASSERT_NEAR(once.channels[c].values[i], image.channels[c].values[i], largest / 255) << c << " " << i;
    }
  }
  expect_written(write_image(once, directory / "b.hdr"));
  EXPECT_EQ(load(directory / "a.hdr"), load(directory / "b.hdr"));
}

TEST(WriteHdr, NarrowPicturesHaveNoRunLengths) {
  const TemporaryFolder directory;
  expect_written(write_image(layered(2, 1, {{"Y", {1, 2}}}), directory / "a.hdr"));
  EXPECT_EQ(load(directory / "a.hdr"), bytes("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n") +
                                           bytes({128, 128, 128, 129, 128, 128, 128, 130}));
}

TEST(ReadLayers, AreLinearAndMultipliedByAlphaOrAsStored) {
  const TemporaryFolder directory;
  store(directory / "a.png", png(1, 1, 8, 6, bytes({0, 188, 255, 0, 51})));
  const LayeredImage linear = read_back(directory / "a.png");
  EXPECT_EQ(linear.find("A")->values[0], 0.2F);
  EXPECT_FLOAT_EQ(linear.find("R")->values[0], static_cast<float>(linear_from_srgb(188 / 255.0) * 0.2));
  EXPECT_EQ(linear.find("G")->values[0], 0.2F);
  const Result<LayeredImage> stored = read_layered_image(directory / "a.png", ChannelValues::stored);
  ASSERT_TRUE(stored);
  EXPECT_EQ(stored->find("R")->values[0], 188 / 255.0F);
  EXPECT_EQ(stored->find("G")->values[0], 1);
  store(directory / "b.png", png(1, 1, 8, 4, bytes({0, 255, 51})));
  const LayeredImage grey = read_back(directory / "b.png");
  EXPECT_EQ(grey.find("Y")->values[0], 0.2F);
  EXPECT_EQ(grey.find("A")->values[0], 0.2F);
}

TEST(ReadLayers, EightBitPicturesSurviveTheWayThroughExr) {
  const TemporaryFolder directory;
  const Image image = gradient<std::uint8_t>(32, 24, 3, PixelType::u8);
  expect_written(write_image(image, directory / "a.exr"));
  const Result<LayeredImage> layers = read_layered_image(directory / "a.exr");
  ASSERT_TRUE(layers);
  expect_written(write_image(*layers, directory / "b.png"));
  EXPECT_EQ(values_u8(*read_image(directory / "b.png")), values_u8(image));
}

TEST(WriteImage, RefusesWhatAFormatCannotHold) {
  const TemporaryFolder directory;
  const LayeredImage depth_only = layered(1, 1, {{"Z", {1}}, {"N.X", {1}}});
  const LayeredImage grey = layered(1, 1, {{"Y", {1}}});
  const auto write = [&](const LayeredImage& image, std::string_view name, const WriteOptions& options = {}) {
    const Result<void> result = write_image(image, directory / name, options);
    EXPECT_TRUE(result || result.error().failure == Failure::bad_usage);
    const std::string prefix = directory.path().string() + "/";
    const std::string text = message_of(result);
    return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
  };
  EXPECT_EQ(write(depth_only, "a.png"), "a.png: a PNG needs channels R, G, B or Y; the picture has Z N.X");
  EXPECT_EQ(write(depth_only, "a.hdr"),
            "a.hdr: a Radiance picture needs channels R, G, B or Y; the picture has Z N.X");
  EXPECT_EQ(write(depth_only, "a.pfm"),
            "a.pfm: a PFM needs channels R, G, B or Y, or a single one; the picture has Z N.X");
  EXPECT_EQ(write(grey, "a.png", {.depth = Depth::half}),
            "a.png: a PNG holds 8 or 16 bits per value, no floating point");
  EXPECT_EQ(write(grey, "a.exr", {.depth = Depth::bits8}),
            "a.exr: an OpenEXR file holds half or single precision, no 8- or 16-bit values");
  EXPECT_EQ(write(grey, "a.pfm", {.depth = Depth::half}), "a.pfm: a PFM holds single precision only");
  EXPECT_EQ(write(grey, "a.hdr", {.depth = Depth::single}),
            "a.hdr: a Radiance picture has one depth only: 8 bits per channel and a shared exponent");
  EXPECT_EQ(write(grey, "a.jpg"), "a.jpg: the name must end in .png, .exr, .hdr or .pfm");
  EXPECT_EQ(write(grey, "png"), "png: the name must end in .png, .exr, .hdr or .pfm");
  EXPECT_EQ(write(grey, "a.png", {.exposure = -1}), "a.png: the exposure must be a factor of 0 or more");
  EXPECT_EQ(write(grey, "a.png", {.exposure = kInfinity}),
            "a.png: the exposure must be a factor of 0 or more");
  EXPECT_EQ(write(grey, "a.png", {.threads = -1}), "a.png: the number of threads must be 0 or more");
  EXPECT_EQ(write({}, "a.png"), "a.png: the picture is 0 x 0 pixels; each side must be from 1 to 65536");
  EXPECT_EQ(write(layered(1, 1, {}), "a.exr"), "a.exr: the picture has no channels");
  EXPECT_EQ(write(layered(1, 1, {{"", {1}}}), "a.exr"), "a.exr: a channel has no name");
  EXPECT_EQ(write(layered(1, 1, {{"Y", {1}}, {"Y", {1}}}), "a.exr"), "a.exr: two channels are named \"Y\"");
  EXPECT_EQ(write(layered(2, 1, {{"Y", {1}}}), "a.exr"),
            "a.exr: channel \"Y\" has 1 values; the picture is 2 x 1");
  LayeredImage reserved = grey;
  reserved.metadata = {{"compression", "none"}};
  EXPECT_EQ(write(reserved, "a.exr"), "a.exr: the metadata key \"compression\" is one of OpenEXR's own");
  reserved.metadata = {{"type", "deep"}};
  EXPECT_EQ(write(reserved, "a.exr"), "a.exr: the metadata key \"type\" is one of OpenEXR's own");
  reserved.metadata = {{"", "value"}};
  EXPECT_EQ(write(reserved, "a.exr"), "a.exr: a metadata key must have 1 to 255 bytes");
  EXPECT_EQ(message_of(write_image(Image(), directory / "a.png")).substr(directory.path().string().size()),
            "/a.png: the picture is empty");
  EXPECT_TRUE(directory.names().empty());
}

TEST(WriteImage, MinusIsPngOnStdout) {
  const TemporaryFolder directory;
  const Image image = gradient<std::uint8_t>(5, 4, 3, PixelType::u8);
  expect_written(write_image(image, directory / "expected.png"));
  const std::string file = directory / "stdout.png";
  const int code = exit_code_of_child([&] {
    const bool is_open = std::freopen(file.c_str(), "wb", stdout) != nullptr;
    return is_open && write_image(image, "-", {.threads = 1}) ? 0 : 1;
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(load(file), load(directory / "expected.png"));
}

}  // namespace
TEST(KeepsLayers, IsSoForOpenExrInAnyCase) {
  EXPECT_TRUE(keeps_layers("picture.exr"));
  EXPECT_TRUE(keeps_layers("picture.EXR"));
  EXPECT_FALSE(keeps_layers("picture.png"));
  EXPECT_FALSE(keeps_layers("-"));
}

}  // namespace laterna
