// Row 33: texture coordinates by eye-linear generation, as glTexGen made them, and by the renderer's own way.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/measure.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"

namespace laterna {
namespace {

using namespace reference;

// A room's corner with a ball, and a lantern that is neither square-on nor square.
Scene corner() {
  Scene scene;
  add_object(scene, "floor", floor(6));
  add_object(scene, "wall", wall(6, 4, -3));
  add_object(scene, "ball", sphere({0.4F, 0.8F, -1}, 0.8F, 24));
  add_light(scene, projector("lantern", 0.4, 0.27), {-2.2, 1.7, 2.4}, {0.2, 0.6, -1});
  return scene;
}

// The four planes, dotted with each pixel's position as the eye sees it, are what the renderer looked the slide up at.
TEST(EyeLinearPlanes, GiveTheDirectPathsTextureCoordinates) {
  const Renderer renderer = make_renderer(corner());
  const View light = renderer.light_view("lantern").value();
  RenderSettings settings = papers_settings(96, 72);
  settings.layers = {Layer::uv, Layer::position};
  for (const glm::dvec3& eye : {glm::dvec3(1.5, 2, 4), glm::dvec3(-3, 0.7, 1), glm::dvec3(0.3, 5, 0.1)}) {
    const View camera = look(eye, {0.1, 0.5, -1}, 55, 96.0 / 72);
    const EyeLinearPlanes planes = eye_linear_planes(camera, light);
    const LayeredImage image = render(renderer, camera, settings);
    const std::span<const float> u = values_of(image, "uv.lantern.u");
    const std::span<const float> v = values_of(image, "uv.lantern.v");
    const std::span<const float> x = values_of(image, "P.X");
    const std::span<const float> y = values_of(image, "P.Y");
    const std::span<const float> z = values_of(image, "P.Z");
    int compared = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      if (std::isnan(u[i])) continue;
      const glm::dvec4 position_es = camera.view_from_world() * glm::dvec4(x[i], y[i], z[i], 1);
      const glm::dvec3 texture = planes.texture_at(glm::dvec3(position_es));
      ASSERT_NEAR(texture.x, static_cast<double>(u[i]), 1e-5);
      ASSERT_NEAR(texture.y, static_cast<double>(v[i]), 1e-5);
      ++compared;
    }
    EXPECT_GT(compared, 500);
  }
}

// By hand: camera and lantern at one place are one view, and the planes are those of the frustum alone: of tangents
// 0.4 and 0.27, s = x / 0.8 + q / 2 and t = −y / 0.54 + q / 2 with q = −z.
TEST(EyeLinearPlanes, OfALanternAtTheEyeAreItsFrustum) {
  const Renderer renderer = make_renderer(corner());
  const View light = renderer.light_view("lantern").value();
  const EyeLinearPlanes planes = eye_linear_planes({light.pose, Projection()}, light);
  EXPECT_LT(glm::distance(planes.s, glm::dvec4(1 / 0.8, 0, -0.5, 0)), 1e-12);
  EXPECT_LT(glm::distance(planes.t, glm::dvec4(0, -1 / 0.54, -0.5, 0)), 1e-12);
  EXPECT_LT(glm::distance(planes.q, glm::dvec4(0, 0, -1, 0)), 1e-12);
}

// A sun's are affine: q is 1 everywhere. And a point's report holds the same planes.
TEST(EyeLinearPlanes, OfASunNeedNoDivision) {
  Scene scene = corner();
  Light sun;
  sun.name = "sun";
  sun.type = LightType::directional;
  add_light(scene, sun, {3, 5, 4}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  const View camera = look({1.5, 2, 4}, {0.1, 0.5, -1}, 55, 1);
  const EyeLinearPlanes planes = eye_linear_planes(camera, renderer.light_view("sun").value());
  EXPECT_LT(glm::distance(planes.q, glm::dvec4(0, 0, 0, 1)), 1e-12);
  const glm::dvec3 point_ws(0.3, 0.2, -0.7);
  const PointReport report = inspect_point(renderer, camera, 100, 100, "sun", point_ws).value();
  EXPECT_EQ(report.eye_linear.s, planes.s);
  EXPECT_EQ(report.eye_linear.r, planes.r);
  const glm::dvec3 position_es(camera.view_from_world() * glm::dvec4(point_ws, 1));
  EXPECT_LT(glm::distance(report.eye_linear.texture_at(position_es), report.texture), 1e-12);
}

}  // namespace
}  // namespace laterna
