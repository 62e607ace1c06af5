// Lamps with measured beams: E = I(direction) cos θ / d² on walls and floors, with every technique and model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "unit/lamp_texts.h"

namespace laterna {
namespace {

using namespace reference;
using namespace testing_lamps;

constexpr int kSide = 64;
constexpr double kHalf = 4;  // metres of floor or wall to each side

// Different in every direction.
LightDistribution odd_lamp(int type) {
  IesText ies;
  ies.type = type;
  ies.vertical = type == 1 ? angles(0, 180, 37) : angles(-90, 90, 37);
  ies.horizontal = type == 1 ? angles(0, 360, 25) : angles(-90, 90, 37);
  ies.candela = [](double v, double h) {
    const double wrapped = h == 360 ? 0 : h;
    return 200 + v + 100 * std::sin(wrapped * 0.0174533) * std::sin(v * 0.0174533);
  };
  return parse_or_fail(ies.text());
}

Light light_with(LightDistribution lamp, LightType type = LightType::point) {
  Light light;
  light.name = "lamp";
  light.type = type;
  light.distribution = std::make_shared<const LightDistribution>(std::move(lamp));
  return light;
}

RenderSettings lux_settings(ShadowTechnique technique = ShadowTechnique::none) {
  RenderSettings settings = test_settings(kSide, kSide);
  settings.shadows = technique;
  settings.layers = {Layer::lux, Layer::visibility};
  return settings;
}

// Where the middle of a pixel of a square-on picture lies on the wall at z = 0.
glm::dvec3 wall_point(int x, int y) {
  return {((2 * x + 1.0) / kSide - 1) * kHalf, (1 - (2 * y + 1.0) / kSide) * kHalf, 0};
}

// Edges of beams are as sharp as pixels: many of them.
double lumens_on_wall(const Renderer& renderer) {
  constexpr int kFine = 512;
  RenderSettings settings = lux_settings();
  settings.width = settings.height = kFine;
  const LayeredImage image = render(renderer, square_on(kHalf, 1), settings);
  double sum = 0;
  for (const float lux : values_of(image, "lux.Y")) sum += lux;
  return sum * (2 * kHalf / kFine) * (2 * kHalf / kFine);
}

// A lamp square-on to the wall, and one askew; the light's space is X right, Y up, −Z along it.
TEST(MeasuredLamp, IlluminanceIsIntensityTimesCosineOverDistanceSquared) {
  const glm::dvec3 stand(0.5, -0.3, 2);
  for (const int type : {1, 2, 3}) {
    for (const glm::dvec3 target : {glm::dvec3(0.5, -0.3, 0), glm::dvec3(-1, 1.5, 0.4)}) {
      Light light = light_with(odd_lamp(type));
      light.intensity = 1.5;
      Scene scene;
      add_object(scene, "wall", wall(20, 20, 0));
      add_light(scene, light, stand, target);
      const LayeredImage image = render(make_renderer(std::move(scene)), square_on(kHalf, 1), lux_settings());
      const Pose pose = Pose::look_at(stand, target, {0, 1, 0}).value();
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const glm::dvec3 ray = wall_point(x, y) - stand;
          const double distance = glm::length(ray), cosine = -ray.z / distance;
          const glm::dvec3 direction_ls(glm::dot(ray, pose.right_ws()), glm::dot(ray, pose.up_ws()),
                                        -glm::dot(ray, pose.forward_ws()));
          const double expected =
              1.5 * candela_toward(*light.distribution, direction_ls) * cosine / (distance * distance);
          ASSERT_NEAR(at(image, "lux.Y", x, y), expected, 2e-5 * expected + 1e-6)
              << type << " " << x << " " << y;
        }
      }
    }
  }
}

// Which way round: a lamp that shines only around C0 lights what is to its right, one around C90 what is above.
TEST(MeasuredLamp, C0IsToTheRightAndC90Up) {
  for (const double lit : {0.0, 90.0, 180.0, 270.0}) {
    IesText ies;
    ies.vertical = angles(0, 90, 10), ies.horizontal = angles(0, 315, 8);
    ies.candela = [lit](double, double h) { return h == lit ? 100.0 : 0.0; };
    Scene scene;
    add_object(scene, "wall", wall(20, 20, 0));
    add_light(scene, light_with(parse_or_fail(ies.text())), {0, 0, 2}, {0, 0, 0});
    const LayeredImage image = render(make_renderer(std::move(scene)), square_on(kHalf, 1), lux_settings());
    EXPECT_EQ(at(image, "lux.Y", 48, 32) > 0, lit == 0) << lit;
    EXPECT_EQ(at(image, "lux.Y", 32, 16) > 0, lit == 90) << lit;
    EXPECT_EQ(at(image, "lux.Y", 15, 32) > 0, lit == 180) << lit;
    EXPECT_EQ(at(image, "lux.Y", 32, 48) > 0, lit == 270) << lit;
  }
}

TEST(MeasuredLamp, ThePapersModelShowsTheBeamByItsPeak) {
  Scene scene;
  add_object(scene, "wall", wall(20, 20, 0), {0.5F, 1, 1});
  scene.ambient_is_set = true;
  const LightDistribution lamp = odd_lamp(1);
  add_light(scene, light_with(lamp), {0, 0, 2}, {0, 0, 0});
  const LayeredImage image =
      render(make_renderer(std::move(scene)), square_on(kHalf, 1), papers_settings(kSide, kSide));
  const double peak = summarise(lamp).peak_cd;
  for (const int x : {3, 30, 60}) {
    const glm::dvec3 ray = wall_point(x, 20) - glm::dvec3(0, 0, 2);
    EXPECT_NEAR(at(image, "G", x, 20), candela_toward(lamp, ray) / peak, 1e-5);
    EXPECT_NEAR(at(image, "R", x, 20), 0.5 * candela_toward(lamp, ray) / peak, 1e-5);
  }
}

// Shadows are the same as those of a plain light; what arrives is the lamp's.
TEST(MeasuredLamp, EveryTechniqueShadowsIt) {
  for (const TechniqueDescription& technique : list_techniques()) {
    for (const LightType type : {LightType::point, LightType::spot}) {
      LayeredImage images[2];
      for (const bool is_lamp : {false, true}) {
        Light light = is_lamp ? light_with(odd_lamp(1), type) : Light{};
        light.name = "lamp", light.type = type;
        light.outer_cone = Angle::degrees(60), light.inner_cone = Angle::degrees(50);
        if (!find_fault(technique.technique, light).empty()) continue;
        if (technique.technique == ShadowTechnique::ground) light.shadow.planes = {{{0, 0, 1}, 0}};
        Scene scene;
        add_object(scene, "wall", wall(20, 20, 0));
        add_object(scene, "box", box({0.6F, 0.4F, 0.7F}, {0.3F, 0.2F, 0.3F}));
        add_light(scene, light, {0, 0, 3}, {0, 0, 0});
        const Renderer renderer = make_renderer(std::move(scene));
        images[is_lamp ? 1 : 0] = render(renderer, square_on(kHalf, 1), lux_settings(technique.technique));
      }
      if (images[1].channels.empty()) continue;
      EXPECT_TRUE(std::ranges::equal(values_of(images[0], "visibility.lamp"),
                                     values_of(images[1], "visibility.lamp")))
          << technique.name;
      double lit = 0, dark = 0;
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const float plain = at(images[0], "lux.Y", x, y), lamp = at(images[1], "lux.Y", x, y);
          ASSERT_EQ(plain > 0, lamp > 0) << technique.name << " " << x << " " << y;
          (lamp > 0 ? lit : dark) += 1;
        }
      }
      EXPECT_GT(lit, 1000) << technique.name;
      if (technique.technique == ShadowTechnique::none) continue;
      EXPECT_GT(dark, 20) << technique.name;
    }
  }
}

// Lumens in, lumens out: all that leaves a lamp, a bulb, a spot or a map arrives on walls all round or within its cone.
TEST(MeasuredLamp, LumensAreTheWholeFlux) {
  const auto wall_flux = [](Light light, Scene scene, double distance) {
    add_object(scene, "wall", wall(20, 20, 0));
    add_light(scene, std::move(light), {0, 0, distance}, {0, 0, 0});
    return lumens_on_wall(make_renderer(std::move(scene)));
  };
  Light spot;
  spot.name = "spot", spot.type = LightType::spot, spot.lumens = 500;
  for (const double inner : {0.0, 15.0, 30.0}) {
    spot.inner_cone = Angle::degrees(inner), spot.outer_cone = Angle::degrees(30);
    EXPECT_NEAR(wall_flux(spot, {}, 4), 500, 2.5) << inner;
  }
  // I = lm / 4π; a square of half side d at distance d takes a sixth of what goes all round.
  Light bulb;
  bulb.name = "bulb", bulb.lumens = 600;
  EXPECT_NEAR(wall_flux(bulb, {}, kHalf), 100, 0.5);
  IesText ies;
  ies.vertical = angles(0, 180, 3);
  bulb = light_with(parse_or_fail(ies.text()));
  bulb.lumens = 600;
  EXPECT_NEAR(wall_flux(bulb, {}, kHalf), 100, 0.5);
  // A beam as an intensity map, of any shape and colour.
  Scene scene;
  Light projector = reference::projector("map", 0.9, 0.9, add_linear_picture(scene, 96, 96, [](int x, int y) {
                                           return glm::vec3(x > 40 ? 3 : 0.5, y > 60 ? 1 : 0, 0.2);
                                         }));
  projector.slide_is_intensity = true;
  projector.lumens = 3000;
  EXPECT_NEAR(wall_flux(projector, scene, 4), 3000, 15);
}

TEST(MeasuredLamp, PicturesAreTheSameOnEveryInstructionSetAndNumberOfThreads) {
  std::vector<LayeredImage> images;
  for (const InstructionSet set : supported_instruction_sets()) {
    for (const int threads : {1, 3}) {
      Scene scene;
      add_object(scene, "floor", floor(5));
      add_object(scene, "ball", sphere({0, 0.6F, 0}, 0.5F, 24));
      add_light(scene, light_with(odd_lamp(1)), {1, 2.5, 0.5}, {0.2, 0, 0}, {0, 0, -1});
      const Renderer renderer = make_renderer(std::move(scene), threads, set);
      images.push_back(
          render(renderer, look({0, 3, 5}, {0, 0.3, 0}, 45, 1), lux_settings(ShadowTechnique::map)));
      EXPECT_EQ(count_different_pixels(images.front(), images.back()), 0U) << name_of(set);
    }
  }
}

}  // namespace
}  // namespace laterna
