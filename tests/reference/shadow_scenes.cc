#include "reference/shadow_scenes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace laterna::reference {

Light sun(const std::string& name) {
  Light light;
  light.name = name;
  light.type = LightType::directional;
  light.intensity = 3;
  return light;
}

Light spot(const std::string& name, double outer_cone_deg) {
  Light light;
  light.name = name;
  light.type = LightType::spot;
  light.intensity = 100;
  light.outer_cone = Angle::degrees(outer_cone_deg);
  return light;
}

ShadowScene sphere_over_plane(double aspect) {
  ShadowScene s;
  add_object(s.scene, "floor", floor(5));
  add_object(s.scene, "sphere", sphere({0, 1.5F, 0}, 1, 96));
  add_light(s.scene, sun("light"), {3, 6, 2}, {0, 0, 0});
  s.camera = look({-2, 4, 5}, {-0.7, 0.4, -0.4}, 45, aspect);
  return s;
}

ShadowScene torus_and_box(double aspect) {
  ShadowScene s;
  add_object(s.scene, "floor", floor(4));
  add_object(s.scene, "box", box({0.3F, 0.4F, 0.2F}, {0.5F, 0.4F, 0.6F}), {0.7F, 0.6F, 0.5F});
  const int ring = add_object(s.scene, "torus", torus({0, 0, 0}, 0.9F, 0.25F, 96), {0.5F, 0.6F, 0.8F});
  // Leaning against the box.
  const double tilt = Angle::degrees(35).in_radians();
  glm::dmat4 m(1.0);
  m[0] = {std::cos(tilt), std::sin(tilt), 0, 0};
  m[1] = {-std::sin(tilt), std::cos(tilt), 0, 0};
  m[3] = {-0.2, 1.2, 0, 1};
  s.scene.nodes[static_cast<std::size_t>(ring)].parent_from_node = m;
  add_light(s.scene, spot("light", 30), {2.5, 5, 1.5}, {0, 0.5, 0});
  s.camera = look({-2.5, 3, 4}, {0, 0.6, 0}, 42, aspect);
  return s;
}

int add_leaf_picture(Scene& scene, int side) {
  auto image = std::make_shared<Image>(side, side, 4, PixelType::u8, Transfer::srgb);
  const std::span<std::uint8_t> values = image->values<std::uint8_t>();
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double u = (2 * x + 1.0) / side - 1;
      const double v = (2 * y + 1.0) / side - 1;
      const double alpha = std::clamp((0.9 - std::sqrt(u * u + v * v)) * side / 4 + 0.5, 0.0, 1.0);
      const auto i = static_cast<std::size_t>((y * side + x) * 4);
      values[i] = 60, values[i + 1] = 140, values[i + 2] = 40;
      values[i + 3] = static_cast<std::uint8_t>(std::lround(255 * alpha));
    }
  }
  Picture picture;
  picture.name = "leaf";
  picture.pixels = std::move(image);
  scene.pictures.push_back(std::move(picture));
  return static_cast<int>(scene.pictures.size()) - 1;
}

ShadowScene poles_and_leaves(double aspect) {
  ShadowScene s;
  add_object(s.scene, "ground", floor(4));
  std::mt19937 random(2024);
  const auto uniform = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  Mesher poles;
  Mesher leaves;
  for (int i = 0; i < 40; ++i) {
    const glm::vec3 foot(uniform(-2.5F, 2.5F), 0, uniform(-2.5F, 2.5F));
    const float height = uniform(0.6F, 1.6F);
    const float radius = uniform(0.01F, 0.03F);
    constexpr int kSides = 8;
    for (int k = 0; k < kSides; ++k) {
      const auto corner = [&](int n, float y) {
        const float angle = 6.2831853F * static_cast<float>(n % kSides) / kSides;
        return foot + glm::vec3(radius * std::sin(angle), y, radius * std::cos(angle));
      };
      poles.quad(corner(k, 0), corner(k + 1, 0), corner(k + 1, height), corner(k, height));
    }
    for (int leaf = 0; leaf < 3; ++leaf) {
      const glm::vec3 centre =
          foot + glm::vec3(uniform(-0.2F, 0.2F), height + uniform(-0.2F, 0.1F), uniform(-0.2F, 0.2F));
      const glm::vec3 across =
          glm::normalize(glm::vec3(uniform(-1, 1), uniform(-0.3F, 0.3F), uniform(-1, 1)));
      const glm::vec3 along =
          glm::normalize(glm::cross(across, glm::vec3(uniform(-0.3F, 0.3F), 1, uniform(-0.3F, 0.3F))));
      const glm::vec3 u = across * 0.12F;
      const glm::vec3 v = along * 0.12F;
      leaves.quad(centre - u - v, centre + u - v, centre + u + v, centre - u + v);
    }
  }
  add_object(s.scene, "poles", poles.primitive, {0.4F, 0.3F, 0.2F});
  add_object(s.scene, "leaves", leaves.primitive);
  Material& leaf = s.scene.materials.back();
  leaf.alpha_mode = AlphaMode::mask;
  leaf.double_sided = true;
  leaf.base_color_texture.picture = add_leaf_picture(s.scene, 64);
  add_light(s.scene, sun("light"), {4, 4, 1.5}, {0, 0, 0});
  s.camera = look({-3, 3, 4}, {0, 0.2, 0}, 42, aspect);
  return s;
}

ShadowScene moulded_ledge(double aspect) {
  ShadowScene s;
  Mesher wall;
  wall.quad({-2, 0, 0}, {2, 0, 0}, {2, 3, 0}, {-2, 3, 0});
  add_object(s.scene, "wall", wall.primitive);
  // Half a cylinder lying on the wall, its ends closed.
  constexpr int kStrips = 90;
  constexpr float kRadius = 0.15F;
  Mesher ledge;
  const auto corner = [&](int k, float x) {
    const float angle = 3.1415927F * static_cast<float>(k) / kStrips;
    return glm::vec3(x, 2.2F + kRadius * std::cos(angle), kRadius * std::sin(angle));
  };
  for (int k = 0; k < kStrips; ++k) {
    ledge.quad(corner(k, -1.5F), corner(k + 1, -1.5F), corner(k + 1, 1.5F), corner(k, 1.5F));
    for (const float end : {-1.5F, 1.5F}) {
      const glm::vec3 middle(end, 2.2F, 0);
      if (end < 0) {
        ledge.triangle(middle, corner(k + 1, end), corner(k, end));
      } else {
        ledge.triangle(middle, corner(k, end), corner(k + 1, end));
      }
    }
  }
  add_object(s.scene, "ledge", ledge.primitive, {0.7F, 0.6F, 0.5F});
  Light light = sun("light");
  light.shadow.resolution = 512;
  add_light(s.scene, light, {0.9, 9, 0.8}, {0, 0, 0});
  s.camera = look({-1.2, 1.6, 3.6}, {-0.2, 1.6, 0}, 42, aspect);
  return s;
}

}  // namespace laterna::reference
