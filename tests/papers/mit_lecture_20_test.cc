// MIT 6.837, lecture 20: texture mapping and projective textures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "laterna/measure.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/segal_equations.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

// Row 53: a label on a sheet that runs away from the viewer: u rises from 0 to 1 as w rises from 1 to 4.
TEST(MitLecture20, LabelsAreInPerspective) {
  Scene scene;
  Mesher mesh;
  mesh.quad({-0.5F, -0.5F, -1}, {0.5F, -0.5F, -1}, {2, 2, -4}, {-2, 2, -4});
  add_object(scene, "sheet", mesh.primitive);
  // A ramp: texel i holds its own place, so that filtering gives u itself; t counts from the top row.
  Texture& label = scene.materials[0].base_color_texture;
  label.picture = add_linear_picture(
      scene, 4, 256, [](int, int y) { return glm::vec3((static_cast<float>(y) + 0.5F) / 256); });
  label.sampler.wrap_v = Wrap::clamp;
  RenderSettings settings = test_settings(65, 65);
  settings.layers = {Layer::albedo};
  const View camera = look({0, 0, 0}, {0, 0, -1}, 2 * 26.565051177077990, 1);
  const LayeredImage image = render(make_renderer(std::move(scene)), camera, settings);
  EXPECT_NEAR(1 - at(image, "albedo.R", 32, 32), 0.2, 1e-5);
  for (int y = 1; y < 64; ++y) {
    const double share = 1 - (y + 0.5) / 65;
    EXPECT_NEAR(1 - at(image, "albedo.R", 32, y), value_on_span({1, 0}, {4, 1}, share), 1e-4) << "row " << y;
  }
}

// Row 54: p = i + t P (s, t, 1)ᵀ, and its inverse.
TEST(MitLecture20, TheProjectorsMatrixIsThatOfALookAtWithAHorizontalField) {
  const glm::dvec3 position(1, 2, 3);
  const glm::dvec3 target(4, 1, -2);
  const double half = std::tan(Angle::degrees(45).in_radians());  // hfov 90°
  const View view = {Pose::look_at(position, target, {0, 1, 0}).value(),
                     {false, -half, half, -half / 2, half / 2, 0.1, 100}};
  const auto slide_coordinates = [&](const glm::dvec3& p) {
    const glm::dvec4 q = view.image_from_world() * glm::dvec4(p, 1);
    return glm::dvec2(q) / q.w;
  };
  EXPECT_LT(glm::distance(slide_coordinates(target), {0.5, 0.5}), 1e-12);
  const glm::dvec3 at_45_degrees = position + view.pose.forward_ws() + view.pose.right_ws();
  EXPECT_NEAR(slide_coordinates(at_45_degrees).x, 1, 1e-12);
  EXPECT_NEAR(slide_coordinates(at_45_degrees).y, 0.5, 1e-12);

  // P: columns across, down and to the top-left corner of the slide at distance 1, in the order of s, t, 1.
  const glm::dvec3 across = 2 * half * view.pose.right_ws();
  const glm::dvec3 down = -half * view.pose.up_ws();
  const glm::dvec3 corner =
      view.pose.forward_ws() - half * view.pose.right_ws() + half / 2 * view.pose.up_ws();
  const glm::dmat3 P(across, down, corner);
  const glm::dmat3 product = P * glm::inverse(P);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j ? 1 : 0, 1e-12);
  }
  // (t i, t j, t) = P⁻¹ (p − position) is what the library's matrix gives.
  for (const glm::dvec3 p : {glm::dvec3(3, 2, -1), glm::dvec3(5, 0, 1), glm::dvec3(2, 3, -4)}) {
    const glm::dvec3 inverted = glm::inverse(P) * (p - position);
    EXPECT_LT(glm::distance(glm::dvec2(inverted) / inverted.z, slide_coordinates(p)), 1e-12);
  }
}

// Row 55: homogeneous coordinates belong to the vertices, the division to the pixels: a floor that runs under the
// projector and far behind it, where a vertex has no slide coordinates to interpolate.
TEST(MitLecture20, CoordinatesAreDividedAtThePixelsNotAtTheVertices) {
  Scene scene;
  Mesher mesh;
  mesh.triangle({-30, 0, 40}, {30, 0, 40}, {0, 0, -25});  // two corners behind the lens
  add_object(scene, "floor", mesh.primitive);
  add_light(scene, projector("lantern", 0.5, 0.5), {0, 2, 6}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  RenderSettings settings = papers_settings(120, 90);
  settings.layers = {Layer::uv, Layer::position, Layer::object};
  const LayeredImage image = render(renderer, look({3, 5, 8}, {0, 0, 1}, 60, 4.0 / 3), settings);
  const glm::dmat4 m = renderer.light_view("lantern")->image_from_world();
  int inside = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float u = at(image, "uv.lantern.u", x, y);
      if (std::isnan(u)) continue;
      const glm::dvec4 q =
          m * glm::dvec4(at(image, "P.X", x, y), at(image, "P.Y", x, y), at(image, "P.Z", x, y), 1);
      EXPECT_NEAR(u, q.x / q.w, 2e-5);
      EXPECT_NEAR(at(image, "uv.lantern.v", x, y), q.y / q.w, 2e-5);
      ++inside;
    }
  }
  EXPECT_GT(inside, 1500);
}

// Row 56: a projector is a light among lights.
TEST(MitLecture20, AProjectorIsALightLikeOthers) {
  Scene scene;
  add_object(scene, "wall", wall(2, 2, 0));
  const Light lights[] = {sun("sun"), projector("lantern", 0.5, 0.5), spot("spot", 30)};
  for (const Light& light : lights) add_light(scene, light, {0, 0, 3}, {0, 0, 0});
  Renderer renderer = make_renderer(std::move(scene));
  RenderSettings settings = test_settings(16, 16);
  settings.layers = {Layer::light};
  const auto middle = [&](const std::string& channel) {
    return at(render(renderer, square_on(0.5, 1), settings), channel, 8, 8);
  };
  for (int i = 0; i < 3; ++i) {
    const std::string red = "light." + lights[i].name + ".R";
    const std::string blue = "light." + lights[i].name + ".B";
    const float before = middle(red);
    EXPECT_GT(before, 0);
    Light light = lights[i];
    light.intensity *= 2;
    light.color = {0.5F, 1, 0.25F};
    ASSERT_TRUE(renderer.set_light(i, light));
    EXPECT_FLOAT_EQ(middle(red), before);
    EXPECT_FLOAT_EQ(middle(blue), before / 2);
    light.enabled = false;
    ASSERT_TRUE(renderer.set_light(i, light));
    const std::vector<std::string> names = renderer.channel_names(settings);
    EXPECT_EQ(std::ranges::find(names, red), names.end());
    ASSERT_TRUE(renderer.set_light(i, lights[i]));
    EXPECT_EQ(middle(red), before);
  }
}

// A wall three frames wide and high, lit by a slide of 4 × 2 colours; the colour at frame coordinates (s, t).
class BeyondTheSlide {
 public:
  static constexpr int kColumns = 4, kRows = 2;
  static float texel(int x, int y) { return 0.1F * static_cast<float>(1 + x + kColumns * y); }

  explicit BeyondTheSlide(Light light) {
    Scene scene;
    add_object(scene, "wall", wall(6, 3, 0));
    light.slide =
        add_linear_picture(scene, kColumns, kRows, [](int x, int y) { return glm::vec3(texel(x, y)); });
    add_light(scene, light, {0, 0, 2}, {0, 0, 0});  // the frame is 4 m × 2 m
    image_ = render(make_renderer(std::move(scene)), square_on(3, 2), papers_settings(480, 240));
  }
  [[nodiscard]] float at_frame(double s, double t) const {
    return at(image_, "R", static_cast<int>(160 + s * 160), static_cast<int>(80 + t * 80));
  }
  // The middle of texel (x, y), counted on beyond the frame.
  [[nodiscard]] float at_texel(int x, int y) const {
    return at_frame((x + 0.5) / kColumns, (y + 0.5) / kRows);
  }

 private:
  LayeredImage image_;
};

// Row 57: outside the slide.
TEST(MitLecture20, OutsideTheSlideItIsBlackOrContinuedAsAsked) {
  const Light light = projector("lantern", 1, 0.5);
  EXPECT_EQ(light.outside, Outside::black);
  constexpr int kColumns = BeyondTheSlide::kColumns;
  constexpr int kRows = BeyondTheSlide::kRows;
  for (const Outside outside : {Outside::black, Outside::clamp, Outside::repeat, Outside::mirror}) {
    Light chosen = light;
    chosen.outside = outside;
    const BeyondTheSlide wall(chosen);
    for (int y = -kRows; y < 2 * kRows; ++y) {
      for (int x = -kColumns; x < 2 * kColumns; ++x) {
        const bool is_inside = x >= 0 && x < kColumns && y >= 0 && y < kRows;
        const auto continued = [&](int i, int size) {
          if (outside == Outside::clamp) return std::clamp(i, 0, size - 1);
          const int wrapped = (i + size) % size;
          if (outside == Outside::repeat || (i >= 0 && i < size)) return wrapped;
          return size - 1 - wrapped;
        };
        const float expected = !is_inside && outside == Outside::black
                                   ? 0
                                   : BeyondTheSlide::texel(continued(x, kColumns), continued(y, kRows));
        // The picture's pixel is not quite in the middle of the texel.
        EXPECT_NEAR(wall.at_texel(x, y), expected, 0.02)
            << static_cast<int>(outside) << ": " << x << ", " << y;
      }
    }
  }
}

// Row 58: nothing behind the lens, however the slide is continued.
TEST(MitLecture20, AWallBehindTheProjectorStaysDark) {
  for (const Outside outside : {Outside::black, Outside::clamp, Outside::repeat, Outside::mirror}) {
    for (const bool is_orthographic : {false, true}) {
      Scene scene;
      add_object(scene, "wall", wall(3, 3, 0));
      Light light = projector("lantern", 0.8, 0.8);
      light.outside = outside;
      light.intensity = 1e6;
      if (is_orthographic) light.projection = Projection::orthographic(1, 1, 0, 50);
      add_light(scene, light, {0, 0, 2}, {0, 0, 4});  // it looks away
      const Renderer renderer = make_renderer(std::move(scene));
      for (const ShadingModel model : {ShadingModel::papers, ShadingModel::phong, ShadingModel::pbr}) {
        RenderSettings settings = papers_settings(64, 64);
        settings.shading = model;
        const LayeredImage image = render(renderer, square_on(3, 1), settings);
        for (const char* channel : {"R", "G", "B"}) {
          for (const float value : values_of(image, channel)) ASSERT_EQ(value, 0) << is_orthographic;
        }
      }
    }
  }
}

// Row 62: the depth picture: near light, far dark, nothing white.
TEST(MitLecture20, DepthPicturesAreLightNearDarkFarAndWhiteWhereNothingIs) {
  const ShadowScene shown = torus_and_box(4.0 / 3);
  const LayeredImage map = make_renderer(shown.scene).depth_map("light").value();
  const LayeredImage picture = depth_picture(map).value();
  std::vector<std::pair<float, float>> pairs;
  for (std::size_t i = 0; i < map.channels[0].values.size(); i += 7) {
    const float z = map.channels[0].values[i];
    const float grey = values_of(picture, "R")[i];
    EXPECT_EQ(grey, values_of(picture, "G")[i]);
    if (std::isinf(z)) {
      EXPECT_EQ(grey, 1);
    } else {
      EXPECT_LT(grey, 1);
      pairs.emplace_back(z, grey);
    }
  }
  std::ranges::sort(pairs);
  ASSERT_GT(pairs.size(), 10000U);
  for (std::size_t i = 1; i < pairs.size(); ++i) ASSERT_LE(pairs[i].second, pairs[i - 1].second);
  EXPECT_GT(pairs.front().second, pairs.back().second + 0.5F);
  // A view that looks past everything.
  const LayeredImage nothing = {1, 1, {{"Z", {std::numeric_limits<float>::infinity()}}}, {}};
  const LayeredImage white = depth_picture(nothing).value();
  EXPECT_EQ(values_of(white, "R")[0], 1);
}

ShadowScene four_lights() {
  ShadowScene shown = torus_and_box(4.0 / 3);
  shown.scene.ambient = {0.1F, 0.12F, 0.15F};
  shown.scene.ambient_is_set = true;
  const int slide = add_linear_picture(shown.scene, 16, 16, [](int x, int y) {
    return glm::vec3((x / 4 + y / 4) % 2 == 0 ? 0.9F : 0.2F, 0.5F, static_cast<float>(x) / 16);
  });
  Light lantern = projector("lantern", 0.5, 0.5, slide);
  lantern.intensity = 20;
  add_light(shown.scene, lantern, {-3, 4, 3}, {0, 0, 0});
  add_light(shown.scene, sun("sun"), {1, 6, -2}, {0, 0, 0});
  Light point = spot("point", 30);
  point.type = LightType::point;
  point.shadow.resolution = 256;
  add_light(shown.scene, point, {1, 3, 3}, {0, 0, 0});
  shown.scene.lights[1].color = {1, 0.6F, 0.3F};
  return shown;
}

// Row 68: several passes and one give the same picture.
TEST(MitLecture20, MultipassEqualsSinglePassBitForBit) {
  const Renderer renderer = make_renderer(four_lights().scene);
  for (const ShadingModel model : {ShadingModel::papers, ShadingModel::phong, ShadingModel::pbr}) {
    for (const int samples : {1, 4}) {
      RenderSettings settings = test_settings(200, 150);
      settings.shading = model;
      settings.samples = samples;
      settings.layers = {Layer::light, Layer::visibility, Layer::lux};
      const LayeredImage single = render(renderer, four_lights().camera, settings);
      settings.passes = Passes::multi;
      EXPECT_EQ(count_different_pixels(single, render(renderer, four_lights().camera, settings)), 0U);
    }
  }
}

// Row 68: and a frame buffer of 8 bits, which rounds after each of N passes, is at most ⌈N/2⌉ codes off.
TEST(MitLecture20, EightBitPassesDriftByHalfACodeEach) {
  ShadowScene shown = four_lights();
  shown.scene.ambient = glm::vec3(0.05F);
  for (Light& light : shown.scene.lights) light.color *= 0.15F;  // unsaturated
  RenderSettings settings = papers_settings(200, 150);
  settings.passes = Passes::multi;
  settings.layers = {Layer::light};
  const LayeredImage image = render(make_renderer(shown.scene), shown.camera, settings);
  const std::size_t passes = 1 + shown.scene.lights.size();
  const auto code = [](float value) { return static_cast<int>(std::lround(255 * value)); };
  int most = 0;
  for (const char* channel : {"R", "G", "B"}) {
    const std::span<const float> beauty = values_of(image, channel);
    for (std::size_t i = 0; i < beauty.size(); ++i) {
      ASSERT_LE(beauty[i], 1);
      int frame_buffer = code(values_of(image, std::string("ambient.") + channel)[i]);
      for (const Light& light : shown.scene.lights) {
        frame_buffer += code(values_of(image, "light." + light.name + "." + channel)[i]);
      }
      most = std::max(most, std::abs(frame_buffer - code(beauty[i])));
    }
  }
  EXPECT_LE(most, (static_cast<int>(passes) + 1) / 2);
  EXPECT_GE(most, 1);
}

// Row 73: n·l at every pixel, normals from a map, diffuse and specular.
TEST(MitLecture20, NormalMapsAreShadedPerPixel) {
  Scene scene;
  add_object(scene, "wall", wall(2, 2, 0), {0.5F, 0.25F, 1});
  // Normals that lean to the right by up to 30°, more and more from left to right; stored as (n + 1) / 2.
  constexpr int kTexels = 64;
  const auto lean = [](double u) { return Angle::degrees(30 * u).in_radians(); };
  scene.materials[0].normal_texture.picture = add_linear_picture(scene, kTexels, 4, [&](int x, int) {
    const double angle = lean((x + 0.5) / kTexels);
    return glm::vec3((static_cast<float>(std::sin(angle)) + 1) / 2, 0.5F,
                     (static_cast<float>(std::cos(angle)) + 1) / 2);
  });
  scene.phong = PhongHighlight{0.4F, 16};
  Light light = spot("light", 60);
  light.type = LightType::point;
  light.intensity = 12;
  const glm::dvec3 light_ws(1, 0.5, 2);
  add_light(scene, light, light_ws, {0, 0, 0});
  const glm::dvec3 eye(0, 0, 5);
  RenderSettings settings = test_settings(120, 120);
  settings.layers = {Layer::position, Layer::normal};
  settings.shadows = ShadowTechnique::none;
  const LayeredImage image = render(make_renderer(std::move(scene)), look(eye, {0, 0, 0}, 40, 1), settings);
  double lowest = 1;
  double highest = 0;
  for (int y = 4; y < 116; ++y) {
    for (int x = 8; x < 112; ++x) {
      const glm::dvec3 p(at(image, "P.X", x, y), at(image, "P.Y", x, y), at(image, "P.Z", x, y));
      const double u = (p.x + 2) / 4;
      if (u < 0.05 || u > 0.95) continue;
      const glm::dvec3 n(std::sin(lean(u)), 0, std::cos(lean(u)));
      EXPECT_NEAR(at(image, "N.X", x, y), n.x, 0.003);
      const glm::dvec3 to_light = light_ws - p;
      const glm::dvec3 l = glm::normalize(to_light);
      const glm::dvec3 h = glm::normalize(l + glm::normalize(eye - p));
      const double arriving = 12 / glm::dot(to_light, to_light);
      const double specular = 0.4 * std::pow(std::max(0.0, glm::dot(n, h)), 16);
      const double expected = arriving * (0.5 * glm::dot(n, l) + specular);
      ASSERT_NEAR(at(image, "R", x, y), expected, 0.01 * expected + 1e-3) << x << ", " << y;
      lowest = std::min(lowest, specular);
      highest = std::max(highest, specular);
    }
  }
  EXPECT_GT(highest, 0.3);
  EXPECT_LT(lowest, 0.05);
}

}  // namespace
}  // namespace laterna
