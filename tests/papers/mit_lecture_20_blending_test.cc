// MIT 6.837, lecture 20, slides 9, 16 and 17: several textures and slides, multipass against multitexture, blending.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "reference/blending.h"
#include "reference/projector_scenes.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

constexpr int kPictureSide = 24;
const std::string kChannels[] = {"R", "G", "B"};

// A wall that fills the picture and shows its base colour as it is.
Scene bare_wall(const glm::vec3& color = glm::vec3(1)) {
  Scene scene;
  add_object(scene, "wall", wall(1, 1, 0), color);
  scene.materials[0].unlit = true;
  scene.ambient_is_set = true;
  return scene;
}

LayeredImage picture_of(Scene scene, Passes passes = Passes::single,
                        ShadingModel model = ShadingModel::papers,
                        InstructionSet set = best_instruction_set()) {
  RenderSettings settings = papers_settings(kPictureSide, kPictureSide);
  settings.shading = model;
  settings.passes = passes;
  settings.layers = {Layer::light, Layer::albedo};
  return render(make_renderer(std::move(scene), 0, set), square_on(1, 1), settings);
}

bool same_bits(const LayeredImage& a, const LayeredImage& b) {
  return std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(),
                    [](const Channel& x, const Channel& y) {
                      return x.name == y.name && std::memcmp(x.values.data(), y.values.data(),
                                                             x.values.size() * sizeof(float)) == 0;
                    });
}

// Four pictures without a pattern in common.
std::vector<int> add_four_pictures(Scene& scene) {
  std::vector<int> pictures;
  pictures.reserve(4);
  for (int n = 0; n < 4; ++n) {
    pictures.push_back(add_linear_picture(scene, 8 + n, 8, [n](int x, int y) {
      return glm::vec3((x * 37 + y * 11 + n * 5) % 17, (x * 7 + y * 29 + n * 3) % 13, (x + y + n) % 5) /
             glm::vec3(17, 13, 5);
    }));
  }
  return pictures;
}

SurfaceLayer layer_of(BlendMode mode, int picture, float opacity = 1) {
  SurfaceLayer layer;
  layer.texture.picture = picture;
  layer.opacity = opacity;
  layer.blend = mode;
  return layer;
}

const BlendMode kFour[] = {BlendMode::modulate, BlendMode::add, BlendMode::difference, BlendMode::screen};

// Row 67: four passes, each a picture of one texture alone, put together outside by plain loops.
TEST(MitLecture20Blending, FourLayersInOnePassAreFourPassesBitForBit) {
  Scene stacked = bare_wall();
  std::vector<int> pictures = add_four_pictures(stacked);
  const float opacities[] = {1, 0.75F, 1, 0.3F};
  std::vector<Colour<float>> buffer(kPictureSide * kPictureSide, {1, 1, 1});
  for (std::size_t n = 0; n < 4; ++n) {
    stacked.materials[0].layers.push_back(layer_of(kFour[n], pictures[n], opacities[n]));
    Scene alone = bare_wall();
    alone.materials[0].base_color_texture.picture = add_four_pictures(alone)[n];
    const LayeredImage pass = picture_of(std::move(alone));
    for (std::size_t i = 0; i < buffer.size(); ++i) {
      const Colour<float> t = {pass.channels[0].values[i], pass.channels[1].values[i],
                               pass.channels[2].values[i]};
      buffer[i] = lay<float>(kFour[n], buffer[i], t, 1, opacities[n]);
    }
  }
  const LayeredImage one_pass = picture_of(stacked);
  const LayeredImage many = picture_of(std::move(stacked), Passes::multi);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t i = 0; i < buffer.size(); ++i)
      ASSERT_EQ(one_pass.channels[channel].values[i], buffer[i][channel])
          << kChannels[channel] << " at " << i;
  }
  EXPECT_TRUE(same_bits(one_pass, many));
}

// Solids with layers of all kinds, glass among them, lit by lights of all modes.
Scene layered_room() {
  Scene scene = torus_and_box(1).scene;
  const std::vector<int> pictures = add_four_pictures(scene);
  Light paint = projector("paint", 0.4, 0.4, pictures[0]);
  paint.enabled = false;
  add_light(scene, paint, {2, 4, 3}, {0, 0.5, 0});
  const int painter = static_cast<int>(scene.lights.size()) - 1;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    std::vector<SurfaceLayer>& layers = scene.materials[m].layers;
    for (const BlendModeDescription& mode : list_blend_modes()) {
      SurfaceLayer layer = layer_of(mode.mode, -1, 0.35F);
      layer.color = {0.9F, 0.4F, 0.6F};
      if ((static_cast<std::size_t>(mode.mode) + m) % 2 == 0) layer.projector = painter;
      layer.occluded = m != 1;
      if (layers.size() < 4 + 3 * m) layers.push_back(layer);
    }
  }
  Mesher pane;
  pane.quad({-1, 0, 1.5F}, {1, 0, 1.5F}, {1, 1.5F, 1.5F}, {-1, 1.5F, 1.5F});
  add_object(scene, "pane", pane.primitive, {0.5F, 0.8F, 0.6F});
  Material& glass = scene.materials.back();
  glass.alpha_mode = AlphaMode::blend;
  glass.base_color.a = 0.4F;
  glass.layers.push_back(layer_of(BlendMode::modulate, pictures[1]));
  for (const BlendModeDescription& mode : list_blend_modes()) {
    if (!find_light_fault(mode.mode).empty()) continue;
    Light light = projector(std::string(mode.name), 0.3, 0.3, pictures[2]);
    light.color = {0.9F, 1, 0.7F};
    light.intensity = 12;
    light.blend = mode.mode;
    light.shadow.technique = mode.mode == BlendMode::min ? ShadowTechnique::none : ShadowTechnique::exact;
    add_light(scene, light, {2 - 0.4 * static_cast<double>(mode.mode), 4, 4}, {0.3, 0.3, 0});
  }
  return scene;
}

int find_node(const Scene& scene, const std::string& name) {
  const auto found =
      std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) { return n.name == name; });
  return static_cast<int>(found - scene.nodes.begin());
}

// Row 68, and D5: beauty stays the sum of its layers, whatever the modes are.
TEST(MitLecture20Blending, ManyPassesGiveOnePassesPictureBitForBit) {
  const View camera = torus_and_box(1).camera;
  for (const ShadingModel model : {ShadingModel::papers, ShadingModel::phong, ShadingModel::pbr}) {
    RenderSettings settings = papers_settings(48, 48);
    settings.shading = model;
    settings.samples = 2;
    settings.layers = {Layer::light, Layer::albedo};
    const Renderer renderer = make_renderer(layered_room());
    const LayeredImage single = render(renderer, camera, settings);
    RenderSettings multi = settings;
    multi.passes = Passes::multi;
    EXPECT_TRUE(same_bits(single, render(renderer, camera, multi)));
    bool some_take_light_away = false;
    for (const std::string& channel : kChannels) {
      std::vector<float> sum = single.find("ambient." + channel)->values;
      for (const Light& light : renderer.scene().lights) {
        if (!light.enabled) continue;
        const std::vector<float>& part = single.find("light." + light.name + "." + channel)->values;
        for (std::size_t i = 0; i < sum.size(); ++i) {
          sum[i] += part[i];
          some_take_light_away |= part[i] < 0;
        }
      }
      EXPECT_EQ(sum, single.find(channel)->values);
    }
    EXPECT_TRUE(some_take_light_away);
    settings.layers.clear();
    for (const InstructionSet set : supported_instruction_sets()) {
      const Renderer other = make_renderer(layered_room(), 3, set);
      EXPECT_EQ(render(other, camera, settings).find("R")->values, single.find("R")->values)
          << "without layers, on three threads";
    }
  }
}

// Light is taken away from what is there, and no more: of one sample of opaque surfaces to the last bit, where several are
// averaged, or glass is laid over them, but for rounding.
TEST(MitLecture20Blending, NothingIsDarkerThanBlack) {
  const View camera = torus_and_box(1).camera;
  for (const int samples : {1, 4}) {
    Scene scene = layered_room();
    if (samples == 1) scene.nodes[static_cast<std::size_t>(find_node(scene, "pane"))].visible = false;
    scene.ambient = glm::vec3(1e-4F);
    RenderSettings settings = papers_settings(48, 48);
    settings.samples = samples;
    settings.shading = ShadingModel::pbr;
    const LayeredImage image = render(make_renderer(std::move(scene)), camera, settings);
    for (const std::string& channel : kChannels) {
      const std::vector<float>& values = image.find(channel)->values;
      EXPECT_GE(*std::min_element(values.begin(), values.end()), samples == 1 ? 0 : -1e-6F);
    }
  }
}

// Row 68: N passes into a frame buffer of 8 bits, none of which saturates it. Each rounds by half a code at most.
TEST(MitLecture20Blending, PassesOfEightBitsAreOffByHalfACodeEach) {
  for (const int lights : {2, 5}) {
    Scene scene;
    add_object(scene, "wall", wall(1, 1, 0), {0.9F, 0.8F, 0.7F});
    scene.ambient_is_set = true;
    const std::vector<int> pictures = add_four_pictures(scene);
    for (int n = 0; n < lights; ++n) {
      Light light =
          projector("light " + std::to_string(n), 0.2, 0.2, pictures[static_cast<std::size_t>(n % 4)]);
      light.color = glm::vec3(0.95F / static_cast<float>(lights));
      light.outside = Outside::repeat;
      add_light(scene, light, {0.1 * n, 0, 4}, {0, 0, 0});
    }
    const LayeredImage image = picture_of(std::move(scene), Passes::multi);
    const auto code = [](float value) { return static_cast<int>(std::floor(255 * value + 0.5F)); };
    int worst = 0;
    for (std::size_t i = 0; i < kPictureSide * kPictureSide; ++i) {
      int buffer = 0;
      for (int n = 0; n < lights; ++n)
        buffer += code(image.find("light.light " + std::to_string(n) + ".G")->values[i]);
      ASSERT_LE(buffer, 255);
      worst = std::max(worst, std::abs(buffer - code(image.find("G")->values[i])));
    }
    EXPECT_LE(worst, (lights + 1) / 2);
    EXPECT_GT(worst, 0) << "eight bits do lose something";
  }
}

struct Truth {
  BlendMode mode;
  Colour<float> at_full;   // c = (0.75, 0.5, 0.25), t = (0.5, 0.25, 1)
  Colour<float> at_three;  // opacity 3/4 … of c and what is above
};

// Rows 69 and 70: the truth table, worked out by hand.
const Truth kTruths[] = {
    {BlendMode::over, {0.5F, 0.25F, 1}, {0.5625F, 0.3125F, 0.8125F}},
    {BlendMode::modulate, {0.375F, 0.125F, 0.25F}, {0.46875F, 0.21875F, 0.25F}},
    {BlendMode::add, {1.25F, 0.75F, 1.25F}, {1.125F, 0.6875F, 1}},
    {BlendMode::alpha_attenuate, {0.75F, 0.5F, 0.25F}, {0.75F, 0.5F, 0.25F}},
    {BlendMode::subtract, {0.25F, 0.25F, 0}, {0.375F, 0.3125F, 0.0625F}},
    {BlendMode::reverse_subtract, {0, 0, 0.75F}, {0.1875F, 0.125F, 0.625F}},
    {BlendMode::difference, {0.25F, 0.25F, 0.75F}, {0.375F, 0.3125F, 0.625F}},
    {BlendMode::screen, {0.875F, 0.625F, 1}, {0.84375F, 0.59375F, 0.8125F}},
    {BlendMode::min, {0.5F, 0.25F, 0.25F}, {0.5625F, 0.3125F, 0.25F}},
    {BlendMode::max, {0.75F, 0.5F, 1}, {0.75F, 0.5F, 0.8125F}},
    // 4 (¼ · 0 + 0 · −¼ + −¼ · ½) = −½: below 0.
    {BlendMode::dot3, {0, 0, 0}, {0.1875F, 0.125F, 0.0625F}},
};

TEST(MitLecture20Blending, TruthTableOfLayers) {
  ASSERT_EQ(std::size(kTruths), list_blend_modes().size());
  for (std::size_t m = 0; m < std::size(kTruths); ++m) {
    const Truth& truth = kTruths[m];
    ASSERT_EQ(list_blend_modes()[m].mode, truth.mode);
    for (const auto& [opacity, expected] :
         {std::pair{1.0F, truth.at_full}, std::pair{0.75F, truth.at_three}}) {
      Scene scene = bare_wall({0.75F, 0.5F, 0.25F});
      SurfaceLayer layer = layer_of(truth.mode, -1, opacity);
      layer.color = {0.5F, 0.25F, 1};
      scene.materials[0].layers = {layer};
      const LayeredImage image = picture_of(std::move(scene));
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(at(image, kChannels[k], 3, 5), expected[k]) << list_blend_modes()[m].name << kChannels[k];
        EXPECT_EQ(at(image, "albedo." + kChannels[k], 3, 5), expected[k]);
      }
    }
  }
}

// Row 70: directions kept as colours, 0.5 + 0.5 n: the same, 60° apart, opposite.
TEST(MitLecture20Blending, Dot3IsTheCosineOfTwoDirections) {
  const auto kept = [](const glm::vec3& n) { return 0.5F + 0.5F * n; };
  const glm::vec3 n(0.6F, 0, 0.8F),
      apart(0.5F * 0.6F - 0.8660254F * 0.8F, 0, 0.5F * 0.8F + 0.8660254F * 0.6F);
  for (const auto& [other, cosine] : {std::pair{n, 1.0F}, std::pair{apart, 0.5F}, std::pair{-n, 0.0F}}) {
    Scene scene = bare_wall(kept(n));
    SurfaceLayer layer = layer_of(BlendMode::dot3, -1);
    layer.color = kept(other);
    scene.materials[0].layers = {layer};
    EXPECT_NEAR(at(picture_of(std::move(scene)), "R", 7, 7), cosine, 1e-6);
  }
}

// Row 69: alpha of the picture itself: 3/5 of 255 are 153.
TEST(MitLecture20Blending, AlphaIsThePicturesOwn) {
  for (const auto& [mode, expected] : {std::pair{BlendMode::over, 0.75F * 0.4F + 1 * 0.6F},
                                       std::pair{BlendMode::alpha_attenuate, 0.75F * 0.6F}}) {
    Scene scene = bare_wall({0.75F, 0.75F, 0.75F});
    auto pixels = std::make_shared<Image>(2, 2, 4, PixelType::u8, Transfer::srgb);
    std::ranges::fill(pixels->values<std::uint8_t>(), std::uint8_t{255});
    for (std::size_t i = 3; i < 16; i += 4) pixels->values<std::uint8_t>()[i] = 153;
    Picture picture;
    picture.name = "three fifths";
    picture.pixels = pixels;
    scene.pictures.push_back(picture);
    scene.materials[0].layers = {layer_of(mode, 0)};
    EXPECT_NEAR(at(picture_of(std::move(scene)), "G", 9, 9), expected, 1e-6);
  }
}

// A wall of (0.5, 0.75, 1) under a first slide of `first` and a second of `second`, both evenly coloured.
Scene two_slides(const Colour<float>& first, const Colour<float>& second, BlendMode mode, double candela) {
  Scene scene;
  add_object(scene, "wall", wall(1, 1, 0), {0.5F, 0.75F, 1});
  scene.ambient_is_set = true;
  for (const auto& [name, color] : {std::pair{"first", first}, std::pair{"second", second}}) {
    const int slide = add_linear_picture(
        scene, 2, 2, [&color = color](int, int) { return glm::vec3(color[0], color[1], color[2]); });
    Light light = projector(name, 0.3, 0.3, slide);
    light.intensity = candela;
    if (name == std::string("second")) light.blend = mode;
    add_light(scene, light, {0, 0, 4}, {0, 0, 0});
  }
  return scene;
}

// Rows 69 and 70 of light: what falls on the wall is the formula of the two slides.
TEST(MitLecture20Blending, TruthTableOfTwoSlidesAtOnce) {
  const glm::vec3 wall_color(0.5F, 0.75F, 1);
  for (const Truth& truth : kTruths) {
    if (!find_light_fault(truth.mode).empty()) continue;
    const LayeredImage image = picture_of(two_slides({0.75F, 0.5F, 0.25F}, {0.5F, 0.25F, 1}, truth.mode, 1));
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      EXPECT_NEAR(at(image, kChannels[i], 12, 12), wall_color[k] * truth.at_full[i], 1e-6)
          << list_blend_modes()[static_cast<std::size_t>(truth.mode)].name;
    }
  }
}

// In the physical models a slide filters what the lights before it give, by any number of candela, and takes away what it
// would have added.
TEST(MitLecture20Blending, GobosFilterAndNegativeLightTakesAwayInEveryModel) {
  for (const ShadingModel model : {ShadingModel::phong, ShadingModel::pbr}) {
    const auto light_at = [&](const Colour<float>& first, const Colour<float>& second, BlendMode mode) {
      return at(picture_of(two_slides(first, second, mode, 40), Passes::single, model), "G", 12, 12);
    };
    const Colour<float> black = {0, 0, 0};
    const float first = light_at({1, 0.5F, 1}, black, BlendMode::add);
    const float second = light_at({1, 0.25F, 1}, black, BlendMode::add);
    ASSERT_GT(first, 0.1F);
    EXPECT_NEAR(light_at({1, 0.5F, 1}, {1, 0.25F, 1}, BlendMode::modulate), first / 4, 1e-6);
    EXPECT_NEAR(light_at({1, 0.5F, 1}, {1, 0.25F, 1}, BlendMode::subtract), first - second, 1e-6);
    EXPECT_NEAR(light_at({1, 0.25F, 1}, {1, 0.5F, 1}, BlendMode::difference), first - second, 1e-6);
    EXPECT_EQ(light_at({1, 0.25F, 1}, {1, 0.5F, 1}, BlendMode::subtract), 0);
    EXPECT_EQ(light_at({1, 0.5F, 1}, {1, 1, 1}, BlendMode::modulate), first) << "white changes nothing";
  }
}

// A projector that modulates passes light only where its own would arrive: not beside its frame, not in its shadow.
TEST(MitLecture20Blending, WhatAGoboDoesNotReachIsDark) {
  Scene scene;
  add_object(scene, "wall", wall(1, 1, 0));
  Mesher card;
  card.quad({0.1F, -0.1F, 3}, {0.3F, -0.1F, 3}, {0.3F, 0.1F, 3}, {0.1F, 0.1F, 3});
  add_object(scene, "card", card.primitive);
  scene.nodes.back().visible = false;
  scene.ambient_is_set = true;
  add_light(scene, projector("first", 0.3, 0.3), {0, 0, 4}, {0, 0, 0});
  scene.lights.back().shadow.technique = ShadowTechnique::none;
  Light gobo = projector("gobo", 0.15, 0.3);
  gobo.blend = BlendMode::modulate;
  gobo.shadow.technique = ShadowTechnique::exact;
  add_light(scene, gobo, {0, 0, 4}, {0, 0, 0});
  const LayeredImage image = picture_of(std::move(scene));
  EXPECT_EQ(at(image, "R", 8, 12), 1);   // x = −0.29
  EXPECT_EQ(at(image, "R", 2, 12), 0);   // x = −0.79: beside the frame, which ends at ±0.6
  EXPECT_EQ(at(image, "R", 18, 12), 0);  // x = 0.54: in the card's shadow, from 0.4 on
  EXPECT_EQ(at(image, "R", 18, 4), 1);   // above it
  EXPECT_EQ(at(image, "light.gobo.R", 18, 12), -1);
}

// Row 60 with layers: a slide as paint. It is on what it sees; a surface behind another keeps its colour, unless the layer
// is told not to mind, and the back of the projector and what turns away are bare.
TEST(MitLecture20Blending, SlidesArePaintOnWhatTheySee) {
  for (const bool occluded : {true, false}) {
    Scene scene = bare_wall({0.25F, 0.25F, 0.25F});
    Mesher card;
    card.quad({-0.1F, -0.1F, 3}, {0.1F, -0.1F, 3}, {0.1F, 0.1F, 3}, {-0.1F, 0.1F, 3});
    add_object(scene, "card", card.primitive);
    scene.nodes.back().visible = false;
    const int slide = add_linear_picture(
        scene, 2, 1, [](int x, int) { return x == 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1); });
    Light painter = projector("painter", 0.15, 0.15, slide);
    painter.enabled = false;
    painter.intensity = 0;
    add_light(scene, painter, {0, 0, 4}, {0, 0, 0});
    SurfaceLayer layer = layer_of(BlendMode::over, -1);
    layer.projector = 0;
    layer.occluded = occluded;
    scene.materials[0].layers = {layer};
    const LayeredImage image = picture_of(std::move(scene));
    EXPECT_EQ(at(image, "R", 1, 1), 0.25F) << "beside the frame";
    EXPECT_EQ(at(image, "R", 6, 6), 1) << "left of the middle, in the frame to ±0.6";
    EXPECT_EQ(at(image, "B", 17, 6), 1);
    EXPECT_NEAR(at(image, "R", 10, 12) + at(image, "B", 10, 12), occluded ? 0.5F : 1, 1e-6)
        << "behind the card";
  }
}

TEST(MitLecture20Blending, PaintIsOnTheSideThatFacesTheProjector) {
  Scene scene = bare_wall({0.25F, 0.25F, 0.25F});
  scene.materials[0].double_sided = true;
  add_light(scene, projector("behind", 0.15, 0.15), {0, 0, -4}, {0, 0, 0});
  add_light(scene, projector("turned away", 0.15, 0.15), {0, 0, 4}, {0, 0, 8});
  for (const int light : {0, 1}) {
    SurfaceLayer layer = layer_of(BlendMode::over, -1);
    layer.projector = light;
    scene.materials[0].layers = {layer};
    const LayeredImage image = picture_of(scene);
    EXPECT_EQ(at(image, "R", 12, 12), 0.25F);
  }
}

// A texture that is there once, small and turned.
TEST(MitLecture20Blending, ATextureMayBeThereOnce) {
  Scene scene = bare_wall({0.25F, 0.25F, 0.25F});
  SurfaceLayer layer =
      layer_of(BlendMode::over, add_linear_picture(scene, 1, 1, [](int, int) { return glm::vec3(1); }));
  layer.texture.uv_from_mesh_uv = {4, 0, -2, 0, 4, -1};  // u from ½ to ¾, v from ¼ to ½
  layer.once = true;
  scene.materials[0].layers = {layer};
  const LayeredImage image = picture_of(std::move(scene));
  for (int y = 0; y < kPictureSide; ++y) {
    for (int x = 0; x < kPictureSide; ++x) {
      const bool is_on =
          x >= kPictureSide / 2 && x < kPictureSide * 3 / 4 && y >= kPictureSide / 4 && y < kPictureSide / 2;
      EXPECT_EQ(at(image, "G", x, y), is_on ? 1 : 0.25F) << x << ' ' << y;
    }
  }
}

Scene example(const char* rig) {
  const std::filesystem::path folder = std::filesystem::path(LATERNA_SOURCE_DIR) / "examples/scenes";
  Result<Scene> scene = load_scene({folder / "stage.glb"}, {.rigs = {folder / rig}});
  EXPECT_TRUE(scene) << (scene ? "" : to_string(scene.error()));
  return scene ? std::move(*scene) : Scene{};
}

LayeredImage example_picture(Scene scene) {
  RenderSettings settings = papers_settings(96, 64);
  settings.layers = {Layer::light, Layer::albedo};
  const Renderer renderer = make_renderer(std::move(scene));
  return render(renderer, renderer.camera_view("front", 96, 64).value(), settings);
}

// Row 59: two slides at once in the example set. Each layer is the picture of that light alone, and they overlap.
TEST(MitLecture20Blending, TheExampleOfTwoSlides) {
  const Scene scene = example("two_slides.json");
  ASSERT_EQ(scene.lights.size(), 2U);
  const LayeredImage both = example_picture(scene);
  std::vector<float> parts[2];
  for (const std::size_t i : {0U, 1U}) {
    Scene alone = scene;
    alone.lights[1 - i].enabled = false;
    const std::string channel = "light." + scene.lights[i].name + ".R";
    parts[i] = both.find(channel)->values;
    EXPECT_EQ(parts[i], example_picture(std::move(alone)).find(channel)->values);
  }
  int lit_by_both = 0;
  for (std::size_t i = 0; i < parts[0].size(); ++i) lit_by_both += parts[0][i] > 0 && parts[1][i] > 0 ? 1 : 0;
  EXPECT_GT(lit_by_both, 300);
}

TEST(MitLecture20Blending, TheExampleOfLayers) {
  Scene scene = example("layers.json");
  const LayeredImage layered = example_picture(scene);
  for (Material& material : scene.materials) material.layers.clear();
  const LayeredImage bare = example_picture(std::move(scene));
  const std::vector<float>& with = layered.find("albedo.G")->values;
  const std::vector<float>& without = bare.find("albedo.G")->values;
  int painted = 0;
  for (std::size_t i = 0; i < with.size(); ++i) painted += with[i] != without[i] ? 1 : 0;
  EXPECT_GT(painted, 500);
  EXPECT_LT(painted, 2500);
}

}  // namespace
}  // namespace laterna
