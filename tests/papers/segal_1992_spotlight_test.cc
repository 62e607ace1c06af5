// Segal et al. 1992, section 3.2: spotlights as intensity maps, and how light fades.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"

namespace laterna {
namespace {

using namespace reference;

// A five-pointed star, (x, y) in [−1, 1]².
bool is_in_star(double x, double y) {
  const double fifth = 2 * std::acos(-1.0) / 5;
  double angle = std::fmod(std::atan2(x, y) + 10 * fifth, fifth);
  angle = std::min(angle, fifth - angle);
  // The side of a spike: the line from its tip (0.9, at angle 0) to the notch (0.4, at half a fifth).
  const glm::dvec2 tip(0.9, 0);
  const glm::dvec2 notch(0.4 * std::cos(fifth / 2), 0.4 * std::sin(fifth / 2));
  const glm::dvec2 p = std::hypot(x, y) * glm::dvec2(std::cos(angle), std::sin(angle));
  const glm::dvec2 side = notch - tip;
  return side.x * (p.y - tip.y) - side.y * (p.x - tip.x) > 0;
}

constexpr int kMapSide = 256;
double map_position(int i) { return (2 * i + 1.0) / kMapSide - 1; }

// The settings in which lux is E and nothing stands in the way.
RenderSettings lux_settings(int width, int height) {
  RenderSettings settings = test_settings(width, height);
  settings.shadows = ShadowTechnique::none;
  settings.layers = {Layer::lux};
  return settings;
}

constexpr double kHalfTangent = 0.8;
constexpr double kWallDistance = 3;

Renderer wall_lit_by(const Light& light, Scene scene = {}) {
  add_object(scene, "wall", wall(20, 20, 0));
  add_light(scene, light, {0, 0, kWallDistance}, {0, 0, 0});
  return make_renderer(std::move(scene));
}

// Lumens that fall on the wall within a square-on picture of `half` metres to each side.
double flux_on_wall(const Renderer& renderer, double half) {
  constexpr int kSide = 400;
  const LayeredImage image = render(renderer, square_on(half, 1), lux_settings(kSide, kSide));
  double sum = 0;
  for (const float lux : values_of(image, "lux.Y")) sum += lux;
  return sum * (2 * half / kSide) * (2 * half / kSide);
}

// Row 16: any spot shape.
TEST(Segal1992Spotlight, AStarShapedMapThrowsAStarWithTheMapsFlux) {
  Scene scene;
  const int map = add_picture(scene, kMapSide, kMapSide, [](int x, int y) {
    return glm::u8vec3(is_in_star(map_position(x), -map_position(y)) ? 255 : 0);
  });
  Light light = projector("star", kHalfTangent, kHalfTangent, map);
  light.slide_is_intensity = true;
  light.intensity = 500;
  const Renderer renderer = wall_lit_by(light, std::move(scene));

  const double half = kHalfTangent * kWallDistance;
  constexpr int kSide = 400;
  const LayeredImage image = render(renderer, square_on(half, 1), lux_settings(kSide, kSide));
  constexpr double kTexel = 2.0 / kMapSide;
  int inside = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double sx = (2 * x + 1.0) / kSide - 1;
      const double sy = 1 - (2 * y + 1.0) / kSide;
      const bool in_star = is_in_star(sx, sy);
      bool is_edge = false;
      for (int i = -2; i <= 2; ++i) {  // within two texels: the map's own edge is a staircase
        for (int j = -2; j <= 2; ++j)
          is_edge = is_edge || is_in_star(sx + i * kTexel, sy + j * kTexel) != in_star;
      }
      if (is_edge) continue;
      ASSERT_EQ(at(image, "lux.Y", x, y) > 0, in_star) << x << ", " << y;
      inside += in_star ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 20000);

  // Flux: candela of each texel times the solid angle it stands for.
  double flux = 0;
  for (int y = 0; y < kMapSide; ++y) {
    for (int x = 0; x < kMapSide; ++x) {
      if (!is_in_star(map_position(x), -map_position(y))) continue;
      const double tx = map_position(x) * kHalfTangent;
      const double ty = map_position(y) * kHalfTangent;
      const double side = 2 * kHalfTangent / kMapSide;
      flux += 500 * side * side / std::pow(1 + tx * tx + ty * ty, 1.5);
    }
  }
  EXPECT_NEAR(flux_on_wall(renderer, half), flux, 0.01 * flux);
}

// Row 16: a map that holds one intensity makes E fall with the cube of the cosine on a square-on wall, whether it is
// called an intensity map or a beam of uniform candela.
TEST(Segal1992Spotlight, UniformIntensityFallsWithTheCubeOfTheCosine) {
  for (const bool is_map : {true, false}) {
    Scene scene;
    Light light = projector("spot", kHalfTangent, kHalfTangent);
    light.intensity = 900;
    if (is_map) {
      light.slide = add_picture(scene, 4, 4, [](int, int) { return glm::u8vec3(255); });
      light.slide_is_intensity = true;
    } else {
      light.profile = BeamProfile::uniform_candela;
    }
    const Renderer renderer = wall_lit_by(light, std::move(scene));
    constexpr int kSide = 100;
    const double half = kHalfTangent * kWallDistance;
    const LayeredImage image = render(renderer, square_on(half, 1), lux_settings(kSide, kSide));
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double wx = ((2 * x + 1.0) / kSide - 1) * half;
        const double wy = ((2 * y + 1.0) / kSide - 1) * half;
        const double cosine = kWallDistance / std::sqrt(wx * wx + wy * wy + kWallDistance * kWallDistance);
        const double expected = 900 / (kWallDistance * kWallDistance) * cosine * cosine * cosine;
        // E = I cos / r² and r = d / cos.
        ASSERT_NEAR(at(image, "lux.Y", x, y), expected, 1e-5 * expected) << is_map;
      }
    }
  }
}

// Row 16: by default a projector is a flat field, equally bright all over the wall, and throws the lumens it is given.
TEST(Segal1992Spotlight, AProjectorsDefaultIsUniformIlluminance) {
  Light light = projector("projector", kHalfTangent, kHalfTangent);
  EXPECT_EQ(light.profile, BeamProfile::flat_field);
  light.intensity = 900;
  const double half = kHalfTangent * kWallDistance;
  const LayeredImage image = render(wall_lit_by(light), square_on(half, 1), lux_settings(64, 64));
  for (const float lux : values_of(image, "lux.Y")) ASSERT_NEAR(lux, 100, 1e-3);

  for (const BeamProfile profile : {BeamProfile::flat_field, BeamProfile::uniform_candela}) {
    light.profile = profile;
    light.lumens = 2000;
    EXPECT_NEAR(flux_on_wall(wall_lit_by(light), half), 2000, 20);
  }
}

// Row 18: a Gaussian map, attenuation and n·l off.
TEST(Segal1992Spotlight, AGaussianMapGivesAGaussianProfile) {
  constexpr double kSigma = 0.23;  // of the tangent
  Scene scene;
  const int map = add_linear_picture(scene, kMapSide, kMapSide, [](int x, int y) {
    const double tx = map_position(x) * kHalfTangent;
    const double ty = map_position(y) * kHalfTangent;
    return glm::vec3(static_cast<float>(std::exp(-(tx * tx + ty * ty) / (2 * kSigma * kSigma))));
  });
  Light light = projector("spot", kHalfTangent, kHalfTangent, map);
  light.slide_is_intensity = true;
  light.attenuation = Attenuation::none;
  const Renderer renderer = wall_lit_by(light, std::move(scene));
  constexpr int kSide = 301;
  const double half = kHalfTangent * kWallDistance;
  const LayeredImage image = render(renderer, square_on(half, 1), papers_settings(kSide, kSide));

  // Fit: ln E is a parabola in x, −x² / 2σ². Least squares over the profile, weighted by E² as for errors of E itself.
  std::vector<double> measured;
  double numerator = 0;
  double denominator = 0;
  for (int x = 0; x < kSide; ++x) {
    const double t = ((2 * x + 1.0) / kSide - 1) * kHalfTangent;
    measured.push_back(at(image, "R", x, kSide / 2));
    const double weight = measured.back() * measured.back();
    numerator += weight * -2 * std::log(measured.back()) * t * t;
    denominator += weight * t * t * t * t;
  }
  const double sigma = std::sqrt(denominator / numerator);
  EXPECT_NEAR(sigma, kSigma, 0.005 * kSigma);
  std::vector<double> model;
  for (int x = 0; x < kSide; ++x) {
    const double t = ((2 * x + 1.0) / kSide - 1) * kHalfTangent;
    model.push_back(std::exp(-t * t / (2 * kSigma * kSigma)));
  }
  EXPECT_GT(r_squared(measured, model), 0.999);
}

// Illuminance in the middle of a wall square to the light at a distance along its axis.
double lux_at(const Light& light, double distance) {
  Scene scene;
  add_object(scene, "wall", wall(3, 3, 0));
  add_light(scene, light, {0, 0, distance}, {0, 0, 0});
  return at(render(make_renderer(std::move(scene)), square_on(0.5, 1), lux_settings(9, 9)), "lux.Y", 4, 4);
}

// Row 19: distance attenuation, built in and as the user's function of z^t.
TEST(Segal1992Spotlight, LightFadesWithDistanceAsChosen) {
  for (const LightType type : {LightType::projector, LightType::spot, LightType::point}) {
    Light light = projector("light", 0.5, 0.5);
    light.type = type;
    light.intensity = 100;
    EXPECT_NEAR(lux_at(light, 4) / lux_at(light, 2), 0.25, 1e-6);
    EXPECT_NEAR(lux_at(light, 2), 25, 1e-4);
    light.attenuation = Attenuation::none;
    EXPECT_NEAR(lux_at(light, 2), 100, 1e-4);
    EXPECT_NEAR(lux_at(light, 4), 100, 1e-4);
    light.range = 10;
    light.attenuation = Attenuation::linear;
    EXPECT_NEAR(lux_at(light, 2), 80, 1e-3);
    EXPECT_NEAR(lux_at(light, 4), 60, 1e-3);
    light.attenuation = Attenuation::gltf_windowed;  // KHR_lights_punctual
    EXPECT_NEAR(lux_at(light, 2), 25 * (1 - 0.0016), 1e-3);
    EXPECT_NEAR(lux_at(light, 8), 100 / 64.0 * (1 - 0.4096), 1e-4);
    light.attenuation = Attenuation::custom;
    light.custom_attenuation = [](float z) { return 1 / (1 + z); };
    EXPECT_NEAR(lux_at(light, 4), 20, 1e-3);
  }
}

// Row 19: the user's function is asked with z^t, the distance along the axis; inverse-square is of the true distance.
TEST(Segal1992Spotlight, TheHookSeesDepthAlongTheAxisAndInverseSquareTheTrueDistance) {
  Light light = projector("light", 1, 1);
  light.profile = BeamProfile::uniform_candela;
  light.intensity = 1;
  const auto lux_off_axis = [&] {
    Scene scene;
    add_object(scene, "wall", wall(5, 5, 0));
    add_light(scene, light, {0, 0, 2}, {0, 0, 0});
    const View camera = square_on(0.01, 1, {1.5, 0});  // 1.5 m beside the axis: 2.5 m from the light
    return at(render(make_renderer(std::move(scene)), camera, lux_settings(3, 3)), "lux.Y", 1, 1);
  };
  EXPECT_NEAR(lux_off_axis(), 0.8 / (2.5 * 2.5), 1e-6);
  light.attenuation = Attenuation::custom;
  light.custom_attenuation = [](float z) { return z; };
  EXPECT_NEAR(lux_off_axis(), 0.8 * 2, 1e-6);
}

}  // namespace
}  // namespace laterna
