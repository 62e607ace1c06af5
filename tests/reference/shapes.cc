#include "reference/shapes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_precision.hpp>
#include <stdexcept>

namespace laterna::reference {
namespace {

constexpr float kTwoPi = 6.28318530718F;

}  // namespace

void Mesher::triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  const auto base = static_cast<std::uint32_t>(primitive.positions.size());
  const glm::vec3 n = glm::cross(b - a, c - a);
  for (const glm::vec3 v : {a, b, c}) {
    primitive.positions.push_back(v);
    primitive.normals.push_back(glm::length(n) > 0 ? n / glm::length(n) : glm::vec3(0, 1, 0));
    primitive.uv[0].emplace_back(0, 0);
  }
  for (std::uint32_t i = 0; i < 3; ++i) primitive.indices.push_back(base + i);
}

void Mesher::quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
  const auto base = static_cast<std::uint32_t>(primitive.positions.size());
  const glm::vec3 n = glm::normalize(glm::cross(b - a, c - a));
  for (const glm::vec3 v : {a, b, c, d}) {
    primitive.positions.push_back(v);
    primitive.normals.push_back(n);
  }
  for (const glm::vec2 uv : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)}) {
    primitive.uv[0].push_back(uv);
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) primitive.indices.push_back(base + i);
}

Primitive box(glm::vec3 c, glm::vec3 h) {
  Mesher m;
  const auto p = [&](float x, float y, float z) { return c + glm::vec3(x, y, z) * h; };
  m.quad(p(-1, -1, 1), p(1, -1, 1), p(1, 1, 1), p(-1, 1, 1));
  m.quad(p(1, -1, -1), p(-1, -1, -1), p(-1, 1, -1), p(1, 1, -1));
  m.quad(p(1, -1, 1), p(1, -1, -1), p(1, 1, -1), p(1, 1, 1));
  m.quad(p(-1, -1, -1), p(-1, -1, 1), p(-1, 1, 1), p(-1, 1, -1));
  m.quad(p(-1, 1, 1), p(1, 1, 1), p(1, 1, -1), p(-1, 1, -1));
  m.quad(p(-1, -1, -1), p(1, -1, -1), p(1, -1, 1), p(-1, -1, 1));
  return m.primitive;
}

Primitive torus(glm::vec3 centre, float radius, float tube, int segments) {
  Primitive p;
  const int across = segments / 2;
  for (int i = 0; i <= segments; ++i) {
    for (int j = 0; j <= across; ++j) {
      const float u = kTwoPi * static_cast<float>(i) / static_cast<float>(segments);
      const float v = kTwoPi * static_cast<float>(j) / static_cast<float>(across);
      const glm::vec3 outward(std::cos(u), 0, std::sin(u));
      const glm::vec3 n = outward * std::cos(v) + glm::vec3(0, std::sin(v), 0);
      p.positions.push_back(centre + outward * radius + n * tube);
      p.normals.push_back(n);
      p.uv[0].emplace_back(static_cast<float>(i) / static_cast<float>(segments),
                           static_cast<float>(j) / static_cast<float>(across));
    }
  }
  const auto row = static_cast<std::uint32_t>(across + 1);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(segments); ++i) {
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t a = i * row + j;
      for (const std::uint32_t k : {a, a + 1, a + row + 1, a, a + row + 1, a + row}) p.indices.push_back(k);
    }
  }
  return p;
}

Primitive sphere(glm::vec3 centre, float radius, int segments) {
  Primitive p;
  const int rings = segments / 2;
  for (int i = 0; i <= segments; ++i) {
    for (int j = 0; j <= rings; ++j) {
      const float u = kTwoPi * static_cast<float>(i) / static_cast<float>(segments);
      const float v = kTwoPi / 2 * static_cast<float>(j) / static_cast<float>(rings);
      const glm::vec3 n(std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u));
      p.positions.push_back(centre + n * radius);
      p.normals.push_back(n);
      p.uv[0].emplace_back(static_cast<float>(i) / static_cast<float>(segments),
                           static_cast<float>(j) / static_cast<float>(rings));
    }
  }
  const auto row = static_cast<std::uint32_t>(rings + 1);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(segments); ++i) {
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t a = i * row + j;
      if (j > 0) p.indices.insert(p.indices.end(), {a, a + row, a + 1});
      if (j + 2 < row) p.indices.insert(p.indices.end(), {a + 1, a + row, a + row + 1});
    }
  }
  // At the poles a quad is one triangle.
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(segments); ++i) {
    const std::uint32_t a = i * row;
    p.indices.insert(p.indices.end(), {a, a + row + 1, a + 1});
  }
  return p;
}

Primitive floor(float half_side, float height) {
  Mesher m;
  const float s = half_side;
  m.quad({-s, height, s}, {s, height, s}, {s, height, -s}, {-s, height, -s});
  return m.primitive;
}

Primitive wall(float w, float h, float z) {
  Mesher m;
  m.quad({-w, -h, z}, {w, -h, z}, {w, h, z}, {-w, h, z});
  return m.primitive;
}

int add_object(Scene& scene, const std::string& name, Primitive primitive, glm::vec3 color) {
  Material material;
  material.name = name;
  material.base_color = glm::vec4(color, 1);
  material.metallic = 0;
  material.roughness = 1;
  scene.materials.push_back(material);
  primitive.material = static_cast<int>(scene.materials.size()) - 1;
  scene.meshes.push_back({name, {std::move(primitive)}});
  Node node;
  node.name = name;
  node.mesh = static_cast<int>(scene.meshes.size()) - 1;
  scene.nodes.push_back(node);
  return static_cast<int>(scene.nodes.size()) - 1;
}

Light bulb(const std::string& name, double candela) {
  Light light;
  light.name = name;
  light.intensity = candela;
  return light;
}

int add_light(Scene& scene, Light light, glm::dvec3 position, glm::dvec3 target, glm::dvec3 up) {
  if (light.name.empty()) light.name = "light " + std::to_string(scene.lights.size() + 1);
  Node node;
  node.name = light.name;
  node.light = static_cast<int>(scene.lights.size());
  node.parent_from_node = Pose::look_at(position, target, up).value().world_from_view();
  scene.lights.push_back(std::move(light));
  scene.nodes.push_back(node);
  return static_cast<int>(scene.nodes.size()) - 1;
}

int add_picture(Scene& scene, int width, int height, const std::function<glm::u8vec3(int, int)>& pixel) {
  auto image = std::make_shared<Image>(width, height, 3, PixelType::u8, Transfer::srgb);
  const std::span<std::uint8_t> values = image->values<std::uint8_t>();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::u8vec3 c = pixel(x, y);
      const auto i = static_cast<std::size_t>((y * width + x) * 3);
      values[i] = c.r, values[i + 1] = c.g, values[i + 2] = c.b;
    }
  }
  Picture picture;
  picture.name = "picture " + std::to_string(scene.pictures.size());
  picture.pixels = std::move(image);
  scene.pictures.push_back(std::move(picture));
  return static_cast<int>(scene.pictures.size()) - 1;
}

View look(glm::dvec3 position, glm::dvec3 target, double yfov_deg, double aspect, glm::dvec3 up, double near,
          double far) {
  return {Pose::look_at(position, target, up).value(),
          Projection::perspective(Angle::degrees(yfov_deg), aspect, near, far)};
}

Renderer make_renderer(Scene scene, int threads, std::optional<InstructionSet> set) {
  Result<Renderer> renderer = Renderer::create(std::move(scene), {threads, set});
  if (!renderer) throw std::runtime_error(to_string(renderer.error()));
  return std::move(*renderer);
}

LayeredImage render(const Renderer& renderer, const View& view, const RenderSettings& settings) {
  Result<LayeredImage> image = renderer.render(view, settings);
  if (!image) throw std::runtime_error(to_string(image.error()));
  return std::move(*image);
}

RenderSettings test_settings(int width, int height) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.shading = ShadingModel::phong;
  settings.anisotropy = 1;
  return settings;
}

OwnedFrame make_frame(Scene scene) {
  OwnedFrame owned;
  owned.scene = std::make_unique<Scene>(std::move(scene));
  const TaskPool pool(1);
  Result<frame::TextureLibrary> textures = frame::TextureLibrary::load(*owned.scene, pool);
  if (!textures) throw std::runtime_error(to_string(textures.error()));
  auto shared = std::make_shared<const frame::TextureLibrary>(std::move(*textures));
  Result<frame::Frame> frame =
      frame::Frame::build(*owned.scene, shared, frame::build_clusters(*owned.scene, pool), pool);
  if (!frame) throw std::runtime_error(to_string(frame.error()));
  owned.frame = std::move(*frame);
  return owned;
}

float at(const LayeredImage& image, const std::string& channel, int x, int y) {
  const Channel* found = image.find(channel);
  if (found == nullptr) throw std::runtime_error("no channel " + channel);
  return found->values[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                       static_cast<std::size_t>(x)];
}

}  // namespace laterna::reference
