// Small scenes for tests, built in code.
#pragma once

#include <string>
#include <vector>

#include "frame/frame.h"
#include "laterna/render.h"
#include "laterna/scene.h"

namespace laterna::reference {

/// Triangles of any shape.
struct Mesher {
  Primitive primitive;

  void triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c);
  /// Corners counter-clockwise seen from the front; uv runs from (0, 1) at the first corner to (1, 0) at the third.
  void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d);
};

/// A box with flat faces.
Primitive box(glm::vec3 centre, glm::vec3 half_extent);
/// Smooth normals.
Primitive sphere(glm::vec3 centre, float radius, int segments);
/// Around +Y.
Primitive torus(glm::vec3 centre, float radius, float tube, int segments);
/// In the plane y = height, front up.
Primitive floor(float half_side, float height = 0);
/// Square-on to +Z at z, front toward +Z.
Primitive wall(float half_width, float half_height, float z);

/// Adds one material and one node with the primitive; returns the node.
int add_object(Scene& scene, const std::string& name, Primitive primitive, glm::vec3 color = glm::vec3(1));
/// Shines all round, of so many candela.
Light bulb(const std::string& name, double candela);
/// Adds a light or camera looking from `position` to `target`; returns the node.
int add_light(Scene& scene, Light light, glm::dvec3 position, glm::dvec3 target, glm::dvec3 up = {0, 1, 0});
/// A picture of 8-bit RGB from a function of (x, y).
int add_picture(Scene& scene, int width, int height, const std::function<glm::u8vec3(int, int)>& pixel);

View look(glm::dvec3 position, glm::dvec3 target, double yfov_deg, double aspect, glm::dvec3 up = {0, 1, 0},
          double near = 0.05, double far = 1000);

/// Throws std::runtime_error with the diagnostics on failure.
Renderer make_renderer(Scene scene, int threads = 0, std::optional<InstructionSet> set = {});
LayeredImage render(const Renderer& renderer, const View& view, const RenderSettings& settings);
/// Settings for small test pictures: phong without highlights, no anisotropy.
RenderSettings test_settings(int width, int height);

/// A frame of its own, with the scene kept alive.
struct OwnedFrame {
  std::unique_ptr<Scene> scene;
  frame::Frame frame;
};
OwnedFrame make_frame(Scene scene);

/// Value of a channel at a pixel.
float at(const LayeredImage& image, const std::string& channel, int x, int y);

}  // namespace laterna::reference
