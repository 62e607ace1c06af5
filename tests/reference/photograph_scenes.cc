#include "reference/photograph_scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"

namespace laterna::reference {

Scene facade() {
  Scene scene;
  add_object(scene, "wall", wall(4, 3, 0));
  add_object(scene, "left balcony", box({-2, -0.5F, 0.4F}, {0.8F, 0.1F, 0.4F}));
  add_object(scene, "right balcony", box({1.7F, 0.6F, 0.4F}, {0.8F, 0.1F, 0.4F}));
  add_object(scene, "pillar", box({0, -1, 1.2F}, {0.15F, 2, 0.15F}));
  add_object(scene, "wing", box({3.4F, -1, 1}, {0.5F, 2, 1}));
  return scene;
}

View photograph_view(glm::dvec3 position, glm::dvec3 target, double focal_pixels, glm::dvec2 principal,
                     int width, int height) {
  return {Pose::look_at(position, target, {0, 1, 0}).value(),
          Projection::from_intrinsics(focal_pixels, focal_pixels, principal.x, principal.y, width, height,
                                      0.01, 1000)};
}

glm::dvec2 on_facade(const View& view, int width, int height, glm::dvec2 pixel) {
  const Projection& p = view.projection;
  const double x = p.left + (p.right - p.left) * pixel.x / width;
  const double y = p.top - (p.top - p.bottom) * pixel.y / height;
  const glm::dvec3 direction = view.pose.forward_ws() + x * view.pose.right_ws() + y * view.pose.up_ws();
  const glm::dvec3 eye = view.pose.position_ws;
  const glm::dvec3 point = eye - direction * (eye.z / direction.z);
  return {point.x, point.y};
}

glm::dvec2 in_picture(const View& view, int width, int height, glm::dvec3 point_ws) {
  const glm::dvec3 away = point_ws - view.pose.position_ws;
  const double z = glm::dot(away, view.pose.forward_ws());
  const Projection& p = view.projection;
  const double x = glm::dot(away, view.pose.right_ws()) / z, y = glm::dot(away, view.pose.up_ws()) / z;
  return {(x - p.left) / (p.right - p.left) * width, (p.top - y) / (p.top - p.bottom) * height};
}

void add_photograph(Scene& scene, const std::string& name, const View& view, int width, int height,
                    const std::function<glm::vec3(int, int)>& linear_color, bool as_codes) {
  auto image = as_codes ? std::make_shared<Image>(width, height, 3, PixelType::u8, Transfer::srgb)
                        : std::make_shared<Image>(width, height, 3, PixelType::f32, Transfer::linear);
  std::size_t at = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::vec3 color = linear_color(x, y);
      for (int c = 0; c < 3; ++c, ++at) {
        if (as_codes) {
          image->values<std::uint8_t>()[at] = static_cast<std::uint8_t>(code_of(color[c]));
        } else {
          image->values<float>()[at] = color[c];
        }
      }
    }
  }
  Picture picture;
  picture.name = name;
  picture.pixels = std::move(image);
  scene.pictures.push_back(std::move(picture));
  Photograph photograph;
  photograph.name = name;
  photograph.picture = static_cast<int>(scene.pictures.size()) - 1;
  photograph.pose = view.pose;
  photograph.projection = view.projection;
  scene.photographs.push_back(std::move(photograph));
}

bool sees(const Scene& scene, const Photograph& photograph, glm::dvec3 point_ws, glm::dvec3 normal_ws) {
  const View view{photograph.pose, photograph.projection};
  const glm::dvec3 eye = view.pose.position_ws, way = eye - point_ws;
  if (glm::dot(normal_ws, way) <= 0 || glm::dot(way, view.pose.forward_ws()) >= 0) return false;
  const glm::dvec2 place = in_picture(view, 1, 1, point_ws);
  if (place.x < 0 || place.x > 1 || place.y < 0 || place.y > 1) return false;
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      const std::size_t corners =
          primitive.indices.empty() ? primitive.positions.size() : primitive.indices.size();
      for (std::size_t i = 0; i + 2 < corners; i += 3) {
        const auto corner = [&](std::size_t k) {
          return glm::dvec3(
              primitive.positions[primitive.indices.empty() ? i + k : primitive.indices[i + k]]);
        };
        // Möller and Trumbore, Fast, minimum storage ray/triangle intersection, 1997.
        const glm::dvec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
        const glm::dvec3 p = glm::cross(way, ac);
        const double determinant = glm::dot(ab, p);
        if (determinant == 0) continue;
        const glm::dvec3 from = point_ws - a;
        const double u = glm::dot(from, p) / determinant;
        const glm::dvec3 q = glm::cross(from, ab);
        const double v = glm::dot(way, q) / determinant, t = glm::dot(ac, q) / determinant;
        constexpr double kOwn = 1e-5;  // of the way: the surface that the point lies on
        if (u >= 0 && v >= 0 && u + v <= 1 && t > kOwn && t < 1) return false;
      }
    }
  }
  return true;
}

int code_of(float linear) {
  const double encoded = srgb_from_linear(std::clamp(static_cast<double>(linear), 0.0, 1.0));
  return static_cast<int>(std::floor(encoded * 255 + 0.5));
}

}  // namespace laterna::reference
