// What Renderer promises of pixels in the caller's memory, of channels, sizes and settings (laterna/render.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/elementary.h"
#include "reference/everything.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using reference::all_layers;
using reference::everything;
using reference::everything_view;

const Renderer& everything_renderer() {
  static const Renderer renderer = reference::make_renderer(everything());
  return renderer;
}

RenderSettings settings_of_target() {
  RenderSettings settings;
  settings.width = 90;
  settings.height = 70;
  return settings;
}

LayeredImage draw_layers(const Renderer& renderer, const RenderSettings& settings) {
  return reference::render(renderer, everything_view(settings.width, settings.height), settings);
}

std::string error_of(const Renderer& renderer, const RenderSettings& settings,
                     const RenderTarget& target = {}) {
  const Result<RenderStatistics> done = renderer.render_into(everything_view(90, 70), settings, target);
  if (done) return "no error";
  EXPECT_EQ(done.error().failure, Failure::bad_usage);
  return to_string(done.error());
}

// ---------------------------------------------------------------------------------------------- the caller's memory

TEST(RenderTarget, ChannelsGoWhereTheCallerWantsThemAndNowhereElse) {
  RenderSettings settings = settings_of_target();
  settings.layers = {Layer::depth, Layer::light};
  const LayeredImage expected = draw_layers(everything_renderer(), settings);
  constexpr std::size_t kStride = 101, kGuard = 17;
  constexpr float kUntouched = -77;
  for (const char* name : {"R", "A", "Z", "light.sun.G"}) {
    std::vector<float> memory(kGuard + kStride * 70 + kGuard, kUntouched);
    const RenderTarget target = {{}, {{name, memory.data() + kGuard, kStride}}};
    ASSERT_TRUE(everything_renderer().render_into(everything_view(90, 70), settings, target));
    const Channel& channel = *expected.find(name);
    for (std::size_t i = 0; i < memory.size(); ++i) {
      const std::size_t offset = i - kGuard, x = offset % kStride, y = offset / kStride;
      const bool is_pixel = i >= kGuard && y < 70 && x < 90;
      ASSERT_EQ(memory[i], is_pixel ? channel.values[y * 90 + x] : kUntouched) << name << " at " << i;
    }
  }
}

TEST(RenderTarget, OneChannelMayBeWantedTwice) {
  std::vector<float> a(90 * 70), b(90 * 70);
  const RenderTarget target = {{}, {{"G", a.data(), 90}, {"G", b.data(), 90}}};
  ASSERT_TRUE(everything_renderer().render_into(everything_view(90, 70), settings_of_target(), target));
  EXPECT_EQ(a, b);
  EXPECT_NE(a, std::vector<float>(90 * 70));
}

TEST(RenderTarget, ATargetOfNothingStillGivesStatistics) {
  const Result<RenderStatistics> done =
      everything_renderer().render_into(everything_view(90, 70), settings_of_target(), {});
  ASSERT_TRUE(done);
  EXPECT_GT(done->triangles, 1000U);
  EXPECT_GT(done->triangles_drawn, 100U);
  EXPECT_LE(done->triangles_drawn, done->triangles);
}

// "sRGB-encoded"; "with alpha, colour not premultiplied"; "exposure: factor on linear light before encoding".
TEST(RenderTarget, EightBitPixelsAreTheEncodedBeauty) {
  RenderSettings settings = settings_of_target();
  settings.samples = 4;
  const LayeredImage linear = draw_layers(everything_renderer(), settings);
  for (const int channels : {3, 4}) {
    for (const float exposure : {1.0F, 2.5F}) {
      const std::size_t stride = 90 * static_cast<std::size_t>(channels) + 13;
      std::vector<std::uint8_t> memory(stride * 70, 201);
      RenderTarget target;
      target.color8 = ColorTarget8{memory.data(), channels, stride, exposure};
      ASSERT_TRUE(everything_renderer().render_into(everything_view(90, 70), settings, target));
      int partly_covered = 0;
      for (std::size_t i = 0; i < memory.size(); ++i) {
        const std::size_t x = i % stride / static_cast<std::size_t>(channels), y = i / stride,
                          c = i % stride % static_cast<std::size_t>(channels);
        if (x >= 90) {
          ASSERT_EQ(memory[i], 201) << "beyond the row";
          continue;
        }
        const double alpha = linear.find("A")->values[y * 90 + x];
        partly_covered += alpha > 0 && alpha < 1 && c == 0 ? 1 : 0;
        double expected = 255 * alpha;
        if (c < 3) {
          double value = linear.channels[c].values[y * 90 + x] * static_cast<double>(exposure);
          if (channels == 4) value = alpha > 0 ? value / alpha : 0;
          expected = 255 * std::clamp(srgb_from_linear(value), 0.0, 1.0);
        }
        ASSERT_NEAR(memory[i], expected, 0.5 + 1e-3) << x << ", " << y << " channel " << c;
      }
      EXPECT_GT(partly_covered, 20);
    }
  }
}

TEST(RenderTarget, TargetsThatCannotHoldThePictureAreRefused) {
  std::vector<float> memory(90 * 70);
  std::vector<std::uint8_t> bytes(90 * 70 * 4);
  const Renderer& renderer = everything_renderer();
  // The target's pointer is one to write to. NOLINTNEXTLINE(readability-non-const-parameter)
  const auto with_channel = [&](const char* name, float* pixels, std::size_t stride) {
    return error_of(renderer, settings_of_target(), {{}, {{name, pixels, stride}}});
  };
  EXPECT_EQ(with_channel("Z", memory.data(), 90), "these settings produce no channel \"Z\"");
  EXPECT_EQ(with_channel("r", memory.data(), 90), "these settings produce no channel \"r\"");
  EXPECT_EQ(with_channel("R", memory.data(), 89), "the target of channel \"R\" has no memory for a row");
  EXPECT_EQ(with_channel("R", nullptr, 90), "the target of channel \"R\" has no memory for a row");
  const auto with_color = [&](std::uint8_t* pixels, int channels, std::size_t stride) {
    RenderTarget target;
    target.color8 = ColorTarget8{pixels, channels, stride, 1};
    return error_of(renderer, settings_of_target(), target);
  };
  EXPECT_EQ(with_color(bytes.data(), 2, 400), "an 8-bit target has 3 or 4 channels");
  EXPECT_EQ(with_color(bytes.data(), 3, 269), "the 8-bit target has no memory for a row");
  EXPECT_EQ(with_color(bytes.data(), 4, 270), "the 8-bit target has no memory for a row");
  EXPECT_EQ(with_color(nullptr, 3, 270), "the 8-bit target has no memory for a row");
}

// ---------------------------------------------------------------------------------------------- channels

TEST(RenderChannels, NamesAreThoseOfThePictureInItsOrder) {
  for (const Passes passes : {Passes::single, Passes::multi}) {
    RenderSettings settings = settings_of_target();
    settings.passes = passes;
    for (const std::vector<Layer>& layers :
         {std::vector<Layer>{}, {Layer::light}, {Layer::object, Layer::uv}, all_layers(passes)}) {
      settings.layers = layers;
      std::vector<std::string> drawn;
      for (const Channel& channel : draw_layers(everything_renderer(), settings).channels)
        drawn.push_back(channel.name);
      EXPECT_EQ(everything_renderer().channel_names(settings), drawn);
      EXPECT_EQ(std::set<std::string>(drawn.begin(), drawn.end()).size(), drawn.size());
    }
  }
}

TEST(RenderChannels, EachLayerHasTheChannelsItsDescriptionNames) {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(1));
  Light lamp;
  lamp.name = "lamp";
  lamp.type = LightType::projector;
  reference::add_light(scene, lamp, {0, 3, 0.1}, {0, 0, 0});
  Light sun;
  sun.name = "sun";
  sun.type = LightType::directional;
  reference::add_light(scene, sun, {0, 3, 1}, {0, 0, 0});
  const Renderer renderer = reference::make_renderer(std::move(scene));
  RenderSettings settings;
  settings.passes = Passes::multi;
  const auto names = [&](Layer layer) {
    settings.layers = {layer};
    std::vector<std::string> all = renderer.channel_names(settings);
    EXPECT_EQ(std::vector<std::string>(all.begin(), all.begin() + 4),
              (std::vector<std::string>{"R", "G", "B", "A"}));
    return std::vector<std::string>(all.begin() + 4, all.end());
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(Layer::light), (Names{"ambient.R", "ambient.G", "ambient.B", "light.lamp.R", "light.lamp.G",
                                        "light.lamp.B", "light.sun.R", "light.sun.G", "light.sun.B"}));
  EXPECT_EQ(names(Layer::visibility), (Names{"visibility.lamp", "visibility.sun"}));
  EXPECT_EQ(names(Layer::uv), (Names{"uv.lamp.u", "uv.lamp.v"}));
  EXPECT_EQ(names(Layer::lux), Names{"lux.Y"});
  EXPECT_EQ(names(Layer::luminance), Names{"luminance.Y"});
  EXPECT_EQ(names(Layer::pixel_density), Names{"pixel_density.lamp"});
  EXPECT_EQ(names(Layer::depth), Names{"Z"});
  EXPECT_EQ(names(Layer::position), (Names{"P.X", "P.Y", "P.Z"}));
  EXPECT_EQ(names(Layer::normal), (Names{"N.X", "N.Y", "N.Z"}));
  EXPECT_EQ(names(Layer::albedo), (Names{"albedo.R", "albedo.G", "albedo.B"}));
  EXPECT_EQ(names(Layer::object), Names{"id.object"});
  const Names passes = names(Layer::passes);
  EXPECT_GT(passes.size(), 8U);
  for (const std::string& name : passes) EXPECT_TRUE(name.starts_with("pass.")) << name;
}

// ---------------------------------------------------------------------------------------------- sizes and settings

// A wall all over the picture: every pixel of any picture shows it.
TEST(RenderSize, ThinAndTinyPicturesAreDrawn) {
  Scene scene;
  reference::add_object(scene, "wall", reference::wall(1e5F, 1e5F, -2), {0.5F, 0.25F, 0.125F});
  scene.ambient = glm::vec3(1);
  scene.ambient_is_set = true;
  const Renderer renderer = reference::make_renderer(std::move(scene));
  for (const auto& [width, height] :
       {std::pair{1, 1}, {1, 16384}, {16384, 1}, {63, 65}, {64, 64}, {129, 3}}) {
    for (const int samples : {1, 16}) {
      RenderSettings settings;
      settings.width = width;
      settings.height = height;
      settings.samples = samples;
      settings.layers = {Layer::depth};
      // Thin pictures see as far to their short sides as to their long ones.
      View view = reference::look({0, 0, 0}, {0, 0, -1}, 60, 1);
      const LayeredImage picture = reference::render(renderer, view, settings);
      ASSERT_EQ(picture.channels[0].values.size(),
                static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
      for (std::size_t i = 0; i < picture.channels[0].values.size(); ++i) {
        ASSERT_EQ(picture.find("R")->values[i], 0.5F) << width << "x" << height << " " << i;
        ASSERT_EQ(picture.find("B")->values[i], 0.125F);
        ASSERT_EQ(picture.find("A")->values[i], 1.0F);
        ASSERT_NEAR(picture.find("Z")->values[i], 2, 1e-6);
      }
    }
  }
}

TEST(RenderSize, LargerAndSmallerAreRefused) {
  const Renderer& renderer = everything_renderer();
  for (const auto& [width, height] : {std::pair{0, 10}, {10, 0}, {-1, 10}, {16385, 10}, {10, 16385}}) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    EXPECT_EQ(error_of(renderer, settings), "a picture's width and height must be from 1 to 16384, not " +
                                                std::to_string(width) + "x" + std::to_string(height));
    EXPECT_FALSE(renderer.render(everything_view(90, 70), settings));
  }
}

TEST(RenderSettingsCheck, SamplesArePowersOfTwoUpToSixteen) {
  const Renderer& renderer = everything_renderer();
  for (int samples = -1; samples <= 33; ++samples) {
    RenderSettings settings = settings_of_target();
    settings.samples = samples;
    const bool is_allowed = samples == 1 || samples == 2 || samples == 4 || samples == 8 || samples == 16;
    const std::string refusal = "samples per pixel must be 1, 2, 4, 8 or 16, not " + std::to_string(samples);
    EXPECT_EQ(error_of(renderer, settings), is_allowed ? "no error" : refusal);
  }
}

TEST(RenderSettingsCheck, AnisotropyGoesFromOneToSixteen) {
  for (const int probes : {-1, 0, 1, 16, 17}) {
    RenderSettings settings = settings_of_target();
    settings.anisotropy = probes;
    const std::string refusal = "anisotropy must be from 1 to 16, not " + std::to_string(probes);
    EXPECT_EQ(error_of(everything_renderer(), settings), probes >= 1 && probes <= 16 ? "no error" : refusal);
  }
}

TEST(RenderSettingsCheck, ViewsThatSeeNothingAreRefused) {
  const auto error_with = [](auto change) {
    View view = everything_view(90, 70);
    change(view);
    const Result<LayeredImage> done = everything_renderer().render(view, settings_of_target());
    return done ? "no error" : to_string(done.error());
  };
  EXPECT_EQ(error_with([](View&) {}), "no error");
  EXPECT_EQ(error_with([](View& v) { v.projection.near = 0; }), "the view: near must be greater than zero");
  EXPECT_EQ(error_with([](View& v) { v.projection.far = 0.01; }), "the view: near must be less than far");
  EXPECT_EQ(error_with([](View& v) { v.projection.left = 2, v.projection.right = 1; }),
            "the view: the frustum has no width or no height");
  EXPECT_EQ(error_with([](View& v) { v.projection.top = std::nan(""); }),
            "the view: the frustum's sides must be finite (is the field of view 180° or more?)");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::string bad_place =
      "the view: its position must be finite, and no farther than 1e9 m from the origin";
  for (int i = 0; i < 3; ++i) {
    for (const double value : {static_cast<double>(std::nanf("")), kInfinity, -kInfinity, 2e12}) {
      EXPECT_EQ(error_with([&](View& v) { v.pose.position_ws[i] = value; }), bad_place);
    }
  }
  const std::string bad_axes = "the view: the columns of its rotation must be perpendicular unit vectors";
  EXPECT_EQ(error_with([](View& v) { v.pose.world_from_view_rotation[1] = glm::dvec3(0); }), bad_axes);
  EXPECT_EQ(error_with([](View& v) { v.pose.world_from_view_rotation[2].y = std::nan(""); }), bad_axes);
  EXPECT_EQ(error_with([](View& v) { v.pose.world_from_view_rotation *= 1.001; }), bad_axes);
  EXPECT_EQ(error_with([](View& v) { v.pose.world_from_view_rotation[0] *= -1; }),
            "the view: its rotation must be right-handed, not mirrored");
}

TEST(RendererOptionsCheck, ThreadsAndInstructionSetsThatAreNotThereAreRefused) {
  for (const int threads : {-1, 1025}) {
    const Result<Renderer> renderer = Renderer::create(everything(), {threads, {}});
    ASSERT_FALSE(renderer);
    EXPECT_EQ(to_string(renderer.error()),
              "threads must be from 0 (one per processor) to 1024, not " + std::to_string(threads));
  }
  for (const InstructionSet set : {InstructionSet::scalar, InstructionSet::sse4, InstructionSet::avx2,
                                   InstructionSet::avx512, InstructionSet::neon}) {
    const std::vector<InstructionSet> known = supported_instruction_sets();
    const bool is_known = std::find(known.begin(), known.end(), set) != known.end();
    const Result<Renderer> renderer = Renderer::create(everything(), {1, set});
    ASSERT_EQ(renderer.has_value(), is_known) << name_of(set);
    if (is_known) {
      EXPECT_EQ(renderer->instruction_set(), set);
      EXPECT_EQ(renderer->threads(), 1);
    } else {
      EXPECT_EQ(renderer.error().failure, Failure::bad_usage);
      EXPECT_NE(to_string(renderer.error()).find("has no " + std::string(name_of(set)) + ": it has scalar"),
                std::string::npos);
    }
  }
}

TEST(AutomaticExposure, IsMiddleGreyOverTheLogMean) {
  LayeredImage image;
  image.width = 2, image.height = 1;
  image.channels = {{"R", {0.5F, 2}}, {"G", {0.5F, 2}}, {"B", {0.5F, 2}}, {"A", {1, 1}}};
  EXPECT_NEAR(automatic_exposure(image), 0.18, 1e-3);  // the log-mean of 1/2 and 2 is 1
  for (Channel& channel : image.channels) channel.values.assign(2, 0);
  EXPECT_EQ(automatic_exposure(image), 1.0F);
}

}  // namespace
}  // namespace laterna
