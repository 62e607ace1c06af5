// Mirrors and water, which the papers leave to future work: "reflection, not shadow" (row 49).
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/mirrors.h"
#include "light/mirror_plan.h"
#include "raster/raster_view.h"
#include "reference/picture_probes.h"
#include "reference/shapes.h"
#include "trace/ray_scene.h"

namespace laterna {
namespace {

using namespace reference;

// Square-on to +Z at z.
int add_mirror(Scene& scene, float half_side, float z, const Mirror& mirror = {}) {
  const int node = add_object(scene, "mirror", wall(half_side, half_side, z));
  scene.materials.back().mirror = std::make_shared<const Mirror>(mirror);
  return node;
}

void add_glowing(Scene& scene, const std::string& name, Primitive primitive, glm::vec3 color = glm::vec3(1)) {
  add_object(scene, name, std::move(primitive), color);
  scene.materials.back().unlit = true;
}

Scene dark() {
  Scene scene;
  scene.ambient_is_set = true;
  return scene;
}

// Where the brightness of a picture has its middle, in pixels.
glm::dvec2 middle_of_light(const LayeredImage& image) {
  glm::dvec2 sum(0);
  double light = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double value = at(image, "R", x, y);
      sum += value * glm::dvec2(x + 0.5, y + 0.5);
      light += value;
    }
  }
  return sum / light;
}

glm::dvec2 pixel_of(const View& view, const glm::dvec3& point, int width, int height) {
  const glm::dvec4 image = view.image_from_world() * glm::dvec4(point, 1);
  return {image.x / image.w * width, image.y / image.w * height};
}

// Row 49: what stands behind the camera is seen where its mirrored point is, well within a pixel.
TEST(Mirrors, AReflectedPointLandsWhereTheMirroredOneWould) {
  const View view = look({0.5, 0.3, 2}, {0.2, 0, -2}, 50, 1.5);
  for (const glm::vec3 point : {glm::vec3(0, 0, 4), glm::vec3(-1.2F, 0.7F, 3), glm::vec3(1.7F, -0.9F, 5)}) {
    Scene scene = dark();
    add_mirror(scene, 6, -2);
    add_glowing(scene, "ball", sphere(point, 0.06F, 24));
    RenderSettings settings = test_settings(240, 160);
    settings.samples = 16;
    const LayeredImage image = render(make_renderer(std::move(scene)), view, settings);
    const glm::dvec2 expected = pixel_of(view, {point.x, point.y, -4 - point.z}, 240, 160);
    EXPECT_LT(glm::distance(middle_of_light(image), expected), 0.1) << point.x;
  }
}

// Row 49, against rays: at every pixel, what the reflected ray meets.
TEST(Mirrors, ShowWhatReflectedRaysMeet) {
  const auto make = [] {
    Scene scene = dark();
    scene.nodes[static_cast<std::size_t>(add_mirror(scene, 8, -2))].casts_shadow = false;
    add_glowing(scene, "ring", torus({0.4F, 0.2F, 3}, 1, 0.3F, 32));
    return scene;
  };
  const View view = look({0.7, 0.4, 1}, {0.2, 0.2, -2}, 60, 1);
  constexpr int kSide = 128;
  const LayeredImage image = render(make_renderer(make()), view, test_settings(kSide, kSide));
  const OwnedFrame own = make_frame(make());
  const trace::RayScene rays(own.frame);
  const laterna::raster::RasterView camera(view, kSide, kSide);
  int met = 0, different = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec3 ray = camera.direction_0 + camera.direction_x * (x + 0.5 - camera.origin_x) +
                             camera.direction_y * (y + 0.5 - camera.origin_y);
      const glm::dvec3 place = camera.eye_ws + ray * ((-2 - camera.eye_ws.z) / ray.z);
      const bool is_met = rays.is_blocked(
          glm::vec3(place), glm::vec3(glm::normalize(ray * glm::dvec3(1, 1, -1))), 1e-3F, 100, kNoTriangle);
      met += is_met ? 1 : 0;
      different += is_met != (at(image, "R", x, y) > 0.5F) ? 1 : 0;
    }
  }
  EXPECT_GT(met, 200);
  EXPECT_LE(different, met / 200);  // on outlines: corners are snapped to 1/256 pixel
}

// A slide on a wall behind the camera, and a shadow in it.
Scene slide_show() {
  Scene scene;
  Mesher screen;
  screen.quad({3, -3, 4}, {-3, -3, 4}, {-3, 3, 4}, {3, 3, 4});  // faces the mirror
  add_object(scene, "screen", screen.primitive);
  add_object(scene, "ball", sphere({0.3F, 0.2F, 2.8F}, 0.4F, 24), {0.8F, 0.5F, 0.3F});
  Light projector;
  projector.name = "projector";
  projector.type = LightType::projector;
  projector.intensity = 10;
  projector.projection = Projection::perspective(Angle::degrees(60), 1, 0.1, 100);
  projector.slide = add_picture(scene, 8, 8, [](int x, int y) {
    return (x + y) % 2 != 0 ? glm::u8vec3(255, 200, 60) : glm::u8vec3(40, 90, 220);
  });
  add_light(scene, projector, {1, 1, 0.5}, {0, 0, 4});
  scene.ambient = glm::vec3(0.02F);
  return scene;
}

// Row 49: slides and shadows in a mirror are those that the mirrored camera sees, bit for bit.
TEST(Mirrors, ShowSlidesAndShadowsAsTheMirroredCameraSeesThem) {
  const View view = look({-0.4, 0.1, 1}, {0.1, 0.05, -2}, 50, 1.25);
  const View mirrored = light::mirrored(view, {0, 0, 1}, -2);
  constexpr int kWidth = 155, kHeight = 124;
  Scene with_mirror = slide_show();
  add_mirror(with_mirror, 20, -2);
  const RenderSettings settings = test_settings(kWidth, kHeight);
  const LayeredImage seen = render(make_renderer(std::move(with_mirror)), view, settings);
  const LayeredImage direct = render(make_renderer(slide_show()), mirrored, settings);
  int different = 0, bright = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (const char* channel : {"R", "G", "B"})
        different += at(seen, channel, x, y) != at(direct, channel, kWidth - 1 - x, y) ? 1 : 0;
      bright += at(seen, "R", x, y) > 0.1F ? 1 : 0;
    }
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(bright, 1000);
  EXPECT_LT(bright, kWidth * kHeight - 1000);
}

// Between mirrors at x = ±1 the images of a point at x lie at −2 − x, then x − 4, then −6 − x; each depth shows one more.
TEST(Mirrors, FacingOneAnotherShowTheImagesOfImages) {
  Scene scene = dark();
  Mesher left, right;
  left.quad({-1, -3, 3}, {-1, -3, -3}, {-1, 3, -3}, {-1, 3, 3});
  right.quad({1, -3, -3}, {1, -3, 3}, {1, 3, 3}, {1, 3, -3});
  for (const auto& [name, mesh] : {std::pair("left", left), std::pair("right", right)}) {
    add_object(scene, name, mesh.primitive, glm::vec3(0));
    scene.materials.back().mirror = std::make_shared<const Mirror>();
  }
  add_glowing(scene, "dot", sphere({0.3F, 0.5F, 0.1F}, 0.05F, 16));
  const View view = look({0.2, 0, 0}, {-1, 0.1, 0}, 60, 1);
  const Renderer renderer = make_renderer(std::move(scene));
  const double images[] = {-2.3, -3.7, -6.3, -7.7};
  for (int depth = 0; depth <= 4; ++depth) {
    RenderSettings settings = test_settings(200, 200);
    settings.mirror_depth = depth;
    RenderStatistics statistics;
    const LayeredImage image = renderer.render(view, settings, {}, &statistics).value();
    EXPECT_EQ(statistics.mirror_pictures, depth);
    for (int i = 0; i < 4; ++i) {
      const glm::dvec2 pixel = pixel_of(view, {images[i], 0.5, 0.1}, 200, 200);
      const bool is_shown = at(image, "R", static_cast<int>(pixel.x), static_cast<int>(pixel.y)) > 0.9F;
      EXPECT_EQ(is_shown, i < depth) << "image " << i << ", depth " << depth;
    }
  }
}

// The mirrored camera stands behind the mirror, and what is there must not come between.
TEST(Mirrors, ShowNothingOfWhatStandsBehindThem) {
  Scene scene = dark();
  add_mirror(scene, 4, -2);
  add_glowing(scene, "behind", box({0, 0, -3}, {1, 1, 0.5F}));
  // Through the mirror: of 2 m, the half before it.
  add_glowing(scene, "through", box({2, 0, -2}, {0.1F, 0.1F, 1}), {0, 1, 0});
  const View view = look({0, 0, 2}, {0, 0, -2}, 70, 1);
  RenderSettings settings = test_settings(160, 160);
  settings.layers = {Layer::light};
  const LayeredImage image = render(make_renderer(std::move(scene)), view, settings);
  for (const float value : values_of(image, "reflection.R")) EXPECT_EQ(value, 0);
  // The end at z = −1 is mirrored to z = −3; nothing is seen of −3 … −2 but mirrored.
  const glm::dvec2 mirrored = pixel_of(view, {1.9, 0, -2.6}, 160, 160);
  EXPECT_EQ(at(image, "reflection.G", static_cast<int>(mirrored.x), static_cast<int>(mirrored.y)), 1);
  const glm::dvec2 beyond = pixel_of(view, {1.9, 0, -3.2}, 160, 160);
  EXPECT_EQ(at(image, "reflection.G", static_cast<int>(beyond.x), static_cast<int>(beyond.y)), 0);
}

// What hangs a hair's breadth before a mirror is seen in it, from behind: it is the mirror's own surface that is left out, not what
// is near. So is what another surface of the same object shows.
TEST(Mirrors, ShowWhatIsStuckToThem) {
  const float gap = 1e-3F;  // of a mirror 8 m long: within what it may be off its plane
  Scene scene = dark();
  add_object(scene, "mirror", wall(4, 4, -2));
  scene.meshes.back().primitives[0].positions[0].z += 3e-3F;
  scene.materials.back().mirror = std::make_shared<const Mirror>();
  // Half of it covers what it shows from the eye's side: seen is what it shows at the mirror's.
  Mesher poster;
  const float z = -2 + 4 * gap;
  poster.quad({-0.5F, -0.5F, z}, {0.5F, -0.5F, z}, {0.5F, 0.5F, z}, {-0.5F, 0.5F, z});
  add_glowing(scene, "poster", poster.primitive, {0, 1, 0});
  scene.materials.back().double_sided = true;
  const View view =
      look({60, 0, -1.5}, {0, 0, -2}, 2, 1);  // glancing: of 8 mm between it and its image, some pixels
  RenderSettings settings = test_settings(400, 400);
  settings.layers = {Layer::light};
  const LayeredImage image = render(make_renderer(std::move(scene)), view, settings);
  int seen = 0;
  for (const float value : values_of(image, "reflection.G")) seen += value > 0.5F ? 1 : 0;
  EXPECT_GT(seen, 20);
}

// A mirror of several clusters that leaves its plane a little: none of it is in its own picture.
TEST(Mirrors, DoNotSeeThemselves) {
  Scene scene = dark();
  Mesher mesh;
  constexpr int kStrips = 200;
  for (int i = 0; i < kStrips; ++i) {
    const float x = -4 + 8.0F * static_cast<float>(i) / kStrips, width = 8.0F / kStrips;
    const auto z = [](float at) { return -2 + 4e-3F * std::sin(at); };
    mesh.quad({x, -4, z(x)}, {x + width, -4, z(x + width)}, {x + width, 4, z(x + width)}, {x, 4, z(x)});
  }
  add_object(scene, "mirror", mesh.primitive, glm::vec3(0, 0, 1));
  scene.materials.back().unlit = true;
  scene.materials.back().double_sided = true;
  scene.materials.back().mirror = std::make_shared<const Mirror>();
  scene.background = glm::vec3(1, 0, 0);
  RenderSettings settings = test_settings(120, 120);
  settings.layers = {Layer::light};
  const LayeredImage image =
      render(make_renderer(std::move(scene)), look({1, 0.5, 2}, {0, 0, -2}, 60, 1), settings);
  for (const float value : values_of(image, "reflection.B")) ASSERT_EQ(value, 0);
}

// One mesh at two places: each instance mirrors in its own plane.
TEST(Mirrors, OfOneMeshEachHaveTheirPlane) {
  const auto make = [](float x) {
    Scene scene = dark();
    const int node = add_mirror(scene, 0.9F, 0);
    scene.nodes.push_back(scene.nodes[static_cast<std::size_t>(node)]);
    scene.nodes[static_cast<std::size_t>(node)].parent_from_node[3] = {-1, 0, -2, 1};
    scene.nodes.back().parent_from_node[3] = {1, 0, -3, 1};
    add_glowing(scene, "ball", sphere({x, 0.2F, 2}, 0.05F, 16));
    return scene;
  };
  for (const auto& [x, plane] : {std::pair(-1.0F, -2.0), std::pair(1.0F, -3.0)}) {
    const View view = look({x, 0, 3}, {x, 0, -2}, 60, 1);
    const Renderer renderer = make_renderer(make(x));
    RenderStatistics statistics;
    const LayeredImage image = renderer.render(view, test_settings(240, 240), {}, &statistics).value();
    EXPECT_EQ(statistics.mirror_pictures, 2);
    const glm::dvec2 expected = pixel_of(view, {x, 0.2, 2 * plane - 2}, 240, 240);
    EXPECT_GT(at(image, "R", static_cast<int>(expected.x), static_cast<int>(expected.y)), 0.9F) << plane;
  }
}

// Fresnel's equations in the form with angles.
double fresnel(double degrees, double ior) {
  const double i = degrees / 180 * std::acos(-1.0), t = std::asin(std::sin(i) / ior);
  const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
  return (s * s + p * p) / 2;
}

// Row 49: water under a sky of 1 mirrors 0.0204 of it straight below, and what Fresnel's equations say at 80°.
TEST(Mirrors, WaterReflectsAsFresnelSays) {
  for (const double degrees : {0.0, 45.0, 80.0}) {
    Scene scene = dark();
    add_object(scene, "water", floor(1e4F), glm::vec3(0));
    Mirror water;
    water.ior = 1.333F;
    water.waves.push_back({{1, 0, 0}, 1, 0, {}, 0});  // that are flat
    scene.materials.back().mirror = std::make_shared<const Mirror>(water);
    scene.background = glm::vec3(1);
    const double angle = degrees / 180 * std::acos(-1.0);
    const View view =
        look({0, 5 * std::cos(angle), 5 * std::sin(angle)}, {0, 0, 0}, 5, 1, {0, std::sin(angle), -1});
    const LayeredImage image = render(make_renderer(std::move(scene)), view, test_settings(33, 33));
    const double expected = degrees == 0 ? 0.0204 : fresnel(degrees, 1.333);
    EXPECT_NEAR(at(image, "R", 16, 16), expected, degrees == 0 ? 5e-5 : 1e-5) << degrees;
  }
}

// Where a black wall meets a mirror nothing of the white behind both shines through, in means of many pictures too: mirrored
// pictures sample the pixels where the picture does.
Scene black_wall_on_a_mirror(const Mirror& kind) {
  Scene scene = dark();
  Mesher mirror, black;
  mirror.quad({-1, -3, 3}, {-1, -3, -6}, {-1, 3, -6}, {-1, 3, 3});
  black.quad({-1, -3, -3}, {9, -3, -3}, {9, 3, -3}, {-1, 3, -3});
  add_object(scene, "mirror", mirror.primitive);
  scene.materials.back().mirror = std::make_shared<const Mirror>(kind);
  add_glowing(scene, "wall", black.primitive, glm::vec3(0));
  scene.background = glm::vec3(1);
  return scene;
}

TEST(Mirrors, LeaveNoGapAtContacts) {
  const Renderer renderer = make_renderer(black_wall_on_a_mirror({}));
  const View view = look({0.3, 0, 0}, {-0.9, 0, -3}, 30, 2.5);
  const int contact = static_cast<int>(pixel_of(view, {-1, 0, -3}, 101, 40).x);
  for (const auto& [samples, accumulate] :
       {std::pair(1, 1), std::pair(1, 16), std::pair(4, 1), std::pair(16, 1)}) {
    RenderSettings settings = test_settings(101, 40);
    settings.samples = samples;
    settings.accumulate = accumulate;
    const LayeredImage image = render(renderer, view, settings);
    for (int y = 10; y < 30; ++y) {
      for (int x = contact - 5; x < contact + 5; ++x)
        EXPECT_EQ(at(image, "R", x, y), 0) << samples << " samples: " << x << ", " << y;
    }
  }
}

// Rough ones neither, but for a trace: the last pixel before the wall is the mirror's in part, and its mean no surface's.
TEST(Mirrors, RoughOnesLeaveNoGapAtContacts) {
  Mirror rough;
  rough.roughness = 0.3F;
  const Renderer renderer = make_renderer(black_wall_on_a_mirror(rough));
  const View view = look({0.3, 0, 0}, {-0.9, 0, -3}, 30, 2.5);
  const int contact = static_cast<int>(pixel_of(view, {-1, 0, -3}, 101, 40).x);
  for (const int samples : {1, 4, 16}) {
    RenderSettings settings = test_settings(101, 40);
    settings.samples = samples;
    const LayeredImage image = render(renderer, view, settings);
    for (int y = 10; y < 30; ++y) {
      for (int x = contact - 5; x < contact + 5; ++x)
        EXPECT_LE(at(image, "R", x, y), 0.03) << samples << " samples: " << x << ", " << y;
    }
  }
}

// Nor do waves, which send rays to where the mirrored picture shows what the plane cuts off.
TEST(Mirrors, WavesLeaveNoGapAtContacts) {
  Mirror waves;
  waves.waves = {{{0, 1, 0}, 0.3, 0.002, {}, 0}, {{0, 0.6, 0.8}, 0.5, 0.003, {}, 0}};
  const Renderer renderer = make_renderer(black_wall_on_a_mirror(waves));
  for (const double aside : {0.3, -0.6, -0.9}) {
    const View view = look({aside, 0, 0}, {-0.9, 0, -3}, 30, 2.5);
    const int contact = static_cast<int>(pixel_of(view, {-1, 0, -3}, 401, 160).x);
    for (const auto& [samples, accumulate] :
         {std::pair(1, 1), std::pair(1, 8), std::pair(4, 1), std::pair(16, 1)}) {
      RenderSettings settings = test_settings(401, 160);
      settings.samples = samples;
      settings.accumulate = accumulate;
      const LayeredImage image = render(renderer, view, settings);
      for (int y = 10; y < 150; ++y) {
        for (int x = contact - 10; x < contact + 10; ++x)
          EXPECT_EQ(at(image, "R", x, y), 0) << samples << " samples: " << x << ", " << y;
      }
    }
  }
}

Scene pool(const Mirror& water, bool is_clear = false) {
  Scene scene = slide_show();
  add_object(scene, "water", floor(3, -1.5F), {0.1F, 0.2F, 0.2F});
  scene.materials.back().mirror = std::make_shared<const Mirror>(water);
  if (is_clear) scene.materials.back().alpha_mode = AlphaMode::blend;
  scene.materials.back().base_color.a = is_clear ? 0.3F : 1;
  add_object(scene, "bottom", floor(3, -2.5F), {0.6F, 0.5F, 0.3F});
  return scene;
}
const View kOverWater = look({0, 0.5, -3}, {0, -0.7, 3}, 60, 1);

Mirror rippled() {
  Mirror water;
  water.ior = 1.333F;
  water.waves = {{{1, 0, 0.3}, 0.7, 0.01, {}, 0}, {{-0.2, 0, 1}, 0.4, 0.008, {}, 0}};
  return water;
}

TEST(Mirrors, LayersAddUpToThePictureBitForBit) {
  for (const bool is_clear : {false, true}) {
    const Renderer renderer = make_renderer(pool(rippled(), is_clear));
    for (const auto& [samples, accumulate] : {std::pair(1, 1), std::pair(4, 1), std::pair(1, 3)}) {
      RenderSettings settings = test_settings(64, 64);
      settings.samples = samples;
      settings.accumulate = accumulate;
      const LayeredImage plain = render(renderer, kOverWater, settings);
      settings.layers = {Layer::light};
      const LayeredImage image = render(renderer, kOverWater, settings);
      EXPECT_EQ(count_different_pixels(plain, image), 0U);
      double reflected = 0;
      for (std::size_t i = 0; i < values_of(image, "R").size(); ++i) {
        const float reflection = values_of(image, "reflection.R")[i];
        const float sum =
            values_of(image, "ambient.R")[i] + values_of(image, "light.projector.R")[i] + reflection;
        ASSERT_EQ(values_of(image, "R")[i], sum);
        reflected += reflection;
      }
      EXPECT_GT(reflected, 1);
    }
  }
}

TEST(Mirrors, LookTheSameWithAnyThreadsAndInstructionSet) {
  Mirror water = rippled();
  water.roughness = 0.2F;
  RenderSettings settings = test_settings(80, 60);
  const LayeredImage one = render(make_renderer(pool(water), 1), kOverWater, settings);
  EXPECT_EQ(count_different_pixels(one, render(make_renderer(pool(water), 3), kOverWater, settings)), 0U);
  for (const InstructionSet set : supported_instruction_sets())
    EXPECT_EQ(count_different_pixels(one, render(make_renderer(pool(water), 1, set), kOverWater, settings)),
              0U);
}

// Waves without height are still water, and all waves are back after a period.
TEST(Mirrors, WavesMoveWithTheScenesTime) {
  Mirror water;
  water.waves = {{{0, 0, 1}, 0.5, 0, 0.25, 0}};
  const RenderSettings settings = test_settings(96, 96);
  const LayeredImage still = render(make_renderer(pool({})), kOverWater, settings);
  const LayeredImage flat = render(make_renderer(pool(water)), kOverWater, settings);
  const auto difference = [](const LayeredImage& a, const LayeredImage& b) {
    double sum = 0;
    for (std::size_t i = 0; i < values_of(a, "R").size(); ++i)
      sum += std::abs(static_cast<double>(values_of(a, "R")[i]) - static_cast<double>(values_of(b, "R")[i]));
    return sum / static_cast<double>(values_of(a, "R").size());
  };
  EXPECT_LT(difference(still, flat), 1e-5);
  water.waves[0].amplitude = 0.01;
  Renderer renderer = make_renderer(pool(water));
  const LayeredImage at_0 = render(renderer, kOverWater, settings);
  EXPECT_GT(difference(still, at_0), 1e-2);
  ASSERT_TRUE(renderer.set_time(1));
  EXPECT_GT(difference(at_0, render(renderer, kOverWater, settings)), 1e-2);
  ASSERT_TRUE(renderer.set_time(2));  // 0.5 m at 0.25 m/s
  EXPECT_LT(difference(at_0, render(renderer, kOverWater, settings)), 1e-5);
}

// A rough mirror blurs what is far from it, and not what touches it.
TEST(Mirrors, RoughOnesBlurByDistance) {
  const auto rise_of = [](float distance) {  // pixels from a tenth to nine tenths of the edge of a half plane
    Scene scene = dark();
    Mirror rough;
    rough.roughness = 0.2F;
    add_mirror(scene, 20, 0, rough);
    Mesher half;
    half.quad({0, -20, distance}, {-40, -20, distance}, {-40, 20, distance}, {0, 20, distance});
    add_glowing(scene, "half", half.primitive);
    const LayeredImage image = render(make_renderer(std::move(scene)),
                                      look({0.01, 0, 8}, {0.01, 0, 0}, 40, 1), test_settings(256, 256));
    const auto row = row_of(image, "R", 128);
    return crossings(row, 0.1).at(0) - crossings(row, 0.9).at(0);
  };
  EXPECT_LT(std::abs(rise_of(0.01F)), 1.5);
  // Behind the mirror by t the disc's radius is 2 · 0.2² t / (8 + t) of the tangent, and a tenth to nine tenths of a disc lie
  // on 1.374 of it. That a mirrored picture is of pixels, and of finitely many rays, adds about one.
  const double pixels_per_tangent = 128 / std::tan(20 / 180.0 * std::acos(-1.0));
  for (const double t : {1.0, 6.0}) {
    const double expected = 1.374 * 2 * 0.04 * t / (8 + t) * pixels_per_tangent;
    EXPECT_NEAR(std::abs(rise_of(static_cast<float>(t))), expected, 0.12 * expected + 1) << t;
  }
}

// What the rays of one picture leave out those of the next see: the rings and spokes of their pattern go as pictures are added.
TEST(Mirrors, RoughOnesGetSmoothAsPicturesAreAdded) {
  Scene scene = dark();
  Mirror rough;
  rough.roughness = 0.3F;
  add_mirror(scene, 20, 0, rough);
  Mesher lattice;
  for (int bar = -10; bar <= 10; ++bar) {
    const auto x = 0.4F * static_cast<float>(bar);
    lattice.quad({x, -9, 2}, {x - 0.05F, -9, 2}, {x - 0.05F, 9, 2}, {x, 9, 2});
  }
  add_glowing(scene, "lattice", lattice.primitive);
  const Renderer renderer = make_renderer(std::move(scene));
  const auto unevenness = [&](int pictures) {
    RenderSettings settings = test_settings(128, 128);
    settings.accumulate = pictures;
    const LayeredImage image = render(renderer, look({0.01, 0, 8}, {0.01, 0, 0}, 40, 1), settings);
    double sum = 0;
    for (int y = 32; y < 96; ++y) {
      const auto row = row_of(image, "R", y);
      for (std::size_t x = 32; x < 96; ++x) sum += std::abs(row[x - 1] - 2 * row[x] + row[x + 1]);
    }
    return sum;
  };
  EXPECT_LT(unevenness(16), unevenness(1) / 3);
}

// Where rays go on in parallel, the blur grows by distance alone; how far the view reaches has no part in it.
TEST(Mirrors, RoughOnesDoNotDependOnTheFarPlane) {
  const auto picture = [](double far) {
    Scene scene = dark();
    Mirror rough;
    rough.roughness = 0.3F;
    add_mirror(scene, 20, 0, rough);
    add_glowing(scene, "ball", sphere({0, 0, 2}, 1, 24));
    View view = look({0, 0, 8}, {0, 0, 0}, 40, 1);
    view.projection = Projection::orthographic(3, 3, 0.05, far);
    return render(make_renderer(std::move(scene)), view, test_settings(96, 96));
  };
  const LayeredImage near = picture(50);
  for (const double far : {1e3, 1e7}) {
    const LayeredImage image = picture(far);
    double difference = 0;
    for (std::size_t i = 0; i < 96 * 96; ++i)
      difference += std::abs(static_cast<double>(values_of(near, "R")[i]) -
                             static_cast<double>(values_of(image, "R")[i]));
    EXPECT_LT(difference / (96 * 96), far < 1e6 ? 1e-4 : 0.02)
        << far;  // reversed depth of 1e7 m tells 1 m from the next
  }
}

}  // namespace
}  // namespace laterna
