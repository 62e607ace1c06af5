// Light and colours baked into emissive textures: what is seen of them is what was seen live.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "laterna/bake.h"
#include "laterna/material_lobes.h"
#include "laterna/write_scene.h"
#include "reference/projector_scenes.h"
#include "reference/shapes.h"
#include "unit/temporary_folder.h"

namespace laterna {
namespace {

using namespace reference;

Scene floor_below_a_lamp() {
  Scene scene;
  add_object(scene, "floor", floor(0.5F), {0.5F, 0.4F, 0.2F});
  add_light(scene, bulb("lamp", 10), {0, 2, 0}, {1, 0, 0});
  return scene;
}

// Bright above and red toward +X, turned about a slanting axis.
void put_sky(Scene& scene) {
  scene.environment.emplace();
  scene.environment->picture = add_linear_picture(scene, 16, 8, [](int x, int y) {
    return glm::vec3(0.2F + (x < 8 ? 0.0F : 1.5F), 0.3F, 1.0F - static_cast<float>(y) / 10);
  });
  scene.environment->intensity = 0.7;
  scene.environment->world_from_environment =
      glm::dmat3(glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 3))));
}

BakeSettings into_emission(float exposure = 1) {
  BakeSettings settings;
  settings.into = BakeInto::emissive;
  settings.density = 32;
  settings.exposure = exposure;
  return settings;
}

// The papers' model shows base colour · (ambient + E / π of the environment), and nothing that depends on where from.
LayeredImage seen_by(const Renderer& renderer, const View& view, ShadingModel model = ShadingModel::papers) {
  RenderSettings settings = test_settings(24, 24);
  settings.shading = model;
  return render(renderer, view, settings);
}
LayeredImage seen_of(Scene scene, const View& view, ShadingModel model = ShadingModel::papers) {
  return seen_by(make_renderer(std::move(scene)), view, model);
}

double largest_difference(const LayeredImage& a, const LayeredImage& b) {
  double most = 0;
  for (const char* channel : {"R", "G", "B"}) {
    for (int y = 0; y < a.height; ++y) {
      for (int x = 0; x < a.width; ++x)
        most = std::max(most, std::abs(double{at(a, channel, x, y)} - at(b, channel, x, y)));
    }
  }
  return most;
}

// Radiance of matt surfaces, ρ E / π, times the exposure, on both sides, in a file without our extensions.
TEST(BakedEmission, IsWhatIsSeenOnBothSides) {
  const TemporaryFolder folder;
  Scene scene = floor_below_a_lamp();
  scene.materials[0].double_sided = true;
  scene.ambient = glm::vec3(0.05F);
  BakeSettings settings;
  settings.into = BakeInto::emissive;
  settings.exposure = 0.8F;
  const Result<BakedScene> baked = bake_light(scene, settings);
  ASSERT_TRUE(baked);
  EXPECT_TRUE(baked->scene.lights.empty());
  ASSERT_TRUE(write_scene(baked->scene, folder.path() / "baked.gltf"));
  const Result<Scene> read = load_scene({folder.path() / "baked.gltf"});
  ASSERT_TRUE(read);
  for (const Material& material : read->materials) EXPECT_FALSE(material.light_map.front.is_set());
  const Renderer renderer = make_renderer(*read);
  RenderSettings picture = test_settings(9, 9);
  picture.shading = ShadingModel::pbr;
  for (const double side : {1.0, -1.0}) {
    const LayeredImage seen = render(renderer, look({0, 3 * side, 0}, {0, 0, 0}, 5, 1, {0, 0, -1}), picture);
    const double irradiance = side > 0 ? 10.0 / 4 : 0;
    EXPECT_NEAR(at(seen, "R", 4, 4), 0.8 * 0.5 * (irradiance / std::numbers::pi + 0.05), 0.005);
    EXPECT_NEAR(at(seen, "B", 4, 4), 0.8 * 0.2 * (irradiance / std::numbers::pi + 0.05), 0.005);
  }
  settings.exposure = -1;
  EXPECT_FALSE(bake_light(scene, settings));
}

// Light from all around, on both sides of surfaces and however they stand; where it is held back, it is less.
TEST(BakedEmission, HoldsTheEnvironmentsLight) {
  Scene scene;
  add_object(scene, "ball", sphere({0, 0, 0}, 1, 48), {0.5F, 0.4F, 0.3F});
  scene.materials[0].double_sided = true;
  put_sky(scene);
  scene.environment->visible = false;
  scene.ambient_is_set = true;
  const int shade = add_linear_picture(scene, 4, 4, [](int, int) { return glm::vec3(0.5F); });
  Primitive& p = scene.meshes[0].primitives[0];
  p.uv[0].assign(p.positions.size(), glm::vec2(0.5F));
  for (const bool has_shade : {false, true}) {
    scene.materials[0].occlusion_texture.picture = has_shade ? shade : -1;
    const Result<BakedScene> baked = bake_light(scene, into_emission());
    ASSERT_TRUE(baked) << to_string(baked.error());
    const Renderer renderer = make_renderer(scene), renderer_of_baked = make_renderer(baked->scene);
    for (const View& view : {look({0, 1, 4}, {0, 0, 0}, 20, 1), look({3, -2, -2}, {0, 0, 0}, 20, 1),
                             look({0, 0, 0.2}, {0, 0, 1}, 60, 1)}) {
      const LayeredImage live = seen_by(renderer, view);
      EXPECT_GT(at(live, "G", 12, 12), has_shade ? 0.02 : 0.04);
      EXPECT_LT(largest_difference(live, seen_by(renderer_of_baked, view)), 0.006) << has_shade;
    }
  }
}

// Baked occlusion holds light from all around back, as the occlusion texture beside light maps does.
TEST(BakedEmission, OcclusionHoldsTheEnvironmentBack) {
  Scene scene;
  add_object(scene, "floor", floor(0.5F), {0.5F, 0.4F, 0.2F});
  add_object(scene, "wall", wall(0.5F, 0.5F, -0.3F), {0.3F, 0.6F, 0.7F});
  put_sky(scene);
  BakeSettings settings = into_emission();
  settings.density = 64;
  settings.occlusion_rays = 256;
  const Result<BakedScene> baked = bake_light(scene, settings);
  settings.into = BakeInto::light_maps;
  const Result<BakedScene> beside_maps = bake_light(scene, settings);
  ASSERT_TRUE(baked && beside_maps);
  const View view = look({0.2, 0.6, 2}, {0, 0, -0.2}, 20, 1);
  const LayeredImage expected = seen_of(beside_maps->scene, view);
  EXPECT_LT(at(expected, "R", 12, 12), 0.9F * at(seen_of(scene, view), "R", 12, 12));
  EXPECT_LT(largest_difference(expected, seen_of(baked->scene, view)), 0.012);
}

// What is baked mirrors nothing, even of a bright environment, at any angle.
TEST(BakedEmission, ReflectsNothing) {
  Scene scene = floor_below_a_lamp();
  put_sky(scene);
  scene.environment->intensity = 100;
  scene.lights[0].intensity = 1e-3;
  scene.materials[0].base_color = {0, 0, 0, 1};
  const Result<BakedScene> baked = bake_light(scene, into_emission());
  ASSERT_TRUE(baked);
  EXPECT_GT(at(seen_of(scene, look({0, 1, 4}, {0, 0, 0}, 5, 1), ShadingModel::pbr), "R", 12, 12), 1);
  EXPECT_EQ(at(seen_of(baked->scene, look({0, 1, 4}, {0, 0, 0}, 5, 1), ShadingModel::pbr), "R", 12, 12), 0);
}

// Pictures laid on surfaces, and a slide that is painted on them where its projector sees them.
TEST(BakedEmission, HoldsTheLayersOfSurfaces) {
  Scene scene;
  add_object(scene, "wall", wall(1, 1, 0), {0.5F, 0.4F, 0.3F});
  add_object(scene, "post", box({0, 0, 0.5F}, {0.1F, 1, 0.05F}), {0.2F, 0.2F, 0.2F});
  scene.ambient = glm::vec3(0.8F);
  scene.ambient_is_set = true;
  const int slide = add_linear_picture(scene, 8, 8, [](int x, int y) {
    return (x + y) % 2 == 0 ? glm::vec3(0.9F, 0.1F, 0.1F) : glm::vec3(0.1F, 0.2F, 0.9F);
  });
  Light painter = projector("painter", 0.2, 0.2, slide);
  painter.enabled = false;
  add_light(scene, painter, {0.5, 0, 3}, {0.3, 0, 0});
  SurfaceLayer wash, paint;
  wash.color = {0.3F, 0.9F, 0.5F};
  wash.blend = BlendMode::modulate;
  paint.projector = 0;
  scene.materials[0].layers = {wash, paint};
  const Result<BakedScene> baked = bake_light(scene, into_emission());
  ASSERT_TRUE(baked) << to_string(baked.error());
  EXPECT_TRUE(baked->scene.materials[0].layers.empty());
  // Where four luxels meet a pixel's, edges are soft: the middles of squares are asked, and the shadow of the post.
  const View view = square_on(1.2, 1);
  const LayeredImage live = seen_of(scene, view), after = seen_of(baked->scene, view);
  int asked = 0;
  for (const char* channel : {"R", "G", "B"}) {
    for (int y = 3; y < 21; ++y) {
      for (int x = 3; x < 21; ++x) {
        bool is_flat = true;
        for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}})
          is_flat &= std::abs(at(live, channel, x + dx, y + dy) - at(live, channel, x, y)) < 0.01;
        if (!is_flat) continue;
        ++asked;
        EXPECT_NEAR(at(after, channel, x, y), at(live, channel, x, y), 0.03) << channel << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(asked, 200);
  EXPECT_NEAR(at(after, "G", 4, 4), 0.8 * 0.4 * 0.9, 0.01);
}

// Other things are as bright beside what was baked as they were before.
TEST(BakedEmission, ExposureIsThatOfAllThings) {
  Scene scene = floor_below_a_lamp();
  put_sky(scene);
  scene.ambient = glm::vec3(0.5F);
  scene.background = glm::vec3(0.1F);
  for (const char* name : {"sign", "pane"}) add_object(scene, name, floor(0.2F, 0.5F), {0.2F, 0.8F, 0.4F});
  scene.materials[1].unlit = true;
  auto glass = std::make_shared<MaterialLobes>();
  glass->transmission.factor = 1;
  scene.materials[2].lobes = glass;
  scene.materials[2].emissive = glm::vec3(0.3F);
  const Result<BakedScene> baked = bake_light(scene, into_emission(2));
  ASSERT_TRUE(baked) << to_string(baked.error());
  const Scene& after = baked->scene;
  EXPECT_EQ(after.environment->intensity, 1.4);
  EXPECT_EQ(after.ambient, glm::vec3(1));
  EXPECT_EQ(*after.background, glm::vec3(0.2F));
  EXPECT_EQ(after.materials[1].base_color, glm::vec4(0.25F, 1, 0.5F, 1));
  EXPECT_EQ(after.materials[2].emissive, glm::vec3(0.6F));
  EXPECT_EQ(after.materials[2].lobes, glass);
  ASSERT_FALSE(after.warnings.empty());
  EXPECT_NE(to_string(after.warnings.back()).find("\"sign\""), std::string::npos);
}

// Lights that would shine on what reflects none.
TEST(BakedEmission, LeavesNoLightsOn) {
  Scene scene = floor_below_a_lamp();
  add_light(scene, bulb("other", 3), {1, 2, 0}, {0, 0, 0});
  BakeSettings settings = into_emission();
  settings.keep_lights = true;
  Result<BakedScene> refused = bake_light(scene, settings);
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.error()).find("keep_lights"), std::string::npos);
  settings.keep_lights = false;
  settings.lights = {"lamp"};
  refused = bake_light(scene, settings);
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.error()).find("light \"other\" is on"), std::string::npos);
  scene.lights[1].enabled = false;
  EXPECT_TRUE(bake_light(scene, settings));
  settings.into = BakeInto::light_maps;
  scene.lights[1].enabled = true;
  EXPECT_TRUE(bake_light(scene, settings));
}

}  // namespace
}  // namespace laterna
