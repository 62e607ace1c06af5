// Environment maps and specular maps: MIT 6.837, lecture 20 (rows 63 to 65).
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "image/environment_chart.h"
#include "image/environment_map.h"
#include "laterna/environment.h"
#include "reference/shapes.h"
#include "shade/split_sum.h"

namespace laterna {
namespace {

using namespace reference;

/// A latlong picture of a function of the direction.
template <class Radiance>
std::shared_ptr<const Image> latlong(int height, Radiance radiance) {
  auto image = std::make_shared<Image>(2 * height, height, 3, PixelType::f32, Transfer::linear);
  const auto values = image->values<float>();
  std::size_t next = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < 2 * height; ++x) {
      const auto direction =
          *direction_from_image(EnvironmentChart::latlong, {(x + 0.5) / (2 * height), (y + 0.5) / height});
      const glm::dvec3 colour = radiance(direction);
      for (int k = 0; k < 3; ++k) values[next++] = static_cast<float>(colour[k]);
    }
  }
  return image;
}

/// A scene of a sphere about `centre` that is lit by nothing but an environment.
Scene ball_in(std::shared_ptr<const Image> environment, float metallic, float roughness,
              glm::vec3 centre = glm::vec3(0)) {
  Scene scene;
  add_object(scene, "ball", sphere(centre, 1, 96));
  scene.materials[0].metallic = metallic;
  scene.materials[0].roughness = roughness;
  scene.pictures.push_back({});
  scene.pictures.back().pixels = std::move(environment);
  scene.environment.emplace();
  scene.environment->picture = 0;
  return scene;
}

glm::dvec3 value(const LayeredImage& image, const std::string& prefix, const char* names, int x, int y) {
  glm::dvec3 v;
  for (int k = 0; k < 3; ++k) v[k] = static_cast<double>(at(image, prefix + names[k], x, y));
  return v;
}

RenderSettings mirror_settings(int side) {
  RenderSettings settings = test_settings(side, side);
  settings.layers = {Layer::position, Layer::normal, Layer::object};
  return settings;
}

glm::dvec3 colour_of_direction(const glm::dvec3& d) { return d * 0.5 + 0.5; }

constexpr glm::dvec3 kEye(0.4, 0.9, 4);

// What a mirror shows at each pixel, as a colour, against what the ray from the eye is reflected to: degrees.
struct Errors {
  double mean = 0, largest = 0;
  int count = 0;
};
template <class Truth>
Errors mirror_errors(const Renderer& renderer, const glm::dvec3& eye, const glm::dvec3& target, Truth truth) {
  constexpr int kSide = 96;
  const LayeredImage image = render(renderer, look(eye, target, 40, 1), mirror_settings(kSide));
  Errors errors;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (at(image, "id.object", x, y) < 0) continue;
      const glm::dvec3 p = value(image, "P.", "XYZ", x, y),
                       n = glm::normalize(value(image, "N.", "XYZ", x, y));
      const glm::dvec3 reflected = glm::reflect(glm::normalize(p - eye), n);
      const glm::dvec3 seen = glm::normalize(value(image, "", "RGB", x, y) * 2.0 - 1.0);
      const double error =
          std::acos(std::clamp(glm::dot(seen, truth(p, reflected)), -1.0, 1.0)) * 180 / std::numbers::pi;
      errors.mean += error;
      errors.largest = std::max(errors.largest, error);
      ++errors.count;
    }
  }
  errors.mean /= errors.count;
  return errors;
}

// Row 63: a mirror ball shows each direction where reflection puts it, to within half a texel.
TEST(EnvironmentMap, MirrorBallShowsDirectionsToHalfATexel) {
  constexpr int kHeight = 64;
  const Renderer renderer = make_renderer(ball_in(latlong(kHeight, colour_of_direction), 1, 0));
  const Errors errors = mirror_errors(
      renderer, kEye, {0, 0, 0}, [](const glm::dvec3&, const glm::dvec3& reflected) { return reflected; });
  EXPECT_GT(errors.count, 1500);
  EXPECT_LT(errors.largest, 0.5 * 180 / kHeight);
}

// Row 63: left is left and up is up; a turn by 90° brings what was ahead to the left.
TEST(EnvironmentMap, BackgroundIsTheRightWayRound) {
  const auto ahead = [](const RenderSettings& settings, const Renderer& renderer, const glm::dvec3& target) {
    const LayeredImage image = render(renderer, look({0, 0, 0}, target, 20, 1, {0.48, 0.6, 0.64}), settings);
    const glm::dvec3 seen = value(image, "", "RGB", 8, 8);
    return glm::normalize(seen * 2.0 - 1.0);
  };
  const RenderSettings settings = test_settings(17, 17);
  Scene scene = ball_in(latlong(32, colour_of_direction), 1, 0, {0, 0, 500});
  const Renderer as_it_is = make_renderer(scene);
  for (const glm::dvec3 to : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0),
                              glm::dvec3(0, -1, 0), glm::dvec3(0.6, 0, -0.8), glm::dvec3(0, -0.6, -0.8)}) {
    EXPECT_GT(glm::dot(ahead(settings, as_it_is, to), to), std::cos(0.5 * std::numbers::pi / 32));
  }
  scene.environment->world_from_environment = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};  // 90° about +Y
  const Renderer turned = make_renderer(scene);
  EXPECT_GT(ahead(settings, turned, {-1, 0, 0}).z, -1.001);
  EXPECT_LT(ahead(settings, turned, {-1, 0, 0}).z, -0.999);
}

// Row 63: the same-point assumption, and what a box and a sphere make of it. The environment is what the middle of a room
// sees of its walls; truth is where the reflected ray meets them.
TEST(EnvironmentMap, ParallaxIsCorrectedByBoxAndSphere) {
  const glm::dvec3 half(3, 2, 4);
  const auto hit_box = [&](const glm::dvec3& p, const glm::dvec3& d) {
    double t = 1e30;
    for (int k = 0; k < 3; ++k) t = std::min(t, ((d[k] < 0 ? -half[k] : half[k]) - p[k]) / d[k]);
    return p + d * t;
  };
  // Walls are told apart by where they are hit, seen from the middle: the colour is that direction.
  Scene scene = ball_in(latlong(64, colour_of_direction), 1, 0, {1.5F, 0.5F, -1});
  scene.environment->box_low_ws = -half;
  scene.environment->box_high_ws = half;
  scene.environment->radius = 3;
  const auto truth = [&](const glm::dvec3& p, const glm::dvec3& d) { return glm::normalize(hit_box(p, d)); };
  const auto errors_with = [&](EnvironmentDistance distance) {
    scene.environment->distance = distance;
    return mirror_errors(make_renderer(scene), {-1, 0.3, 2.5}, {1.5, 0.5, -1}, truth);
  };
  const Errors infinite = errors_with(EnvironmentDistance::infinite),
               ball = errors_with(EnvironmentDistance::sphere), box = errors_with(EnvironmentDistance::box);
  EXPECT_LT(box.largest, 0.5 * 180 / 64);
  EXPECT_GT(infinite.mean, 15);
  EXPECT_LT(ball.mean, infinite.mean / 2);
  RecordProperty("infinite_mean_deg", std::to_string(infinite.mean));
  RecordProperty("sphere_mean_deg", std::to_string(ball.mean));
}

// Row 64: solid angles of texels, clipped at rims, add up to 4π in every chart and at odd sizes too.
TEST(EnvironmentCharts, SolidAnglesAddUp) {
  for (const EnvironmentChartDescription& known : list_environment_charts()) {
    for (const int size : {1, 2, 5, 8, 33, 64}) {
      const int width = known.columns * size, height = known.rows * size;
      double sum = 0;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const double texel = texel_solid_angle(known.chart, width, height, x, y);
          EXPECT_GE(texel, 0);
          sum += texel;
        }
      }
      EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-6) << known.name << " " << size;
    }
  }
}

// Row 64: a texel's solid angle is what directions spread evenly find of it.
TEST(EnvironmentCharts, SolidAnglesAreTheShareOfDirections) {
  constexpr int kSize = 4, kDirections = 200000;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const EnvironmentChartDescription& known : list_environment_charts()) {
    const int width = known.columns * kSize, height = known.rows * kSize;
    std::vector<int> hits(static_cast<std::size_t>(width * height));
    for (int i = 0; i < kDirections; ++i) {
      const glm::dvec3 d(normal(random), normal(random), normal(random));
      const glm::dvec2 at_image = image_from_direction(known.chart, d);
      const int x = std::min(static_cast<int>(at_image.x * width), width - 1);
      const int y = std::min(static_cast<int>(at_image.y * height), height - 1);
      ++hits[static_cast<std::size_t>(y * width + x)];
      EXPECT_LT(glm::length(*direction_from_image(known.chart, at_image) - glm::normalize(d)), 1e-9);
    }
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double share = texel_solid_angle(known.chart, width, height, x, y) / (4 * std::numbers::pi);
        const double deviation = std::sqrt(std::max(share * (1 - share) / kDirections, 0.0));
        EXPECT_NEAR(hits[static_cast<std::size_t>(y * width + x)] / double{kDirections}, share,
                    5 * deviation + 1e-12)
            << known.name << " " << x << " " << y;
      }
    }
  }
}

// Row 64: OpenGL's own formulas for cube maps (table 8.19) and sphere maps.
TEST(EnvironmentCharts, CubeAndSphereAreOpenGLs) {
  const auto expect = [](EnvironmentChart chart, glm::dvec3 d, glm::dvec2 position) {
    const glm::dvec2 found = image_from_direction(chart, d);
    EXPECT_NEAR(found.x, position.x, 1e-12);
    EXPECT_NEAR(found.y, position.y, 1e-12);
  };
  // +X: s = (−z / x + 1) / 2, t = (−y / x + 1) / 2; −Z: s = (−x / |z| + 1) / 2.
  expect(EnvironmentChart::cube, {2, 0.5, 1}, {((-0.5 + 1) / 2) / 6, (-0.25 + 1) / 2});
  expect(EnvironmentChart::cube, {1, 0.5, -2}, {(5 + (-0.5 + 1) / 2) / 6, (-0.25 + 1) / 2});
  expect(EnvironmentChart::cube, {0.2, 2, 1}, {(2 + (0.1 + 1) / 2) / 6, (0.5 + 1) / 2});
  const glm::dvec3 r = glm::normalize(glm::dvec3(0.3, 0.5, 0.4));
  const double m = 2 * std::sqrt(r.x * r.x + r.y * r.y + (r.z + 1) * (r.z + 1));
  expect(EnvironmentChart::sphere, r, {r.x / m + 0.5, 1 - (r.y / m + 0.5)});
  expect(EnvironmentChart::latlong, {0, 0, -1}, {0.5, 0.5});
  expect(EnvironmentChart::latlong, {1, 0, 0}, {0.75, 0.5});
}

// Row 64: from any chart to any other and back nothing is lost but what the grids cannot hold, and no edge shows.
TEST(EnvironmentCharts, ConvertIntoEachOtherWithoutSeams) {
  const auto smooth = [](const glm::dvec3& d) {
    return glm::dvec3(0.5 + 0.4 * d.x, 0.5 + 0.3 * d.y * d.z, 0.5 + 0.3 * std::sin(3 * d.z + d.x));
  };
  for (const EnvironmentChartDescription& from : list_environment_charts()) {
    LayeredImage source;
    constexpr int kSize = 64;
    source.width = from.columns * kSize;
    source.height = from.rows * kSize;
    for (int k = 0; k < 3; ++k) {
      Channel channel{std::string(1, "RGB"[k]), {}};
      for (int y = 0; y < source.height; ++y) {
        for (int x = 0; x < source.width; ++x) {
          const auto d =
              direction_from_image(from.chart, {(x + 0.5) / source.width, (y + 0.5) / source.height});
          // Beyond rims a picture may hold anything.
          channel.values.push_back(d ? static_cast<float>(smooth(*d)[k]) : 99.0F);
        }
      }
      source.channels.push_back(std::move(channel));
    }
    for (const EnvironmentChartDescription& to : list_environment_charts()) {
      const auto converted = convert_environment(source, {from.chart, to.chart, 32, 1});
      ASSERT_TRUE(converted.has_value());
      double largest = 0;
      for (int y = 0; y < converted->height; ++y) {
        for (int x = 0; x < converted->width; ++x) {
          const auto d =
              direction_from_image(to.chart, {(x + 0.5) / converted->width, (y + 0.5) / converted->height});
          if (!d || texel_solid_angle(to.chart, converted->width, converted->height, x, y) < 1e-4) continue;
          for (int k = 0; k < 3; ++k) {
            const float found = converted->channels[static_cast<std::size_t>(k)]
                                    .values[static_cast<std::size_t>(y * converted->width + x)];
            largest = std::max(largest, std::abs(static_cast<double>(found) - smooth(*d)[k]));
          }
        }
      }
      // Texels at the rim of a mirror ball are 17° long: half of that times how fast the light changes.
      const bool is_sphere = from.chart == EnvironmentChart::sphere || to.chart == EnvironmentChart::sphere;
      EXPECT_LT(largest, is_sphere ? 0.15 : 0.02) << from.name << " to " << to.name;
    }
  }
}

// Row 64: the table of charts against closed forms.
TEST(EnvironmentCharts, DistortionIsWhatGeometrySays) {
  const ChartDistortion cube = measure_distortion(EnvironmentChart::cube, 128);
  EXPECT_NEAR(cube.largest_solid_angle / cube.smallest_solid_angle, std::sqrt(27.0), 0.1);
  EXPECT_NEAR(cube.anisotropy, std::sqrt(3.0), 0.02);
  const ChartDistortion sphere = measure_distortion(EnvironmentChart::sphere, 128);
  EXPECT_NEAR(sphere.largest_solid_angle / sphere.smallest_solid_angle, 1, 1e-6);
  EXPECT_NEAR(sphere.unused_share, 1 - std::numbers::pi / 4, 1e-12);
  const ChartDistortion paraboloid = measure_distortion(EnvironmentChart::dual_paraboloid, 128);
  EXPECT_NEAR(paraboloid.largest_solid_angle / paraboloid.smallest_solid_angle, 4, 0.1);
  EXPECT_NEAR(paraboloid.anisotropy, 1, 1e-4);
  EXPECT_NEAR(measure_distortion(EnvironmentChart::horizontal_cross, 8).unused_share, 0.5, 1e-12);
}

// ---------------------------------------------------------------------------------------------- specular maps

image::EnvironmentPicture picture_of(const Image& image) {
  std::vector<glm::vec3> texels;
  const auto values = image.values<float>();
  for (std::size_t i = 0; i < values.size(); i += 3)
    texels.emplace_back(values[i], values[i + 1], values[i + 2]);
  return {EnvironmentChart::latlong, image.width(), image.height(), texels};
}

// A sky with a sun three hundred times as bright and 8° wide, and a dark ground with stripes.
glm::dvec3 sunny(const glm::dvec3& d) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.5, 0.6, -0.4));
  const double disc = 300 * std::exp(-(1 - glm::dot(d, sun)) / (1 - std::cos(4 * std::numbers::pi / 180)));
  const glm::dvec3 sky =
      d.y > 0 ? glm::dvec3(0.4, 0.6, 1) * (1 + d.y) : glm::dvec3(0.2 + 0.1 * std::sin(9 * d.x));
  return sky + glm::dvec3(disc);
}

// Directions all around with their light: one at random in each of many small fields.
struct LightSample {
  glm::dvec3 direction, radiance;
  double solid_angle;
};
std::vector<LightSample> sample_all_around(const image::EnvironmentPicture& picture) {
  constexpr int kGrid = 400;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  std::vector<LightSample> samples;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const int row = i / kGrid;
    const image::PanelPoint at{0, 2 * (i % kGrid + uniform(random)) / kGrid - 1,
                               2 * (row + uniform(random)) / kGrid - 1};
    const glm::dvec3 direction = image::direction_from_panel(EnvironmentChart::octahedral, at);
    samples.push_back({direction, picture.look_up(direction),
                       image::panel_density(EnvironmentChart::octahedral, at) * 4 / (kGrid * kGrid)});
  }
  return samples;
}

// Row 65: what is kept for a roughness is the integral over GGX's lobe with N = V = R, by Monte Carlo, to 2 %.
TEST(SpecularMap, MatchesMonteCarloTo2Percent) {
  const auto source = latlong(128, sunny);
  const image::EnvironmentPicture picture = picture_of(*source);
  const std::vector<LightSample> samples = sample_all_around(picture);
  const image::EnvironmentMap map =
      image::make_environment_map(picture, TaskPool(1), best_instruction_set(), {});
  ASSERT_EQ(map.mirrored.levels.size(), image::kMirrorLevels);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  for (std::size_t level = 1; level < image::kMirrorLevels; ++level) {
    const double roughness = static_cast<double>(level) / (image::kMirrorLevels - 1),
                 a2 = std::pow(roughness, 4);
    const int side = map.mirrored.levels[level].side;
    double squared_error = 0, squared = 0;
    for (int i = 0; i < 32; ++i) {
      const int x = static_cast<int>(uniform(random) * side), y = static_cast<int>(uniform(random) * side);
      const glm::dvec3 n =
          *direction_from_image(EnvironmentChart::octahedral, {(x + 0.5) / side, (y + 0.5) / side});
      glm::dvec3 sum(0);
      double weight = 0;
      for (const LightSample& sample : samples) {
        const double n_l = sample.direction.x * n.x + sample.direction.y * n.y + sample.direction.z * n.z;
        if (n_l <= 0) continue;
        // D of the half vector, whose squared cosine is (1 + n·l) / 2.
        const double t = (1 + n_l) / 2 * (a2 - 1) + 1, share = n_l / (t * t) * sample.solid_angle;
        sum += sample.radiance * share;
        weight += share;
      }
      const glm::dvec3 truth = sum / weight;
      const std::size_t at_texel = map.mirrored.index(level, x, y);
      const glm::dvec3 kept(map.mirrored.r[at_texel], map.mirrored.g[at_texel], map.mirrored.b[at_texel]);
      squared_error += glm::dot(kept - truth, kept - truth);
      squared += glm::dot(truth, truth);
    }
    EXPECT_LT(std::sqrt(squared_error / squared), 0.02) << "roughness " << roughness;
  }
}

// Ramamoorthi & Hanrahan 2001: under radiance 1 + y irradiance is π + (2π/3) n·y, exactly.
TEST(SpecularMap, IrradianceByHarmonicsIsExactForSmoothLight) {
  const auto source = latlong(64, [](const glm::dvec3& d) { return glm::dvec3(1, 1 + d.y, 1 + d.x * d.z); });
  const image::EnvironmentMap map =
      image::make_environment_map(picture_of(*source), TaskPool(1), best_instruction_set(), {});
  for (const glm::dvec3 n : {glm::dvec3(0, 1, 0), glm::dvec3(0.6, -0.8, 0), glm::dvec3(0.6, 0, 0.8)}) {
    glm::dvec3 irradiance(0);
    const auto basis = image::spherical_harmonics(n);
    for (std::size_t i = 0; i < 9; ++i) irradiance += map.irradiance[i] * basis[i];
    EXPECT_NEAR(irradiance.x, std::numbers::pi, 2e-3);
    EXPECT_NEAR(irradiance.y, std::numbers::pi + 2 * std::numbers::pi / 3 * n.y, 2e-3);
    EXPECT_NEAR(irradiance.z, std::numbers::pi + std::numbers::pi / 4 * n.x * n.z, 2e-3);
  }
}

// A smooth mirror's table is Schlick's Fresnel term; a rough one's the integral by brute force.
TEST(SpecularMap, SplitSumIsTheIntegralOfTheReflectance) {
  for (const double n_v : {0.1, 0.5, 0.9}) {
    const shade::ScaleAndBias smooth = shade::integrate_reflectance(n_v, 0, 512);
    EXPECT_NEAR(smooth.bias, std::pow(1 - n_v, 5), 2e-3);
    EXPECT_NEAR(smooth.scale + smooth.bias, 1, 2e-3);
  }
  // GGX, separable Smith and Schlick over the hemisphere, by a fine grid of light directions.
  const double roughness = 0.6, n_v = 0.4, alpha = roughness * roughness, a2 = alpha * alpha;
  const glm::dvec3 v(std::sqrt(1 - n_v * n_v), 0, n_v);
  double scale = 0, bias = 0;
  constexpr int kGrid = 1000;
  for (int i = 0; i < kGrid; ++i) {
    for (int j = 0; j < kGrid; ++j) {
      const double n_l = (i + 0.5) / kGrid, turn = 2 * std::numbers::pi * (j + 0.5) / kGrid,
                   across = std::sqrt(1 - n_l * n_l);
      const glm::dvec3 l(across * std::cos(turn), across * std::sin(turn), n_l);
      const glm::dvec3 h = glm::normalize(l + v);
      const double t = h.z * h.z * (a2 - 1) + 1, distribution = a2 / (std::numbers::pi * t * t);
      const auto g1 = [&](double c) { return 2 * c / (c + std::sqrt(a2 + (1 - a2) * c * c)); };
      const double f =
          distribution * g1(n_l) * g1(n_v) / (4 * n_l * n_v) * n_l * 2 * std::numbers::pi / (kGrid * kGrid);
      const double fresnel = std::pow(1 - glm::dot(v, h), 5);
      scale += f * (1 - fresnel);
      bias += f * fresnel;
    }
  }
  const shade::ScaleAndBias entry = shade::integrate_reflectance(n_v, roughness, 4096);
  EXPECT_NEAR(entry.scale, scale, 2e-3);
  EXPECT_NEAR(entry.bias, bias, 2e-3);
}

// A white furnace: in an environment of 1 everywhere a white ball cannot be told from it, whatever it is made of.
TEST(SpecularMap, WhiteBallsVanishInAWhiteFurnace) {
  const auto white = latlong(4, [](const glm::dvec3&) { return glm::dvec3(1); });
  for (const ShadingModel model : {ShadingModel::pbr, ShadingModel::papers}) {
    for (const float metallic : {0.0F, 1.0F}) {
      for (const float roughness : {0.0F, 0.3F, 0.7F, 1.0F}) {
        RenderSettings settings = mirror_settings(32);
        settings.shading = model;
        const LayeredImage image = render(make_renderer(ball_in(white, metallic, roughness)),
                                          look(kEye, {0, 0, 0}, 40, 1), settings);
        for (int y = 0; y < 32; ++y) {
          for (int x = 0; x < 32; ++x)
            EXPECT_NEAR(at(image, "R", x, y), 1, 2e-3) << metallic << " " << roughness;
        }
      }
    }
  }
}

}  // namespace
}  // namespace laterna
