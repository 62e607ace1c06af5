// Segal et al. 1992, section 3.1: the slide projector.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"

namespace laterna {
namespace {

using namespace reference;

constexpr glm::vec3 kBlack(0), kWhite(1);

// Row 1: a cell of a 16 × 9 checker is 2 d tan(h/2) / 16 wide on a square-on wall.
TEST(Segal1992Slide, CheckerCellsAreAsWideAsDistanceAndFieldSay) {
  struct Throw {
    double distance, horizontal_deg;
  };
  for (const Throw t : {Throw{2, 30}, Throw{5, 40}, Throw{12, 70}}) {
    const double half_tangent = std::tan(Angle::degrees(t.horizontal_deg / 2).in_radians());
    Scene scene;
    add_object(scene, "wall", wall(40, 40, 0));
    const int slide = add_picture(
        scene, 160, 90, [](int x, int y) { return glm::u8vec3((x / 10 + y / 10) % 2 == 0 ? 255 : 0); });
    Light light = projector("lantern", half_tangent, half_tangent * 9 / 16, slide);
    light.projection.left = -1, light.projection.right = 1;  // the aspect is the slide's
    light.aspect_from_slide = true;
    add_light(scene, light, {0, 0, t.distance}, {0, 0, 0});
    const Renderer renderer = make_renderer(std::move(scene));
    constexpr int kWidth = 480;
    constexpr int kHeight = 300;
    const double camera_distance = 1.3 * t.distance;
    const View camera = look({0, 0, camera_distance}, {0, 0, 0}, t.horizontal_deg, 1.6);
    const LayeredImage image = render(renderer, camera, papers_settings(kWidth, kHeight));
    const double pixels_per_metre = kHeight / (2 * camera_distance * half_tangent);
    const double expected = 2 * t.distance * half_tangent / 16 * pixels_per_metre;

    // Through the middle of the fifth row of cells. 15 edges between cells, and the outer edge of the one white end.
    const std::vector<double> edges = crossings(row_of(image, "R", kHeight / 2), 0.5);
    ASSERT_EQ(edges.size(), 16U);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
      EXPECT_NEAR(edges[i + 1] - edges[i], expected, 0.5) << i;
    // And as high as they are wide: through the middle of a column.
    std::vector<float> column;
    column.reserve(kHeight);
    for (int y = 0; y < kHeight; ++y)
      column.push_back(at(image, "R", kWidth / 2 + static_cast<int>(expected / 2), y));
    const std::vector<double> rows = crossings(column, 0.5);
    ASSERT_GE(rows.size(), 8U);
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) EXPECT_NEAR(rows[i + 1] - rows[i], expected, 0.5) << i;
  }
}

// A slide magnified as the renderer magnifies it: bilinear, in float, at the renderer's own slide coordinates.
glm::vec3 magnified(const std::vector<glm::vec3>& texels, int width, int height, float s, float t) {
  const auto tap = [](float coordinate, int size, int& low, int& high) {
    const float position = coordinate * static_cast<float>(size) - 0.5F;
    const float floor = std::floor(position);
    low = std::clamp(static_cast<int>(floor), 0, size - 1);
    high = std::min(static_cast<int>(floor) + 1, size - 1);
    return position - floor;
  };
  int x[2];
  int y[2];
  const float along = tap(s, width, x[0], x[1]);
  const float down = tap(t, height, y[0], y[1]);
  const auto texel = [&](int i, int j) { return texels[static_cast<std::size_t>(y[j] * width + x[i])]; };
  const glm::vec3 above = texel(0, 0) + (texel(1, 0) - texel(0, 0)) * along;
  const glm::vec3 below = texel(0, 1) + (texel(1, 1) - texel(0, 1)) * along;
  return above + (below - above) * down;
}

// Two colour slides, in any order of 8 × 6 texels, on a wall and a tilted floor of different colours.
struct TwoSlides {
  Scene scene;
  std::vector<glm::vec3> texels[2];
};
constexpr int kTexelsX = 8, kTexelsY = 6;

TwoSlides two_slides(glm::vec3 wall_color, glm::vec3 floor_color) {
  TwoSlides two;
  for (int k = 0; k < 2; ++k) {
    for (int i = 0; i < kTexelsX * kTexelsY; ++i) {
      // Values of a few bits, spread by multiplication modulo 17.
      const auto value = [&](int n) { return static_cast<float>(n * (i + 3) % 17) / 16; };
      two.texels[k].emplace_back(value(5 + k), value(7 + k), value(11 + k));
    }
  }
  Scene& scene = two.scene;
  add_object(scene, "wall", wall(4, 3, -1), wall_color);
  add_object(scene, "floor", floor(4, -1), floor_color);
  scene.ambient = {0.125F, 0.25F, 0.0625F};
  scene.ambient_is_set = true;
  for (int k = 0; k < 2; ++k) {
    const int slide = add_linear_picture(scene, kTexelsX, kTexelsY, [&](int x, int y) {
      return two.texels[k][static_cast<std::size_t>(y * kTexelsX + x)];
    });
    add_light(scene, projector(k == 0 ? "left" : "right", 0.4, 0.3, slide), {k == 0 ? -2 : 1.5, 0.5, 5},
              {0, -0.4 * k, -1});
  }
  return two;
}
const View kTwoSlidesCamera = look({0.4, 1, 7}, {0, 0, -1}, 42, 4.0 / 3);

glm::vec3 color_at(const LayeredImage& image, const std::string& prefix, int x, int y) {
  return {at(image, prefix + "R", x, y), at(image, prefix + "G", x, y), at(image, prefix + "B", x, y)};
}

// Row 7: pixel = c · (ambient + Σ slides), against a per-pixel oracle; the frame buffer after each pass is a picture.
TEST(Segal1992Slide, ThreePassesGiveColourTimesAmbientPlusSlidesExactly) {
  // Colours that are powers of two: multiplying by them loses nothing, so the oracle's one product is exact too.
  TwoSlides two = two_slides({0.5F, 1, 0.25F}, {1, 0.25F, 0.5F});
  const Renderer renderer = make_renderer(std::move(two.scene));
  RenderSettings settings = papers_settings(160, 120);
  settings.shadows = ShadowTechnique::none;
  settings.passes = Passes::multi;
  settings.layers = {Layer::albedo, Layer::uv, Layer::depth, Layer::object, Layer::passes};
  const LayeredImage image = render(renderer, kTwoSlidesCamera, settings);
  int lit_by[3] = {};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      EXPECT_EQ(at(image, "pass.1.z", x, y), at(image, "Z", x, y));
      if (at(image, "id.object", x, y) < 0) continue;
      const glm::vec3 c = color_at(image, "albedo.", x, y);
      glm::vec3 sum = {0.125F, 0.25F, 0.0625F};
      EXPECT_EQ(color_at(image, "pass.1.c.", x, y), c * sum);
      int slides = 0;
      for (int k = 0; k < 2; ++k) {
        const std::string name = k == 0 ? "left" : "right";
        const float s = at(image, "uv." + name + ".u", x, y);
        const float t = at(image, "uv." + name + ".v", x, y);
        if (!std::isnan(s)) {
          sum += magnified(two.texels[k], kTexelsX, kTexelsY, s, t);
          ++slides;
        }
        EXPECT_EQ(color_at(image, "pass.3." + name + ".c.", x, y), c * sum);
      }
      ++lit_by[slides];
      ASSERT_EQ(color_at(image, "", x, y), c * sum) << x << ", " << y;
    }
  }
  for (const int pixels : lit_by) EXPECT_GT(pixels, 500);
}

// Row 8: what is visible is brightened once, however many polygons lie there.
TEST(Segal1992Slide, CoincidentAndStackedPolygonsAreBrightenedOnce) {
  const auto picture_of = [](std::initializer_list<float> depths, Passes passes) {
    Scene scene;
    for (const float z : depths) add_object(scene, "wall", wall(2, 2, z), {0.7F, 0.5F, 0.3F});
    scene.ambient = glm::vec3(0.1F);
    scene.ambient_is_set = true;
    const int slide = add_linear_picture(scene, 4, 4, [](int x, int y) {
      return glm::vec3(0.3F, 0.1F * static_cast<float>(x), 0.2F * static_cast<float>(y));
    });
    add_light(scene, projector("lantern", 0.3, 0.3, slide), {1, 0, 4}, {0, 0, 0});
    RenderSettings settings = papers_settings(96, 96);
    settings.passes = passes;
    settings.shadows = ShadowTechnique::none;
    return render(make_renderer(std::move(scene)), look({0, 0, 5}, {0, 0, 0}, 40, 1), settings);
  };
  for (const Passes passes : {Passes::single, Passes::multi}) {
    const LayeredImage one = picture_of({0}, passes);
    EXPECT_GT(at(one, "R", 48, 48), 0.2F);
    EXPECT_EQ(count_different_pixels(one, picture_of({0, 0}, passes)), 0U);
    EXPECT_EQ(count_different_pixels(one, picture_of({0, -0.01F, -1}, passes)), 0U);
    EXPECT_EQ(count_different_pixels(one, picture_of({-1, 0, 0, -0.5F}, passes)), 0U);
  }
}

// Row 9: the plain slide of the paper shines through what stands in its way; with shadows it does not.
TEST(Segal1992Slide, WithoutShadowsTheSlidePassesThroughAnOccluder) {
  Scene scene;
  add_object(scene, "wall", wall(2, 2, 0));
  add_object(scene, "occluder", wall(0.3F, 0.3F, 2));
  add_light(scene, projector("lantern", 0.4, 0.4), {0, 0, 4}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  // From the side, past the occluder, at the middle of the wall.
  const View camera = look({3, 0, 3}, {0, 0, 0}, 30, 1);
  RenderSettings settings = papers_settings(64, 64);
  settings.shadows = ShadowTechnique::none;
  EXPECT_EQ(at(render(renderer, camera, settings), "R", 32, 32), 1);
  settings.shadows = ShadowTechnique::map;
  EXPECT_EQ(at(render(renderer, camera, settings), "R", 32, 32), 0);
}

// Row 10: several slides at once are the sum of each, bit for bit, and each is what it is alone.
TEST(Segal1992Slide, SeveralSlidesAddUpBitForBit) {
  TwoSlides two = two_slides({0.7F, 0.55F, 0.3F}, {0.2F, 0.6F, 0.9F});
  Light sun;
  sun.name = "sun";
  sun.type = LightType::directional;
  sun.color = {1, 0.9F, 0.7F};
  sun.intensity = 0.8;
  add_light(two.scene, sun, {3, 8, 4}, {0, 0, 0});
  const Scene scene = two.scene;
  for (const ShadingModel model : {ShadingModel::papers, ShadingModel::phong, ShadingModel::pbr}) {
    RenderSettings settings = papers_settings(160, 120);
    settings.shading = model;
    settings.layers = {Layer::light};
    const LayeredImage all = render(make_renderer(scene), kTwoSlidesCamera, settings);
    for (const char* channel : {"R", "G", "B"}) {
      const std::span<const float> beauty = values_of(all, channel);
      std::vector<float> sum(values_of(all, std::string("ambient.") + channel).begin(),
                             values_of(all, std::string("ambient.") + channel).end());
      for (const Light& light : scene.lights) {
        const std::span<const float> part = values_of(all, "light." + light.name + "." + channel);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
      }
      for (std::size_t i = 0; i < sum.size(); ++i) ASSERT_EQ(beauty[i], sum[i]);
    }
    for (const Light& alone : scene.lights) {
      Scene one = scene;
      for (Light& light : one.lights) light.enabled = light.name == alone.name;
      const LayeredImage image = render(make_renderer(std::move(one)), kTwoSlidesCamera, settings);
      for (const char* channel : {"R", "G", "B"}) {
        const std::string name = "light." + alone.name + "." + channel;
        EXPECT_TRUE(std::ranges::equal(values_of(image, name), values_of(all, name))) << name;
      }
    }
  }
}

// Row 11: the surface's own texture modulates the slide, channel by channel.
TEST(Segal1992Slide, TexturedWallTimesSlideIsTheProductOfTheTwoPictures) {
  const auto picture_of = [](bool has_texture, bool has_slide) {
    Scene scene;
    add_object(scene, "wall", wall(2, 2, 0));
    if (has_texture) {
      scene.materials[0].base_color_texture.picture = add_linear_picture(scene, 16, 16, [](int x, int y) {
        return glm::vec3(static_cast<float>(x) / 16, static_cast<float>(y) / 16,
                         (x + y) % 3 == 0 ? 0.8F : 0.1F);
      });
    }
    const int slide = !has_slide ? -1 : add_linear_picture(scene, 10, 10, [](int x, int y) {
      return glm::vec3(x % 2 == 0 ? 0.9F : 0.2F, static_cast<float>(x * y) / 100, 0.5F);
    });
    add_light(scene, projector("lantern", 0.6, 0.6, slide), {0.5, 0, 4}, {0, 0, 0});
    return render(make_renderer(std::move(scene)), look({0, 1, 5}, {0, 0, 0}, 40, 1),
                  papers_settings(128, 128));
  };
  const LayeredImage texture = picture_of(true, false);
  const LayeredImage slide = picture_of(false, true);
  const LayeredImage both = picture_of(true, true);
  for (const char* channel : {"R", "G", "B"}) {
    double brightest = 0;
    for (std::size_t i = 0; i < both.channels[0].values.size(); ++i) {
      const float product = values_of(texture, channel)[i] * values_of(slide, channel)[i];
      ASSERT_FLOAT_EQ(values_of(both, channel)[i], product);
      brightest = std::max<double>(brightest, product);
    }
    EXPECT_GT(brightest, 0.2);
  }
}

// From far away many cells of a slide fall into one pixel: they come out as their mean, not as noise.
TEST(Segal1992Slide, MinifiedSlidesDoNotAlias) {
  Scene scene;
  add_object(scene, "wall", wall(40, 40, 0));
  const int slide =
      add_linear_picture(scene, 512, 512, [](int x, int y) { return (x + y) % 2 == 0 ? kWhite : kBlack; });
  add_light(scene, projector("lantern", 0.5, 0.5, slide), {0, 0, 20},
            {0, 0, 0});  // 20 m wide on the wall: 26 cells a metre
  const Renderer renderer = make_renderer(std::move(scene));
  for (const double distance : {60.0, 150.0, 400.0}) {  // 2.7 cells per pixel and more
    const LayeredImage image =
        render(renderer, look({0, 0, distance}, {0, 0, 0}, 30, 1), papers_settings(300, 300));
    const double half_frame = 10 / (distance * std::tan(Angle::degrees(15).in_radians())) * 150;  // pixels
    const int reach = std::min(140, static_cast<int>(half_frame) - 4);
    for (int y = 150 - reach; y < 150 + reach; ++y) {
      for (int x = 150 - reach; x < 150 + reach; ++x)
        ASSERT_NEAR(at(image, "R", x, y), 0.5F, 0.01F) << distance;
    }
  }
}

// From near, a texel many pixels wide fades into the next one evenly: no blocks.
TEST(Segal1992Slide, MagnifiedSlidesShowNoBlocks) {
  Scene scene;
  add_object(scene, "wall", wall(4, 4, 0));
  const int slide =
      add_linear_picture(scene, 8, 8, [](int x, int y) { return (x + y) % 2 == 0 ? kWhite : kBlack; });
  add_light(scene, projector("lantern", 0.5, 0.5, slide), {0, 0, 4}, {0, 0, 0});  // a texel is 0.5 m wide
  const LayeredImage image =
      render(make_renderer(std::move(scene)), square_on(1.5, 1), papers_settings(300, 300));
  constexpr double kTexel = 0.5 * 100;  // pixels
  double steepest = 0;
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x + 1 < 300; ++x) {
      steepest = std::max<double>(steepest, std::abs(at(image, "R", x + 1, y) - at(image, "R", x, y)));
    }
  }
  // From one texel's centre to the next by 1: no step is larger than the ramp's.
  EXPECT_LT(steepest, 1.001 / kTexel);
  EXPECT_GT(steepest, 0.9 / kTexel);
}

}  // namespace
}  // namespace laterna
