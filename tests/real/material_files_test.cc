// Files by others that use glTF's material extensions, drawn.
#include <gtest/gtest.h>

#include <filesystem>

#include "reference/shapes.h"

namespace laterna {
namespace {

using namespace reference;

// Khronos' ClearCoatTest, which Debian's assimp-testmodels brings: each row has a base layer, the same under a coat, and the
// coat alone. What is coated shows the coat, and of the base what the coat leaves: its Fresnel term is 0.04 square-on and
// 0.046 at 50°.
TEST(MaterialFiles, KhronosClearCoatTestAddsUp) {
  const std::filesystem::path file = "/usr/share/assimp/models/glTF2/ClearCoat-glTF/ClearCoatTest.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  Result<Scene> scene = load_scene({file});
  ASSERT_TRUE(scene.has_value()) << to_string(scene.error());
  EXPECT_TRUE(scene->warnings.empty());
  Light sun;
  sun.name = "sun";
  sun.type = LightType::directional;
  sun.intensity = 3;
  add_light(*scene, sun, {4, 6, 12}, {0, 0, 0});
  scene->ambient = glm::vec3(0);
  scene->ambient_is_set = true;
  // 100 pixels to a metre: columns are 2.1 m apart.
  constexpr int kWidth = 660, kHeight = 1280, kColumn = 210;
  View camera = look({0, 0, 30}, {0, 0, 0}, 40, 1);
  camera.projection = Projection::orthographic(kWidth / 200.0, kHeight / 200.0, 0.1, 60);
  RenderSettings settings = test_settings(kWidth, kHeight);
  settings.shading = ShadingModel::pbr;
  settings.shadows = ShadowTechnique::none;
  settings.layers = {Layer::normal, Layer::object};
  const LayeredImage image = make_renderer(std::move(*scene)).render(camera, settings).value();
  const int middle = kHeight / 2 - 525;  // of the first row
  int compared = 0;
  for (int y = middle - 100; y < middle + 100; ++y) {
    for (int x = kWidth / 2 - 100; x < kWidth / 2 + 100; ++x) {
      if (at(image, "N.Z", x, y) < 0.65F || at(image, "N.Z", x - kColumn, y) < 0.65F) continue;
      ++compared;
      const float base = at(image, "R", x - kColumn, y), coated = at(image, "R", x, y),
                  coat = at(image, "R", x + kColumn, y);
      ASSERT_NEAR(coated, 0.957F * base + coat, 0.005F * base + 0.03F * coat + 1e-4F) << x << ' ' << y;
    }
  }
  EXPECT_GT(compared, 20000);
}

}  // namespace
}  // namespace laterna
