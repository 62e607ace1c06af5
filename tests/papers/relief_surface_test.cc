// Rows 66, 71 and 73 together: what lies on reliefs and on light maps beside base colour.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "frame/relief_field.h"
#include "laterna/material_lobes.h"
#include "laterna/relief.h"
#include "reference/layered_material.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

int add_heights(Scene& scene, int width, int height, const std::function<double(int, int)>& height_at) {
  return add_linear_picture(scene, width, height,
                            [&](int x, int y) { return glm::vec3(static_cast<float>(height_at(x, y))); });
}

// A floor from −1 to 1 in x and z under a relief; texture coordinates are (x + 1) / 2, (z + 1) / 2.
Material& add_relief_floor(Scene& scene, int heights, double depth) {
  add_object(scene, "floor", floor(1));
  Relief relief;
  relief.texture.picture = heights;
  relief.depth = depth;
  scene.materials.back().relief = std::make_shared<const Relief>(relief);
  return scene.materials.back();
}

// So that none is made up; it gives no light.
void add_dark_lamp(Scene& scene) {
  Light dark = sun("dark");
  dark.color = glm::vec3(0);
  add_light(scene, dark, {0, 5, 0}, {0, 0, 0}, {0, 0, 1});
}

enum class Bearer { base_color, layer, light_map, lobe };

// One picture on bumps at 60°, as what a texture of the material may be.
LayeredImage draw_on_bumps(Bearer bearer) {
  Scene scene;
  const int heights =
      add_heights(scene, 48, 48, [](int x, int y) { return (x / 6 + y / 6) % 2 == 0 ? 1.0 : 0.1; });
  Texture texture;
  texture.picture = add_linear_picture(scene, 24, 24, [](int x, int y) {
    return glm::vec3(0.2F + 0.6F * static_cast<float>((7 * x + 3 * y) % 5) / 4,
                     0.1F + 0.03F * static_cast<float>(x), 0.1F + 0.03F * static_cast<float>(y));
  });
  texture.sampler.mip = MipFilter::none;
  Material& material = add_relief_floor(scene, heights, 0.08);
  RenderSettings settings = papers_settings(160, 120);
  scene.ambient = glm::vec3(bearer == Bearer::light_map ? 0 : 1);
  scene.ambient_is_set = true;
  switch (bearer) {
    case Bearer::base_color:
      material.base_color_texture = texture;
      break;
    case Bearer::layer:
      material.layers.push_back({.texture = texture});
      break;
    case Bearer::light_map:
      material.light_map.front = texture;
      break;
    case Bearer::lobe:
      MaterialLobes lobes;
      lobes.transmission.factor = 1;
      lobes.transmission.texture = texture;
      material.lobes = std::make_shared<const MaterialLobes>(lobes);
      settings.shading = ShadingModel::pbr;
      break;
  }
  add_dark_lamp(scene);
  settings.layers = {Layer::object};
  const View camera = look({0.3, 1.25, 2.165}, {0, 0, 0}, 30, 4.0 / 3);
  return make_renderer(std::move(scene)).render(camera, settings).value();
}

// Whatever is read of a surface is read at one point: layers, light maps and textures of lobes lie on the relief where base
// colour lies, across the triangles' sides and beyond the floor's.
TEST(Relief, AllTexturesLieOnTheSamePoint) {
  const LayeredImage base = draw_on_bumps(Bearer::base_color);
  for (const Bearer bearer : {Bearer::layer, Bearer::light_map, Bearer::lobe}) {
    SCOPED_TRACE(static_cast<int>(bearer));
    const LayeredImage image = draw_on_bumps(bearer);
    int pixels = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        if (at(base, "id.object", x, y) != 0) continue;
        ++pixels;
        // Light that goes through comes out of the dark.
        const float shown = bearer == Bearer::lobe ? 1 - at(image, "R", x, y) : at(image, "R", x, y);
        ASSERT_NEAR(shown, at(base, "R", x, y), 2e-4) << x << ' ' << y;
      }
    }
    EXPECT_GT(pixels, 5000);
  }
}

// A coat follows the heights as it would follow the mesh: on a ramp it shines as on a plane whose normals lean so. A normal map
// of its own says it all.
TEST(Relief, ItsClearCoatLeansWithItsHeights) {
  constexpr double kDepth = 0.5;
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-kDepth * 64 / 63 / 2, 1, 0));
  enum class Leans { by_relief, by_vertex_normals, by_nothing, by_own_map };
  const auto shine = [&](Leans leans) {
    Scene scene;
    const int ramp = add_heights(scene, 64, 1, [](int x, int) { return x / 63.0; });
    const int upright = add_linear_picture(scene, 1, 1, [](int, int) { return glm::vec3(0.5F, 0.5F, 1); });
    const bool bears_relief = leans == Leans::by_relief || leans == Leans::by_own_map;
    Material& material = add_relief_floor(scene, ramp, bears_relief ? kDepth : 0);
    material.base_color = {0, 0, 0, 1};
    MaterialLobes lobes;
    lobes.specular.factor = 0;
    lobes.clearcoat.factor = 1;
    lobes.clearcoat.roughness = 0.3F;
    if (leans == Leans::by_own_map) lobes.clearcoat.normal_texture.picture = upright;
    material.lobes = std::make_shared<const MaterialLobes>(lobes);
    if (leans == Leans::by_vertex_normals)
      for (glm::vec3& n : scene.meshes[0].primitives[0].normals) n = normal;
    const glm::dvec3 to_eye = glm::normalize(glm::dvec3(0, 2, 1));
    const glm::dvec3 to_light = 2 * glm::dot(normal, to_eye) * normal - to_eye;
    add_light(scene, sun("sun"), 5.0 * to_light, {0, 0, 0});
    View camera = look(3.0 * to_eye, {0, 0, 0}, 30, 1);
    camera.projection = Projection::orthographic(0.1, 0.1, 0.1, 20);
    RenderSettings settings = test_settings(8, 8);
    settings.shading = ShadingModel::pbr;
    settings.shadows = ShadowTechnique::none;
    return at(make_renderer(std::move(scene)).render(camera, settings).value(), "G", 4, 4);
  };
  const float expected = shine(Leans::by_vertex_normals), upright = shine(Leans::by_nothing);
  EXPECT_GT(expected, 1.5F * upright);
  EXPECT_NEAR(shine(Leans::by_relief), expected, 2e-3F * expected);
  EXPECT_NEAR(shine(Leans::by_own_map), upright, 2e-3F * upright);
}

// A mirrored picture takes no more room than itself: 17 × 9 corners for 15 × 7 texels, the outermost twice.
TEST(Relief, MirroringFoldsTheHeights) {
  Image heights(15, 7, 1, PixelType::f32, Transfer::linear);
  Sampler mirrored;
  mirrored.wrap_u = mirrored.wrap_v = Wrap::mirror;
  const frame::ReliefField field(heights, ReliefKind::height, mirrored);
  EXPECT_EQ(field.x.cells, 16);
  EXPECT_EQ(field.y.cells, 8);
  EXPECT_EQ(field.corners.size(), 17U * 9U);
}

// Far from the picture it comes again as near it: 4000 repetitions of 2048 texels away, where lattice coordinates are beyond 8
// million.
TEST(Relief, RepeatsHoweverFarAway) {
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirror}) {
    const auto draw = [&](float tiles, bool is_flat = false) {
      Scene scene;
      const int heights = add_heights(
          scene, 2048, 1, [](int x, int) { return 0.5 + 0.5 * std::cos(x * std::numbers::pi / 1024); });
      add_relief_floor(scene, heights, 0.1);
      Relief relief = *scene.materials.back().relief;
      relief.texture.uv_from_mesh_uv = {1, 0, tiles, 0, 1, 0};
      relief.texture.sampler.wrap_u = wrap;
      if (is_flat) relief.depth = 0;
      scene.materials.back().relief = std::make_shared<const Relief>(relief);
      RenderSettings settings = papers_settings(80, 60);
      settings.layers = {Layer::depth};
      return make_renderer(std::move(scene))
          .render(look({0.3, 1.25, 2.165}, {0, 0, 0}, 30, 4.0 / 3), settings)
          .value();
    };
    const LayeredImage near = draw(0), far = draw(4000), flat = draw(0, true);
    double deepest = 0;
    for (int y = 20; y < 40; ++y) {
      for (int x = 20; x < 60; ++x) {
        // Texture coordinates of 4000 are told apart by half a texel, a thousandth of the floor.
        ASSERT_NEAR(at(far, "Z", x, y), at(near, "Z", x, y), 1e-3) << x << ' ' << y;
        deepest = std::max<double>(deepest, at(near, "Z", x, y) - at(flat, "Z", x, y));
      }
    }
    EXPECT_GT(deepest, 0.05);
  }
}

// What a wall under 1 lux of baked light shows at an angle of sight, times π.
double baked_share(const MaterialLobes& lobes, double angle_deg, float metallic = 0) {
  Scene scene;
  const int lux = add_linear_picture(scene, 1, 1, [](int, int) { return glm::vec3(1); });
  add_object(scene, "wall", wall(1, 1, 0), glm::vec3(0.5F));
  Material& material = scene.materials[0];
  material.metallic = metallic;
  material.light_map.front.picture = lux;
  material.lobes = std::make_shared<const MaterialLobes>(lobes);
  scene.ambient = glm::vec3(0);
  scene.ambient_is_set = true;
  add_dark_lamp(scene);
  const double angle = angle_deg * std::numbers::pi / 180;
  View camera = look({5 * std::sin(angle), 0, 5 * std::cos(angle)}, {0, 0, 0}, 30, 1);
  camera.projection = Projection::orthographic(0.1, 0.1, 0.1, 20);
  RenderSettings settings = test_settings(4, 4);
  settings.shading = ShadingModel::pbr;
  return std::numbers::pi * at(make_renderer(std::move(scene)).render(camera, settings).value(), "G", 2, 2);
}

// Baked light is scattered by what is left of the base colour of 0.5 beneath the other layers: the formulas of docs/materials.md.
TEST(LightMaps, LobesTakeTheirShareOfBakedLight) {
  const double plain = 0.5 * 0.96;
  EXPECT_NEAR(baked_share({}, 0), plain, 1e-5);
  EXPECT_NEAR(baked_share({}, 60), plain, 1e-5);

  MaterialLobes specular;
  specular.specular.factor = 0.25F;
  EXPECT_NEAR(baked_share(specular, 0), 0.5 * 0.99, 1e-5);
  specular.specular.factor = 1;
  specular.ior = 2;
  EXPECT_NEAR(baked_share(specular, 0), 0.5 * (1 - 1.0 / 9), 1e-5);
  specular.specular.color = {0.5F, 0.5F, 1};
  EXPECT_NEAR(baked_share(specular, 0), 0.5 * (1 - 1.0 / 9), 1e-5);  // the largest channel's
  EXPECT_NEAR(baked_share(specular, 0, 0.75F), 0.5 * 0.25 * (1 - 0.25 / 9 - 0.75 * 0.5), 1e-5);

  MaterialLobes glass;
  glass.transmission.factor = 0.75F;
  EXPECT_NEAR(baked_share(glass, 0), 0.25 * plain, 1e-5);

  MaterialLobes coat;
  coat.clearcoat.factor = 0.5F;
  EXPECT_NEAR(baked_share(coat, 0), plain * (1 - 0.5 * 0.04), 1e-5);
  EXPECT_NEAR(baked_share(coat, 60), plain * (1 - 0.5 * (0.04 + 0.96 / 32)), 1e-5);

  MaterialLobes cloth;
  cloth.sheen.color = {0.2F, 0.6F, 0.4F};
  cloth.sheen.roughness = 0.5F;
  for (const double angle : {0.0, 60.0}) {
    const double albedo = sheen_albedo(std::cos(angle * std::numbers::pi / 180), 0.5, 200);
    EXPECT_NEAR(baked_share(cloth, angle), plain * (1 - 0.6 * albedo), 1e-3) << angle;
  }
}

}  // namespace
}  // namespace laterna
