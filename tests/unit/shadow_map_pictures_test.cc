// Pictures that show how a light's shadow maps lie on the scene.
#include <gtest/gtest.h>

#include <cmath>

#include "laterna/measure.h"
#include "reference/picture_probes.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

struct Shown {
  Renderer renderer;
  View camera;
};

Shown cascaded_plain(int cascades) {
  Scene scene;
  add_object(scene, "floor", floor(200));
  for (int i = 0; i < 20; ++i)
    add_object(scene, "box", box({2, 1, -8.0F * static_cast<float>(i)}, {1, 1, 1}));
  Light light = sun("sun");
  light.shadow.technique = ShadowTechnique::cascades;
  light.shadow.cascades = cascades;
  light.shadow.resolution = 256;
  add_light(scene, light, {2, 4, 1}, {0, 0, 0});
  add_light(scene, spot("lamp", 30), {0, 6, 0}, {0, 0, -1});
  return {make_renderer(std::move(scene)), look({0, 2, 8}, {0, 1, 0}, 50, 4.0 / 3)};
}

glm::vec3 color_at(const LayeredImage& image, int x, int y) {
  return {at(image, "R", x, y), at(image, "G", x, y), at(image, "B", x, y)};
}

TEST(CascadePicture, ShowsTheFinestAtTheCameraAndTheNextBeyondIt) {
  const Shown shown = cascaded_plain(4);
  const RenderSettings settings = test_settings(160, 120);
  const Result<ExplainedPicture> drawn = cascade_picture(shown.renderer, shown.camera, settings, "sun");
  ASSERT_TRUE(drawn) << to_string(drawn.error());
  ASSERT_EQ(drawn->legend.size(), 5U);
  EXPECT_EQ(drawn->legend[0].substr(0, 22), "red       cascade 1: 2") << drawn->legend[0];
  EXPECT_EQ(drawn->legend[1].substr(0, 20), "green     cascade 2:");
  EXPECT_EQ(drawn->legend[4], "grey      beyond all of them");
  // At the bottom of the picture is what is nearest: red. Above it green, blue and yellow follow.
  const glm::vec3 nearest = color_at(drawn->picture, 40, 118);
  EXPECT_GT(nearest.r, 5 * nearest.g);
  EXPECT_GT(nearest.r, 5 * nearest.b);
  int order = 0;
  for (int y = 119; y >= 0; --y) {
    const glm::vec3 c = color_at(drawn->picture, 40, y);
    if (c == glm::vec3(0)) break;
    const bool is_next = order == 0   ? c.g > 5 * c.r && c.g > 5 * c.b
                         : order == 1 ? c.b > 3 * c.r && c.b > 3 * c.g
                                      : c.r > 5 * c.b && c.g > 5 * c.b;
    if (order < 3 && is_next) ++order;
  }
  EXPECT_EQ(order, 3);
  // The sky is the background.
  EXPECT_EQ(color_at(drawn->picture, 40, 0), glm::vec3(0));
}

TEST(CascadePicture, IsRefusedWhereThereAreNone) {
  const Shown shown = cascaded_plain(2);
  const RenderSettings settings = test_settings(16, 12);
  const auto message = [&](const std::string& light) {
    const Result<ExplainedPicture> drawn = cascade_picture(shown.renderer, shown.camera, settings, light);
    return drawn ? std::string() : to_string(drawn.error());
  };
  EXPECT_EQ(message("lamp"), "light \"lamp\" has no cascades: its shadow technique is another one");
  EXPECT_EQ(message("moon"), "the scene has no light \"moon\": it has \"sun\", \"lamp\"");
}

// A sun and a camera straight above a floor: texels and pixels have one width each.
TEST(TexelDensityPicture, CountsTexelsAlongAPixel) {
  for (const int texels : {50, 100, 200, 400}) {
    Scene scene;
    add_object(scene, "floor", floor(2));
    Light light = sun("sun");
    light.fit = false;
    light.projection = Projection::orthographic(1, 1, 0.1, 20);
    light.shadow.resolution = texels;
    add_light(scene, light, {0, 10, 0}, {0, 0, 0}, {0, 0, -1});
    const Renderer renderer = make_renderer(std::move(scene));
    const View camera = {Pose::look_at({0, 8, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                         Projection::orthographic(2, 2, 0, 10)};
    // 2 cm a pixel; the map's 2 m are half of the picture's width.
    const Result<ExplainedPicture> drawn =
        texel_density_picture(renderer, camera, test_settings(200, 200), "sun");
    ASSERT_TRUE(drawn);
    const glm::vec3 color = color_at(drawn->picture, 100, 100);
    const glm::vec3 expected = texels == 50    ? glm::vec3(0.95F, 0.5F, 0.02F)
                               : texels == 100 ? glm::vec3(0.1F, 0.7F, 0.1F)
                               : texels == 200 ? glm::vec3(0.05F, 0.7F, 0.75F)
                                               : glm::vec3(0.05F, 0.2F, 0.95F);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(color[c], expected[c], 1e-5) << texels;
    // Outside the map.
    EXPECT_NEAR(color_at(drawn->picture, 20, 100).r, 0.15F, 1e-5);
    ASSERT_EQ(drawn->legend.size(), 9U);
    EXPECT_EQ(drawn->legend[3], "green     1 shadow texels along a pixel");
    const std::string metres = std::to_string(texels / 2);
    EXPECT_EQ(drawn->legend[8], "texels per metre: " + metres + " to " + metres + ", median " + metres);
  }
}

// Perspective on both sides: a lamp at the camera's own place sees as it does, at every distance.
TEST(TexelDensityPicture, IsTheSameEverywhereForALampAtTheCamera) {
  Scene scene;
  add_object(scene, "floor", floor(6));
  add_object(scene, "box", box({0, 0.5F, 0}, {0.5F, 0.5F, 0.5F}));
  Light lamp = spot("lamp", 40);
  lamp.type = LightType::projector;
  lamp.aspect_from_slide = false;
  lamp.projection = Projection::perspective(Angle::degrees(50), 1, 0.1, 100);
  lamp.shadow.resolution = 256;
  add_light(scene, lamp, {0, 2, 5}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  const Result<ExplainedPicture> drawn =
      texel_density_picture(renderer, look({0, 2, 5}, {0, 0, 0}, 50, 1), test_settings(128, 128), "lamp");
  ASSERT_TRUE(drawn);
  // Two texels a pixel: cyan, shaded by how the surface is turned.
  for (const int y : {40, 64, 120}) {
    const glm::vec3 c = color_at(drawn->picture, 64, y);
    EXPECT_NEAR(c.g / c.b, 0.7 / 0.75, 1e-3) << y;
    EXPECT_NEAR(c.r / c.b, 0.05 / 0.75, 1e-3) << y;
  }
}

TEST(TexelDensityPicture, IsRefusedWithoutShadowMaps) {
  Scene scene;
  add_object(scene, "floor", floor(2));
  Light light = sun("sun");
  light.shadow.technique = ShadowTechnique::raytraced;
  add_light(scene, light, {0, 3, 1}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  const Result<ExplainedPicture> drawn =
      texel_density_picture(renderer, look({0, 2, 4}, {0, 0, 0}, 40, 1), test_settings(16, 16), "sun");
  ASSERT_FALSE(drawn);
  EXPECT_EQ(to_string(drawn.error()), "light \"sun\": its shadows are found without shadow maps");
}

}  // namespace
}  // namespace laterna
