// Bodies cut finer than pixels and texels: sides that the light does not fall on stay dark.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/picture_probes.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

constexpr int kCells = 160;  // along each side

// Bricks five centimetres high, as tools make them of height maps: one vertex for each texel.
Primitive bricks() {
  const auto height = [](double x, double z) {
    const double along = 4 * x - std::floor(4 * x), across = 6 * z - std::floor(6 * z);
    return along > 0.15 && across > 0.15 ? 0.05F : 0.0F;
  };
  Primitive surface;
  for (int j = 0; j <= kCells; ++j) {
    for (int i = 0; i <= kCells; ++i) {
      const double x = 2.0 * i / kCells - 1, z = 2.0 * j / kCells - 1;
      surface.positions.emplace_back(x, height(x, z), z);
    }
  }
  constexpr std::uint32_t kRow = kCells + 1;
  for (std::uint32_t j = 0; j < kCells; ++j) {
    for (std::uint32_t i = 0; i < kCells; ++i) {
      const std::uint32_t corner = j * kRow + i;
      for (const std::uint32_t step : {0U, kRow, 1U, 1U, kRow, kRow + 1})
        surface.indices.push_back(corner + step);
    }
  }
  return surface;
}

LayeredImage visibility_by(ShadowTechnique technique) {
  Scene scene;
  add_object(scene, "bricks", bricks());
  Light lamp = spot("lamp", 30);
  lamp.shadow.technique = technique;
  lamp.shadow.resolution = 1024;
  add_light(scene, lamp, {2.6, 0.9, -0.7}, {0, 0, 0});
  RenderSettings settings = test_settings(320, 240);
  settings.shading = ShadingModel::papers;
  settings.layers = {Layer::visibility};
  return render(make_renderer(std::move(scene)), look({0.3, 1.25, 2.165}, {0, 0, 0}, 30, 320.0 / 240),
                settings);
}

TEST(FinelyCutBodies, SidesAwayFromTheLampHaveNoDotsOfLight) {
  const LayeredImage by_map = visibility_by(ShadowTechnique::map);
  const LayeredImage by_rays = visibility_by(ShadowTechnique::raytraced);
  int dark = 0, dots = 0;
  for (int y = 1; y + 1 < by_map.height; ++y) {
    for (int x = 1; x + 1 < by_map.width; ++x) {
      bool is_inside_shadow = true;
      for (int k = 0; k < 9; ++k)
        is_inside_shadow &= at(by_rays, "visibility.lamp", x + k % 3 - 1, y + k / 3 - 1) == 0;
      if (!is_inside_shadow) continue;
      ++dark;
      if (at(by_map, "visibility.lamp", x, y) > 0.1F) ++dots;
    }
  }
  EXPECT_GT(dark, 2000);
  EXPECT_LE(dots, 12);  // 94 when places on such sides counted
}

}  // namespace
}  // namespace laterna
