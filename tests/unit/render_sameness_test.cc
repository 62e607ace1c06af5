// The picture depends on neither threads nor instruction set, and beauty is the sum of its parts, bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "reference/everything.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using reference::everything;
using reference::everything_view;
using reference::same_bits;

constexpr int kWidth = 100, kHeight = 70;  // 2 × 2 tiles, the last ones cut

RenderSettings everything_settings() {
  RenderSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.samples = 4;
  settings.layers = reference::all_layers();
  return settings;
}

constexpr ShadingModel kModels[] = {ShadingModel::papers, ShadingModel::phong, ShadingModel::pbr};

LayeredImage draw(const Renderer& renderer, const RenderSettings& settings) {
  return reference::render(renderer, everything_view(settings.width, settings.height), settings);
}

// Every model, way of passing and way of interpolating.
std::vector<RenderSettings> all_ways() {
  std::vector<RenderSettings> ways;
  for (const ShadingModel model : kModels) {
    for (const Passes passes : {Passes::single, Passes::multi}) {
      for (const Interpolation interpolation : {Interpolation::perspective, Interpolation::affine}) {
        RenderSettings settings = everything_settings();
        settings.shading = model;
        settings.passes = passes;
        settings.layers = reference::all_layers(passes);
        settings.interpolation = interpolation;
        ways.push_back(settings);
      }
    }
  }
  return ways;
}

std::vector<LayeredImage> draw_all_ways(const Renderer& renderer) {
  std::vector<LayeredImage> pictures;
  for (const RenderSettings& settings : all_ways()) pictures.push_back(draw(renderer, settings));
  return pictures;
}

const std::vector<LayeredImage>& expected_pictures() {
  static const std::vector<LayeredImage> pictures =
      draw_all_ways(reference::make_renderer(everything(), 1, InstructionSet::scalar));
  return pictures;
}

void expect_the_same_pictures(const Renderer& renderer) {
  const std::vector<LayeredImage>& expected = expected_pictures();
  const std::vector<LayeredImage> got = draw_all_ways(renderer);
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_TRUE(same_bits(got[i], expected[i])) << "way " << i;
}

TEST(RenderSameness, TheSceneShowsEverything) {
  const LayeredImage& picture = expected_pictures()[8];  // pbr, single pass
  for (const char* name : {"bulb", "ember", "spot", "wide spot", "sun", "moon", "lantern", "clamped",
                           "repeated", "mirrored", "beam", "parallel"}) {
    const Channel* light = picture.find("light." + std::string(name) + ".G");
    const Channel* visibility = picture.find("visibility." + std::string(name));
    const Channel* objects = picture.find("id.object");
    ASSERT_NE(light, nullptr);
    int lit = 0, shadowed = 0;
    for (std::size_t i = 0; i < light->values.size(); ++i) {
      lit += light->values[i] > 0.001F ? 1 : 0;
      shadowed += objects->values[i] >= 0 && visibility->values[i] < 0.9F ? 1 : 0;
    }
    EXPECT_GT(lit, 150) << name;
    // The beam casts no shadows.
    EXPECT_GT(shadowed, std::string(name) == "beam" ? -1 : 50) << name;
  }
  std::set<float> seen;
  for (const float id : picture.find("id.object")->values) seen.insert(id);
  // All but the two of glass and the unseen one; instances count one by one; and the sky.
  EXPECT_EQ(seen.size(), 12U);
}

class RenderWithThreads : public testing::TestWithParam<int> {};
TEST_P(RenderWithThreads, GivesTheBitsOfOneThread) {
  expect_the_same_pictures(reference::make_renderer(everything(), GetParam()));
}
INSTANTIATE_TEST_SUITE_P(Threads, RenderWithThreads, testing::Values(1, 2, 7, 64));

class RenderWithSet : public testing::TestWithParam<InstructionSet> {};
TEST_P(RenderWithSet, GivesTheBitsOfScalar) {
  expect_the_same_pictures(reference::make_renderer(everything(), 3, GetParam()));
}
INSTANTIATE_TEST_SUITE_P(Sets, RenderWithSet, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

TEST(RenderSameness, SingleAndMultiPassesAreTheSameInEveryModel) {
  const std::vector<RenderSettings> ways = all_ways();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (ways[i].passes != Passes::multi) continue;
    LayeredImage single = expected_pictures()[i - 2], multi = expected_pictures()[i];
    ASSERT_EQ(ways[i - 2].shading, ways[i].shading);
    ASSERT_EQ(ways[i - 2].interpolation, ways[i].interpolation);
    std::erase_if(multi.channels, [](const Channel& channel) { return channel.name.starts_with("pass."); });
    EXPECT_LT(multi.channels.size(), expected_pictures()[i].channels.size());
    EXPECT_TRUE(same_bits(single, multi)) << "way " << i;
  }
}

// Row 10: in the lights' declared order.
TEST(RenderSameness, BeautyIsAmbientPlusTheLightsInOrder) {
  const Scene scene = everything();
  for (const int samples : {1, 4}) {
    for (RenderSettings settings : all_ways()) {
      settings.samples = samples;
      settings.layers = {Layer::light};
      static const Renderer renderer = reference::make_renderer(everything());
      const LayeredImage picture = draw(renderer, settings);
      for (const char* channel : {"R", "G", "B"}) {
        std::vector<float> sum = picture.find("ambient." + std::string(channel))->values;
        for (const Light& light : scene.lights) {
          const std::vector<float>& part = picture.find("light." + light.name + "." + channel)->values;
          for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
        }
        ASSERT_EQ(sum, picture.find(channel)->values);
      }
    }
  }
}

TEST(RenderSameness, TheLayersAskedForDoNotChangeThePicture) {
  const Renderer renderer = reference::make_renderer(everything());
  for (const int samples : {1, 2, 4, 8, 16}) {
    RenderSettings settings = everything_settings();
    settings.samples = samples;
    const LayeredImage all = draw(renderer, settings);
    for (const Layer layer : reference::all_layers()) {
      settings.layers = {layer};
      for (const Channel& channel : draw(renderer, settings).channels) {
        const Channel* same = all.find(channel.name);
        ASSERT_NE(same, nullptr) << channel.name;
        ASSERT_TRUE(same_bits({kWidth, kHeight, {channel}, {}}, {kWidth, kHeight, {*same}, {}}))
            << samples << " samples";
      }
    }
  }
}

// A light's layer is the picture of that light alone.
TEST(RenderSameness, EachLightsLayerIsItsOwnPicture) {
  const Scene scene = everything();
  RenderSettings settings = everything_settings();
  settings.layers = {Layer::light};
  const LayeredImage all = draw(reference::make_renderer(scene), settings);
  for (std::size_t kept = 0; kept < scene.lights.size(); ++kept) {
    Scene alone = scene;
    for (std::size_t i = 0; i < alone.lights.size(); ++i) alone.lights[i].enabled = i == kept;
    const LayeredImage picture = draw(reference::make_renderer(std::move(alone)), settings);
    const std::string name = "light." + scene.lights[kept].name;
    for (const char* channel : {".R", ".G", ".B"}) {
      ASSERT_EQ(picture.find(name + channel)->values, all.find(name + channel)->values) << name;
    }
    EXPECT_EQ(picture.find("light." + scene.lights[kept == 0 ? 1 : 0].name + ".R"), nullptr);
  }
}

TEST(RenderSameness, BeautyIsNeverNaN) {
  for (const LayeredImage& picture : expected_pictures()) {
    for (const char* channel : {"R", "G", "B", "A"}) {
      for (const float value : picture.find(channel)->values) ASSERT_TRUE(std::isfinite(value)) << channel;
    }
  }
}

}  // namespace
}  // namespace laterna
