// What of a scene is baked, how it is shown elsewhere, and what is said of the rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>

#include "laterna/bake.h"
#include "laterna/image_based_light.h"
#include "laterna/material_lobes.h"
#include "laterna/mirrors.h"
#include "laterna/relief.h"
#include "laterna/write_scene.h"
#include "reference/projector_scenes.h"
#include "reference/shapes.h"
#include "unit/temporary_folder.h"

namespace laterna {
namespace {

using namespace reference;

Scene lit_floor(float height = 0) {
  Scene scene;
  add_object(scene, "floor", floor(0.5F, height), {0.5F, 0.4F, 0.2F});
  add_light(scene, bulb("lamp", 10), {0, 2, 0}, {1, 0, 0});
  return scene;
}

std::string warnings_of(const BakedScene& baked) {
  std::string all;
  for (const Diagnostic& d : baked.scene.warnings) all += to_string(d) + "\n";
  return all;
}

float brightest_of(const BakedScene& baked) {
  float most = 0;
  for (const Picture& picture : baked.scene.pictures) {
    if (picture.pixels == nullptr) continue;
    for (const float value : picture.pixels->values<float>()) most = std::max(most, value);
  }
  return most;
}

// Half of the way to a target 1 m higher, the lamp is 1.5 m away.
TEST(BakedThings, WhatMorphsIsBakedAsItStands) {
  Scene scene = lit_floor();
  Primitive& p = scene.meshes[0].primitives[0];
  p.targets.resize(1);
  p.targets[0].positions.assign(p.positions.size(), glm::vec3(0, 1, 0));
  scene.nodes[0].weights = {0.5F};
  const Result<BakedScene> baked = bake_light(scene, {});
  ASSERT_TRUE(baked);
  EXPECT_NEAR(brightest_of(*baked), 10 / 2.25, 0.02);
  const Primitive& still =
      baked->scene.meshes[static_cast<std::size_t>(baked->scene.nodes[0].mesh)].primitives[0];
  EXPECT_TRUE(still.targets.empty());
  for (const glm::vec3& position : still.positions) EXPECT_FLOAT_EQ(position.y, 0.5F);
  EXPECT_NE(warnings_of(*baked).find("object \"floor\": wears a skin or morphs: baked as it stands at 0 s"),
            std::string::npos);
}

// A joint that has risen by 1 m: the lamp is 1 m away. The node that wears the skin stands elsewhere, which plays no part.
TEST(BakedThings, WhatWearsASkinIsBakedAsItStands) {
  Scene scene = lit_floor();
  Primitive& p = scene.meshes[0].primitives[0];
  p.influences = 1;
  p.joints.assign(p.positions.size(), 0);
  p.joint_weights.assign(p.positions.size(), 1.0F);
  Node joint;
  joint.name = "joint";
  joint.parent_from_node[3] = {0, 1, 0, 1};
  scene.nodes.push_back(joint);
  scene.skins.push_back({"skin", {static_cast<int>(scene.nodes.size()) - 1}, {glm::dmat4(1)}});
  scene.nodes[0].skin = 0;
  scene.nodes[0].parent_from_node[3] = {50, 0, 0, 1};
  const Result<BakedScene> baked = bake_light(scene, {});
  ASSERT_TRUE(baked);
  EXPECT_NEAR(brightest_of(*baked), 10, 0.1);
  EXPECT_TRUE(baked->scene.skins.empty());
  EXPECT_TRUE(validate(baked->scene).empty());
}

// Textures that use the second texture coordinates are shown as before: alone, they move to the first; beside others, they
// follow the second to its place in the page.
TEST(BakedThings, TexturesOfTheSecondCoordinatesStay) {
  for (const bool has_both : {false, true}) {
    Scene scene = lit_floor();
    scene.ambient = glm::vec3(1);
    const int picture = add_linear_picture(scene, 16, 16, [](int x, int y) {
      return glm::vec3(0.1F + 0.05F * float(x), 0.1F + 0.05F * float(y), 0.3F);
    });
    Material& material = scene.materials[0];
    material.base_color_texture.picture = picture;
    material.base_color_texture.uv_set = 1;
    material.base_color_texture.uv_from_mesh_uv = {0, 2, 0.1F, -2, 0, 0.3F};
    if (has_both) material.emissive_texture.picture = picture;
    Primitive& p = scene.meshes[0].primitives[0];
    p.uv = {};
    for (const glm::vec3& at : p.positions) {
      p.uv[0].emplace_back(at.x, at.z);
      p.uv[1].emplace_back(0.5F + 0.7F * at.x, 0.5F - 0.6F * at.z);
    }
    scene.lights[0].intensity = 1e-6;  // colours alone
    const Result<BakedScene> baked = bake_light(scene, {});
    ASSERT_TRUE(baked) << to_string(baked.error());
    EXPECT_EQ(baked->report.surfaces, 1U);
    EXPECT_EQ(warnings_of(*baked), "");
    const View view = look({0, 2, 0}, {0, 0, 0}, 30, 1, {0, 0, -1});
    const LayeredImage before = render(make_renderer(scene), view, test_settings(32, 32));
    const LayeredImage after = render(make_renderer(baked->scene), view, test_settings(32, 32));
    for (const char* channel : {"R", "G"}) {
      for (int i = 2; i < 30; ++i)
        EXPECT_NEAR(at(after, channel, i, 11), at(before, channel, i, 11), 2e-3) << channel << i << has_both;
    }
    // Coordinates that overlap serve textures alone.
    if (has_both) {
      for (glm::vec2& uv : scene.meshes[0].primitives[0].uv[1]) uv *= 3;
      const Result<BakedScene> not_baked = bake_light(scene, {});
      ASSERT_TRUE(not_baked);
      EXPECT_EQ(not_baked->report.surfaces, 0U);
      EXPECT_NE(warnings_of(*not_baked).find("use both sets of texture coordinates"), std::string::npos);
    }
  }
}

// Occlusion is linear in files as well: nothing is said of it.
TEST(BakedThings, OcclusionIsWrittenAsItIs) {
  const TemporaryFolder folder;
  BakeSettings settings;
  settings.occlusion_rays = 16;
  const Result<BakedScene> baked = bake_light(lit_floor(), settings);
  ASSERT_TRUE(baked);
  const Result<std::vector<Diagnostic>> written = write_scene(baked->scene, folder.path() / "baked.glb");
  ASSERT_TRUE(written);
  for (const Diagnostic& warning : *written) ADD_FAILURE() << to_string(warning);
}

// A lamp's light comes from the light map, the environment's comes to it live, neither of them twice: of a file, and on both
// sides, the picture is that of the scene that was baked.
TEST(BakedThings, TheEnvironmentStaysBesideLightMaps) {
  const TemporaryFolder folder;
  Scene scene = lit_floor();
  scene.materials[0].double_sided = true;
  scene.lights[0].intensity = 1;
  scene.phong = PhongHighlight{0, 10};  // highlights are what light maps cannot keep
  scene.environment.emplace();
  scene.environment->picture = add_linear_picture(scene, 32, 16, [](int x, int y) {
    return y < 8 ? glm::vec3(0.6F, 0.4F, 0.3F) : glm::vec3(0.1F, x < 16 ? 0.1F : 0.3F, 0.2F);
  });
  ASSERT_TRUE(filter_environment(scene, {32}));
  const Result<BakedScene> baked = bake_light(scene, {});
  ASSERT_TRUE(baked) << to_string(baked.error());
  ASSERT_TRUE(write_scene(baked->scene, folder.path() / "baked.glb"));
  Result<Scene> read = load_scene({folder.path() / "baked.glb"});
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_TRUE(read->lights.empty());
  read->phong = scene.phong;  // which glTF has no place for
  Scene lamp_alone = scene;
  lamp_alone.environment.reset();
  const Renderer live = make_renderer(scene), shown = make_renderer(*read), dark = make_renderer(lamp_alone);
  for (const double side : {1.0, -1.0}) {
    const View view = look({0, 2 * side, 0.1}, {0, 0, 0}, 20, 1, {0, 0, -1});
    const LayeredImage expected = render(live, view, test_settings(16, 16));
    const LayeredImage found = render(shown, view, test_settings(16, 16));
    const LayeredImage without = render(dark, view, test_settings(16, 16));
    for (const char* channel : {"R", "G", "B"}) {
      const float value = at(expected, channel, 8, 8);
      EXPECT_GT(value, at(without, channel, 8, 8) + 0.01F) << channel << side;
      EXPECT_NEAR(at(found, channel, 8, 8), value, 0.01F * value) << channel << side;
    }
  }
}

// One note for each kind of thing.
TEST(BakedThings, WhatIsLostIsTold) {
  Scene scene = lit_floor();
  const int picture = add_linear_picture(scene, 4, 4, [](int, int) { return glm::vec3(0.5F); });
  Material& material = scene.materials[0];
  auto relief = std::make_shared<Relief>();
  relief->texture.picture = picture;
  material.relief = relief;
  scene.meshes[0].primitives[0].uv[0].assign(scene.meshes[0].primitives[0].positions.size(), glm::vec2(0));
  add_object(scene, "window", floor(0.3F, 0.5F));
  auto glass = std::make_shared<MaterialLobes>();
  glass->transmission.factor = 1;
  scene.materials[1].lobes = glass;
  add_object(scene, "mirror", floor(0.3F, -1));
  scene.materials[2].mirror = std::make_shared<Mirror>();
  add_object(scene, "coin", floor(0.1F, -0.5F));
  scene.materials[3].metallic = 1;
  Clip clip;
  clip.keys.push_back({KeyInterpolation::linear, {0, 1}, {0, 2, 0, 1, 2, 0}});
  ClipChannel channel;
  channel.target = static_cast<int>(scene.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].light >= 0) channel.target = static_cast<int>(i);
  }
  scene.nodes[static_cast<std::size_t>(channel.target)].transform = Transform{{0, 2, 0}};
  scene.nodes[static_cast<std::size_t>(channel.target)].parent_from_node = to_matrix(Transform{{0, 2, 0}});
  channel.keys = 0;
  clip.channels.push_back(channel);
  scene.clips.push_back(clip);
  const Result<BakedScene> baked = bake_light(scene, {});
  ASSERT_TRUE(baked) << to_string(baked.error());
  const std::string told = warnings_of(*baked);
  for (const char* note :
       {"lights \"lamp\": move or change: baked as they are at 0 s", "materials \"floor\": have a relief",
        "materials \"window\": are glass", "materials \"mirror\": are mirrors",
        "materials \"coin\": are all metal", "clips: light maps hold one instant"})
    EXPECT_NE(told.find(note), std::string::npos) << note << '\n' << told;
  EXPECT_EQ(std::ranges::count(told, '\n'), 6);
  EXPECT_FALSE(baked->scene.materials[1].light_map.front.is_set());
  EXPECT_NE(baked->scene.materials[1].lobes, nullptr);
}

}  // namespace
}  // namespace laterna
