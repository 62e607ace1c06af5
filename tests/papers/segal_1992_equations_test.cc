// Segal, Korobkin, van Widenfelt, Foran and Haeberli, Fast shadows and lighting effects using texture mapping, 1992:
// section 2, the iteration of texture coordinates.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "laterna/measure.h"
#include "raster/raster_view.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/segal_equations.h"
#include "shade/illumination.h"

namespace laterna {
namespace {

using namespace reference;

// Row 2: w = 1 → 4 and s = 0 → 1; halfway on the screen s is 0.2, not 0.5.
TEST(Segal1992Equations, HalfwayOnTheScreenIsAFifthOfTheSpan) {
  constexpr SpanEnd kNear = {1, 0};
  constexpr SpanEnd kFar = {4, 1};
  EXPECT_NEAR(value_on_span(kNear, kFar, 0.5), 0.2, 1e-6);

  // The renderer, on a sheet whose lower edge is at w = 1 and y/w = −0.5, its upper edge at w = 4 and y/w = 0.5.
  Scene scene;
  Mesher mesh;
  mesh.quad({-0.5F, -0.5F, -1}, {0.5F, -0.5F, -1}, {2, 2, -4}, {-2, 2, -4});
  mesh.primitive.colors = {{0, 0, 0, 1}, {0, 0, 0, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}};
  add_object(scene, "sheet", mesh.primitive);
  const Renderer renderer = make_renderer(std::move(scene));
  RenderSettings settings = test_settings(33, 33);
  settings.layers = {Layer::albedo};
  const LayeredImage image =
      render(renderer, look({0, 0, 0}, {0, 0, -1}, 2 * 26.565051177077990, 1), settings);
  EXPECT_NEAR(at(image, "albedo.R", 16, 16), 0.2, 1e-6);
  for (int y = 0; y < 33; ++y) {
    const double share = 1 - (y + 0.5) / 33;
    EXPECT_NEAR(at(image, "albedo.R", 16, y), value_on_span(kNear, kFar, share), 1e-6) << "row " << y;
  }
}

// What one pixel of a triangle is in space: the pixel's ray against the triangle's plane, in double precision.
glm::dvec3 point_at_pixel(const View& camera, int width, int height, int x, int y,
                          const Primitive& triangle) {
  const raster::RasterView view(camera, width, height);
  const glm::dvec3 direction = view.direction_0 + view.direction_x * (x - view.origin_x + 0.5) +
                               view.direction_y * (y - view.origin_y + 0.5);
  const glm::dvec3 a(triangle.positions[0]);
  const glm::dvec3 n =
      glm::cross(glm::dvec3(triangle.positions[1]) - a, glm::dvec3(triangle.positions[2]) - a);
  return view.eye_ws + direction * (glm::dot(n, a - view.eye_ws) / glm::dot(n, direction));
}

// Row 3: x^l/w, y^l/w and w^l/w interpolated, then divided, is M_l · world at every pixel.
TEST(Segal1992Equations, ProjectedCoordinatesAreWhatTheMatrixGivesAtEveryPixel) {
  std::mt19937 random(31);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  const auto point_within = [&](double reach) {
    return glm::dvec3(uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach));
  };
  constexpr int kSide = 24;
  RenderSettings settings = papers_settings(kSide, kSide);
  settings.shadows = ShadowTechnique::none;
  settings.layers = {Layer::uv, Layer::object};
  std::size_t compared = 0;
  double worst = 0;
  int pairs = 0;
  while (pairs < 1000) {
    Scene scene;
    Mesher mesh;
    mesh.triangle(point_within(3), point_within(3), point_within(3));
    const Primitive triangle = mesh.primitive;
    add_object(scene, "triangle", triangle);
    scene.materials[0].double_sided = true;
    const double half_width = uniform(0.2, 1.5);
    const double half_height = uniform(0.2, 1.5);
    add_light(scene, projector("lantern", half_width, half_height), glm::dvec3(0, 0, 9) + point_within(3),
              point_within(2));
    const View camera = look(glm::dvec3(7, 0, 0) + point_within(2), point_within(1), uniform(30, 90), 1);
    const Renderer renderer = make_renderer(std::move(scene), 1);
    const LayeredImage image = render(renderer, camera, settings);
    const glm::dmat4 texture_from_world = renderer.light_view("lantern")->image_from_world();
    std::size_t here = 0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        if (at(image, "id.object", x, y) < 0) continue;
        const glm::dvec4 q =
            texture_from_world * glm::dvec4(point_at_pixel(camera, kSide, kSide, x, y, triangle), 1);
        const glm::dvec2 direct = glm::dvec2(q) / q.w;
        if (q.w <= 0.1 || direct.x < 1e-5 || direct.y < 1e-5 || direct.x > 1 - 1e-5 || direct.y > 1 - 1e-5)
          continue;
        const glm::dvec2 iterated(at(image, "uv.lantern.u", x, y), at(image, "uv.lantern.v", x, y));
        for (int k = 0; k < 2; ++k) {
          const double error = std::abs(iterated[k] - direct[k]) / std::max(1.0, std::abs(direct[k]));
          ASSERT_FALSE(std::isnan(error)) << "pair " << pairs << " pixel " << x << ", " << y;
          worst = std::max(worst, error);
        }
        ++here;
      }
    }
    if (here == 0) continue;  // the camera or the projector missed it: another
    compared += here;
    ++pairs;
  }
  EXPECT_LT(worst, 1e-5);
  EXPECT_GT(compared, 10000U);
}

// Row 4: with an orthographic projector w^l is 1 everywhere, and the general path (equation 7) gives the bits of the
// ordinary one (equation 8).
TEST(Segal1992Equations, AnOrthographicProjectorIsOrdinaryTexturingBitForBit) {
  Scene scene;
  add_object(scene, "wall", wall(5, 5, 0));
  Light light =
      projector("lantern", 1, 1, add_linear_picture(scene, 2, 2, [](int, int) { return glm::vec3(1); }));
  light.projection = Projection::orthographic(2, 1.5, 0.1, 40);
  light.outside = Outside::repeat;  // coordinates everywhere
  add_light(scene, light, {3, 2, 8}, {0.3, -0.4, 0});
  const OwnedFrame owned = make_frame(std::move(scene));
  const raster::RasterView camera(look({-4, 1, 6}, {0, 0, 0}, 50, 1), 256, 256);

  const shade::BoundLight equation_8(owned.frame.lights[0], camera.homogeneous_ray(), ShadingModel::papers,
                                     1);
  ASSERT_TRUE(equation_8.is_orthographic);
  shade::BoundLight equation_7 = equation_8;
  equation_7.is_orthographic = false;  // divides by w^l/w, not by 1/w

  auto samples = std::make_unique<shadow::SurfaceSamples>();
  auto points = std::make_unique<shade::SurfacePoints>();
  samples->ray = camera.homogeneous_ray();
  samples->group_count = shadow::kMaxGroups;
  samples->active.fill(0xFFFF);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> pixel(-128, 128);
  std::uniform_real_distribution<float> reversed_depth(0.02F, 2);
  for (std::size_t i = 0; i < shadow::kMaxSamples; ++i) {
    samples->x[i] = pixel(random);
    samples->y[i] = pixel(random);
    samples->q[i] = reversed_depth(random);
  }
  for (const InstructionSet set : supported_instruction_sets()) {
    auto by_7 = std::make_unique<shade::Irradiance>();
    auto by_8 = std::make_unique<shade::Irradiance>();
    shade::find_irradiance_for(set)(equation_7, *samples, *points, nullptr, *by_7);
    shade::find_irradiance_for(set)(equation_8, *samples, *points, nullptr, *by_8);
    for (std::size_t i = 0; i < shadow::kMaxSamples; ++i) {
      ASSERT_FALSE(std::isnan(by_8->slide_s[i])) << name_of(set);
      EXPECT_EQ(std::bit_cast<std::uint32_t>(by_7->slide_s[i]),
                std::bit_cast<std::uint32_t>(by_8->slide_s[i]));
      EXPECT_EQ(std::bit_cast<std::uint32_t>(by_7->slide_t[i]),
                std::bit_cast<std::uint32_t>(by_8->slide_t[i]));
    }
  }
}

// Row 5: world, clip, screen, light and texture coordinates, with the matrices M_c and M_l.
TEST(Segal1992Equations, APointIsReportedInEveryCoordinateSystem) {
  Scene scene;
  add_object(scene, "wall", wall(5, 5, 0));
  add_light(scene, projector("lantern", 0.5, 0.25), {0, 0, 4}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  const View camera = look({0, 0, 10}, {0, 0, 0}, 90, 2, {0, 1, 0}, 1, 100);

  // By hand: the camera sees a half width of 20 m and a half height of 10 m at the wall; the slide is 4 m × 2 m there.
  const PointReport p = *inspect_point(renderer, camera, 200, 100, "lantern", {1, 0.5, 0});
  EXPECT_NEAR(p.clip.w, 10, 1e-12);
  EXPECT_NEAR(p.screen.x, 0.05, 1e-12);
  EXPECT_NEAR(p.screen.y, 0.05, 1e-12);
  EXPECT_NEAR(p.pixel.x, 105, 1e-9);
  EXPECT_NEAR(p.pixel.y, 47.5, 1e-9);
  EXPECT_NEAR(p.light.w, 4, 1e-12);
  EXPECT_NEAR(p.light.x / p.light.w, 0.5, 1e-12);
  EXPECT_NEAR(p.light.y / p.light.w, 0.5, 1e-12);
  EXPECT_NEAR(p.texture.x, 0.75, 1e-12);
  EXPECT_NEAR(p.texture.y, 0.25, 1e-12);
  EXPECT_NEAR(p.distance, 4, 1e-12);
  EXPECT_TRUE(p.is_ahead);
  EXPECT_TRUE(p.is_inside);

  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-3, 3);
  const auto back = [](const glm::dmat4& matrix, const glm::dvec4& q) {
    const glm::dvec4 world = glm::inverse(matrix) * q;
    return glm::dvec3(world) / world.w;
  };
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 world(coordinate(random), coordinate(random), coordinate(random));
    const PointReport r = *inspect_point(renderer, camera, 200, 100, "lantern", world);
    EXPECT_LT(glm::distance(back(r.clip_from_world, r.clip), world), 1e-6);
    EXPECT_LT(glm::distance(back(r.light_from_world, r.light), world), 1e-6);
    EXPECT_LT(glm::distance(back(r.texture_from_world, {r.texture, 1}), world), 1e-6);
  }
}

struct EdgePoint {
  glm::dvec2 pixel;
  double x_ws, z_ws;        // where on the floor
  double pixels_per_metre;  // along x
};

// The edge between the black and the white half of a slide thrown down on a floor of two triangles: the line x = 1.
std::vector<EdgePoint> edge_on_floor(const Renderer& renderer, glm::dvec3 eye, Interpolation interpolation) {
  RenderSettings settings = papers_settings(480, 360);
  settings.shadows = ShadowTechnique::none;
  settings.interpolation = interpolation;
  settings.layers = {Layer::position, Layer::object};
  const LayeredImage image = render(renderer, look(eye, {0, 0, 0}, 40, 4.0 / 3), settings);
  std::vector<EdgePoint> edge;
  for (int y = 0; y < image.height; ++y) {
    for (const double x : crossings(row_of(image, "R", y), 0.5)) {
      const int left = static_cast<int>(std::floor(x - 0.5));
      if (at(image, "id.object", left, y) < 0 || at(image, "id.object", left + 1, y) < 0)
        continue;  // the floor's rim
      const double share = x - 0.5 - left;
      const double a = at(image, "P.X", left, y);
      const double b = at(image, "P.X", left + 1, y);
      edge.push_back({{x, y + 0.5}, a + (b - a) * share, at(image, "P.Z", left, y), 1 / (b - a)});
    }
  }
  return edge;
}

Renderer half_black_slide_on_floor() {
  Scene scene;
  add_object(scene, "floor", floor(4));
  const int slide = add_linear_picture(scene, 64, 64, [](int x, int) { return glm::vec3(x < 32 ? 0 : 1); });
  add_light(scene, projector("lantern", 0.8, 0.8, slide), {1, 8, 0}, {1, 0, 0}, {0, 0, -1});
  return make_renderer(std::move(scene));
}

// Row 6: interpolating linearly in the picture breaks straight lines where triangles meet.
TEST(Segal1992Equations, AffineIterationBendsStraightLinesAtTheDiagonal) {
  const Renderer renderer = half_black_slide_on_floor();
  const auto pixels = [](const std::vector<EdgePoint>& edge, int side) {  // of the diagonal x = −z; 0: both
    std::vector<glm::dvec2> points;
    for (const EdgePoint& p : edge) {
      if (side == 0 || (p.x_ws + p.z_ws) * side > 0.1) points.push_back(p.pixel);
    }
    return points;
  };
  const std::vector<EdgePoint> correct = edge_on_floor(renderer, {0, 4, 10}, Interpolation::perspective);
  ASSERT_GT(correct.size(), 100U);
  EXPECT_LT(line_fit_residual(pixels(correct, 0)), 0.5);

  const std::vector<EdgePoint> affine = edge_on_floor(renderer, {0, 4, 10}, Interpolation::affine);
  ASSERT_GT(affine.size(), 100U);
  EXPECT_GT(line_fit_residual(pixels(affine, 0)), 5);
  EXPECT_LT(line_fit_residual(pixels(affine, 1)), 0.5);
  EXPECT_LT(line_fit_residual(pixels(affine, -1)), 0.5);
}

// Row 6: and the picture swims over the surface when the camera moves.
TEST(Segal1992Equations, OnlyAffineIterationSwims) {
  const Renderer renderer = half_black_slide_on_floor();
  // How far the line has moved on the floor between two frames, in pixels, at most.
  const auto swim = [&](Interpolation interpolation) {
    const std::vector<EdgePoint> first = edge_on_floor(renderer, {0, 4, 10}, interpolation);
    const std::vector<EdgePoint> second = edge_on_floor(renderer, {1, 4, 10}, interpolation);
    double most = 0;
    for (const EdgePoint& p : first) {
      const EdgePoint* same = nullptr;  // the point of the second frame at the same depth of the floor
      for (const EdgePoint& q : second) {
        if (same == nullptr || std::abs(q.z_ws - p.z_ws) < std::abs(same->z_ws - p.z_ws)) same = &q;
      }
      if (same == nullptr || std::abs(same->z_ws - p.z_ws) > 0.05) continue;
      most = std::max(most, std::abs(same->x_ws - p.x_ws) * p.pixels_per_metre);
    }
    return most;
  };
  EXPECT_LT(swim(Interpolation::perspective), 0.5);
  EXPECT_GT(swim(Interpolation::affine), 2);
}

}  // namespace
}  // namespace laterna
