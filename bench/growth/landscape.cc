#include "landscape.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "reference/projector_scenes.h"
#include "reference/shapes.h"

namespace laterna::growth {
namespace {

constexpr double kHalfSide = 10;  // metres

double height_at(double x, double z) {
  return 0.6 * std::sin(1.1 * x) * std::cos(0.9 * z) + 0.15 * std::sin(3.7 * x + 1.3 * z);
}

glm::vec3 normal_at(double x, double z) {
  constexpr double kStep = 1e-3;
  const double dx = (height_at(x + kStep, z) - height_at(x - kStep, z)) / (2 * kStep);
  const double dz = (height_at(x, z + kStep) - height_at(x, z - kStep)) / (2 * kStep);
  return glm::normalize(glm::vec3(-dx, 1, -dz));
}

// A grid of quads, two triangles each.
Primitive hills(int triangles) {
  const auto quads = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 2.0)));
  Primitive p;
  for (std::uint32_t row = 0; row <= quads; ++row) {
    for (std::uint32_t column = 0; column <= quads; ++column) {
      const double u = static_cast<double>(column) / quads;
      const double v = static_cast<double>(row) / quads;
      const double x = (2 * u - 1) * kHalfSide;
      const double z = (2 * v - 1) * kHalfSide;
      p.positions.emplace_back(x, height_at(x, z), z);
      p.normals.push_back(normal_at(x, z));
      p.uv[0].emplace_back(8 * u, 8 * v);
    }
  }
  const std::uint32_t stride = quads + 1;
  p.indices.reserve(std::size_t{6} * quads * quads);
  for (std::uint32_t row = 0; row < quads; ++row) {
    for (std::uint32_t column = 0; column < quads; ++column) {
      const std::uint32_t a = row * stride + column;
      for (const std::uint32_t i : {a, a + stride, a + 1, a + 1, a + stride, a + stride + 1}) {
        p.indices.push_back(i);
      }
    }
  }
  return p;
}

int add_checks(Scene& scene) {
  return reference::add_picture(scene, 512, 512, [](int x, int y) {
    return (x / 32 + y / 32) % 2 == 0 ? glm::u8vec3(220, 180, 90) : glm::u8vec3(30, 60, 110);
  });
}

void add_projectors(Scene& scene, const Landscape& landscape, int slide) {
  for (int i = 0; i < landscape.lights; ++i) {
    const double turn = 2 * std::numbers::pi * i / landscape.lights;
    Light light = reference::projector("projector " + std::to_string(i), 1, 1, slide);
    light.intensity = 100.0 / landscape.lights;
    light.shadow.resolution = landscape.map_size;
    reference::add_light(scene, light, {9 * std::cos(turn), 7, 9 * std::sin(turn)}, {0, 0, 0});
  }
}

}  // namespace

Scene make_scene(const Landscape& landscape) {
  Scene scene;
  reference::add_object(scene, "hills", hills(landscape.triangles));
  const int picture = add_checks(scene);
  scene.materials[0].base_color_texture.picture = picture;
  scene.ambient = glm::vec3(0.05F);
  scene.ambient_is_set = true;
  add_projectors(scene, landscape, picture);
  return scene;
}

View make_view(double aspect) { return reference::look({0, 6, 8.5}, {0, -0.3, 0}, 40, aspect); }

}  // namespace laterna::growth
