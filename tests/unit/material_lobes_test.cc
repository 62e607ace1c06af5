// Lobes of materials: read, written, checked, moved; and pictures through transmissive surfaces.
#include "laterna/material_lobes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/write_scene.h"
#include "reference/layered_material.h"
#include "reference/scene_differences.h"
#include "reference/shapes.h"
#include "scene/lobe_factors.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

// A number of its own for each factor, and a picture, place and texture coordinates for each texture.
MaterialLobes full_lobes(int picture) {
  MaterialLobes lobes;
  float next = 0.03125F;
  for (const LobeFactor& factor : lobe_factors()) {
    for (float& value : factor.of(lobes)) value = std::max(factor.low, 0.0F) + (next += 0.03125F);
  }
  int number = 0;
  for (Texture* texture : textures_of(lobes)) {
    *texture = {picture, {}, number % 2, {1, 0, 0.25F * static_cast<float>(number), 0, 1, 0.5F}};
    ++number;
  }
  return lobes;
}

Scene one_triangle() {
  Scene scene;
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  primitive.normals.assign(3, glm::vec3(0, 0, 1));
  primitive.tangents.assign(3, glm::vec4(1, 0, 0, 1));
  primitive.uv[0] = primitive.uv[1] = {{0, 0}, {1, 0}, {0, 1}};
  reference::add_object(scene, "triangle", primitive);
  reference::add_picture(scene, 4, 4, [](int x, int y) { return glm::u8vec3(60 * x, 60 * y, 128); });
  return scene;
}

// Row 73.
TEST(MaterialLobes, ComeBackFromAFile) {
  const TemporaryFolder folder;
  Scene scene = one_triangle();
  scene.materials[0].lobes = std::make_shared<const MaterialLobes>(full_lobes(0));
  ASSERT_EQ(validate(scene), std::vector<Diagnostic>{});
  for (const char* name : {"a.glb", "b.gltf"}) {
    const auto warnings = write_scene(scene, folder / name);
    ASSERT_TRUE(warnings) << to_string(warnings.error());
    const Scene read = load_or_fail({folder / name});
    EXPECT_EQ(warnings_of(read), "");
    EXPECT_EQ(reference::differences(scene, read), std::vector<std::string>{});
  }
  // Lobes that hold what is usual leave nothing in the file.
  scene.materials[0].lobes = std::make_shared<const MaterialLobes>();
  ASSERT_TRUE(write_scene(scene, folder / "c.glb"));
  EXPECT_EQ(load_or_fail({folder / "c.glb"}).materials[0].lobes, nullptr);
}

TEST(MaterialLobes, FactorsOutOfRangeAreLimitedWithAWarning) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  builder.document["meshes"][0]["primitives"][0]["material"] = 0;
  builder.document["extensionsRequired"] = {"KHR_materials_volume"};
  builder.document["materials"] = json::parse(R"([{"extensions": {
    "KHR_materials_clearcoat": {"clearcoatFactor": 1.5},
    "KHR_materials_ior": {"ior": 0.5},
    "KHR_materials_sheen": {"sheenColorFactor": [0.5, -1, 0.25]},
    "KHR_materials_volume": {"attenuationDistance": 0}}}])");
  const Scene scene = builder.load(folder);
  EXPECT_EQ(
      warnings_of(scene),
      "materials[0].extensions.KHR_materials_ior.ior: 0.5 is out of range and taken as 1\n"
      "materials[0].extensions.KHR_materials_clearcoat.clearcoatFactor: 1.5 is out of range and taken as 1\n"
      "materials[0].extensions.KHR_materials_sheen.sheenColorFactor: -1 is out of range and taken as 0\n"
      "materials[0].extensions.KHR_materials_volume.attenuationDistance: 0 is out of range and taken as "
      "1e-09\n");
  EXPECT_EQ(scene.materials[0].lobes->sheen.color, glm::vec3(0.5F, 0, 0.25F));
}

TEST(MaterialLobes, WhatIsNoNumberIsRefusedWithItsPlace) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  builder.document["meshes"][0]["primitives"][0]["material"] = 0;
  builder.document["materials"] = json::parse(R"([{"extensions": {
    "KHR_materials_clearcoat": {"clearcoatFactor": "much", "clearcoatTexture": {"index": 3}},
    "KHR_materials_specular": {"specularColorFactor": [1, 2]},
    "KHR_materials_sheen": 7}}])");
  const std::string messages =
      messages_of(load_scene({folder.write("scene.gltf", builder.text())}), folder.path());
  for (const char* place :
       {"KHR_materials_clearcoat.clearcoatFactor: expected a number",
        "KHR_materials_clearcoat.clearcoatTexture.index: ", "KHR_materials_specular.specularColorFactor: ",
        "KHR_materials_sheen: expected"}) {
    EXPECT_NE(messages.find(place), std::string::npos) << place << "\n" << messages;
  }
}

TEST(MaterialLobes, ScenesBuiltInCodeAreChecked) {
  Scene scene = one_triangle();
  MaterialLobes lobes;
  lobes.ior = 0.5F;
  lobes.clearcoat.factor = 2;
  lobes.sheen.color.y = std::nanf("");
  lobes.volume.attenuation_distance = -1;
  lobes.transmission.texture.picture = 9;
  scene.materials[0].lobes = std::make_shared<const MaterialLobes>(lobes);
  std::string text;
  for (const Diagnostic& fault : validate(scene)) text += to_string(fault) + "\n";
  EXPECT_EQ(text,
            "materials[0].lobes.ior: expected a number from 1 to 100, got 0.5\n"
            "materials[0].lobes.clearcoat.factor: expected a number from 0 to 1, got 2\n"
            "materials[0].lobes.sheen.color[1]: expected a number from 0 to 1, got nan\n"
            "materials[0].lobes.volume.attenuation_distance: expected a finite number of at least "
            "9.999999717180685e-10, got -1\n"
            "materials[0].lobes.transmission.texture.picture: 9 is no index into the 1 pictures, nor -1 for "
            "none\n");
}

TEST(MaterialLobes, PointersMoveThem) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  builder.document["meshes"][0]["primitives"][0]["material"] = 0;
  builder.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
  folder.write("wood.png", "");
  builder.document["images"] = json::array({{{"uri", "wood.png"}}});
  builder.document["textures"] = json::array({{{"source", 0}}});
  builder.document["materials"] = json::parse(R"([{"extensions": {
    "KHR_materials_clearcoat": {"clearcoatFactor": 0.25, "clearcoatTexture": {"index": 0}}}}])");
  const int times = builder.floats({0, 1}, "SCALAR");
  const int numbers = builder.floats({0, 1}, "SCALAR");
  const int colors = builder.floats({0, 0, 0, 1, 0.5, 0.25}, "VEC3");
  const int offsets = builder.floats({0, 0, 1, 2}, "VEC2");
  json channels = json::array(), samplers = json::array();
  const auto add = [&](const std::string& pointer, int output) {
    samplers.push_back({{"input", times}, {"output", output}});
    channels.push_back(
        {{"sampler", samplers.size() - 1},
         {"target",
          {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
  };
  const std::string extensions = "/materials/0/extensions/";
  add(extensions + "KHR_materials_clearcoat/clearcoatFactor", numbers);
  add(extensions + "KHR_materials_volume/attenuationColor", colors);
  add(extensions + "KHR_materials_clearcoat/clearcoatTexture/extensions/KHR_texture_transform/offset",
      offsets);
  add(extensions + "KHR_materials_sheen/sheenColorTexture/extensions/KHR_texture_transform/offset", offsets);
  builder.document["animations"] = json::array({{{"channels", channels}, {"samplers", samplers}}});
  Scene scene = builder.load(folder);
  EXPECT_NE(warnings_of(scene).find(
                "KHR_materials_sheen/sheenColorTexture/extensions/KHR_tex…\" cannot be animated"),
            std::string::npos)
      << warnings_of(scene);
  const std::shared_ptr<const MaterialLobes> at_rest = scene.materials[0].lobes;
  pose_scene(scene, 0.5);
  const MaterialLobes& posed = *scene.materials[0].lobes;
  EXPECT_EQ(posed.clearcoat.factor, 0.5F);
  EXPECT_EQ(posed.volume.attenuation_color, glm::vec3(0.5F, 0.25F, 0.125F));
  EXPECT_EQ(posed.clearcoat.texture.uv_from_mesh_uv, (std::array<float, 6>{1, 0, 0.5F, 0, 1, 1}));
  EXPECT_EQ(at_rest->clearcoat.factor, 0.25F);
}

// ---------------------------------------------------------------------------------------------- pictures

constexpr int kSide = 96;

RenderSettings pbr() {
  RenderSettings settings = reference::test_settings(kSide, kSide);
  settings.shading = ShadingModel::pbr;
  return settings;
}

// A ball with every map before a lamp and a wall.
Scene ball_scene() {
  Scene scene;
  Primitive ball = reference::sphere({0, 0, 0}, 1, 24);
  ball.uv[0].resize(ball.positions.size());
  for (std::size_t i = 0; i < ball.positions.size(); ++i) ball.uv[0][i] = glm::vec2(ball.positions[i]);
  reference::add_object(scene, "ball", ball, {0.75F, 0.5F, 0.25F});
  scene.materials[0].roughness = 0.4F;
  reference::add_object(scene, "wall", reference::wall(3, 3, -2), {0.5F, 0.7F, 0.9F});
  reference::add_picture(scene, 8, 8, [](int x, int y) { return glm::u8vec3(31 * x, 31 * y, 200); });
  Light lamp;
  lamp.name = "lamp";
  lamp.intensity = 40;
  reference::add_light(scene, lamp, {1, 2, 4}, {0, 0, 0});
  scene.ambient = glm::vec3(0.1F);
  return scene;
}

LayeredImage picture_of(const Scene& scene, int threads = 1, std::optional<InstructionSet> set = {}) {
  return reference::render(reference::make_renderer(scene, threads, set),
                           reference::look({0, 0, 4}, {0, 0, 0}, 50, 1), pbr());
}

void expect_same(const LayeredImage& a, const LayeredImage& b) {
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t i = 0; i < a.channels.size(); ++i)
    EXPECT_EQ(a.channels[i].values, b.channels[i].values) << a.channels[i].name;
}

TEST(MaterialLobes, AtTheirDefaultsLeaveEveryBit) {
  Scene scene = ball_scene();
  const LayeredImage plain = picture_of(scene);
  MaterialLobes lobes;
  lobes.clearcoat.texture.picture = lobes.transmission.texture.picture = lobes.anisotropy.texture.picture = 0;
  lobes.sheen.roughness = 0.5F;
  lobes.volume.thickness = 2;
  scene.materials[0].lobes = std::make_shared<const MaterialLobes>(lobes);
  expect_same(plain, picture_of(scene));
}

TEST(MaterialLobes, LookAlikeOnAllMachines) {
  Scene scene = ball_scene();
  MaterialLobes lobes = full_lobes(0);
  for (Texture* texture : textures_of(lobes)) texture->uv_set = 0;
  scene.materials[0].lobes = std::make_shared<const MaterialLobes>(lobes);
  const LayeredImage one = picture_of(scene);
  expect_same(one, picture_of(scene, 3));
  for (const InstructionSet set : supported_instruction_sets()) expect_same(one, picture_of(scene, 2, set));
  Scene plain = scene;
  plain.materials[0].lobes = nullptr;
  EXPECT_NE(picture_of(plain).channels[0].values, one.channels[0].values);
}

// A wall whose colour says where on it one looks, behind a pane that fills the view: red is x / 20 + 1/2, green y likewise.
Scene behind_pane(const MaterialLobes& lobes, float roughness = 0) {
  Scene scene;
  Primitive wall = reference::wall(10, 10, -3);
  for (const glm::vec3& p : wall.positions)
    wall.colors.emplace_back(p.x / 20 + 0.5F, p.y / 20 + 0.5F, 0.25F, 1);
  reference::add_object(scene, "wall", wall);
  scene.materials[0].unlit = true;
  reference::add_object(scene, "pane", reference::wall(4, 4, 0));
  scene.materials[1].metallic = 0;
  scene.materials[1].roughness = roughness;
  scene.materials[1].lobes = std::make_shared<const MaterialLobes>(lobes);
  scene.ambient_is_set = true;
  Light off;
  off.name = "faint";
  off.intensity = 1e-12;
  reference::add_light(scene, off, {0, 0, 5}, {0, 0, 0});
  return scene;
}

MaterialLobes clear_glass() {
  MaterialLobes lobes;
  lobes.specular.factor = 0;  // mirrors nothing
  lobes.transmission.factor = 1;
  return lobes;
}

// Row 73: one refracted look-up. A point of the wall is seen where Snell's law says, through glass of any thickness.
TEST(MaterialLobes, GlassShowsWhatTheRefractedRayLeavesAt) {
  const glm::dvec3 eye(2.5, 0.4, 4);
  const View view = reference::look(eye, {0, 0, 0}, 20, 1);
  for (const float ior : {1.0F, 1.33F, 1.8F}) {
    for (const float thickness : {0.0F, 0.5F, 1.5F}) {
      MaterialLobes lobes = clear_glass();
      lobes.ior = ior;
      lobes.volume.thickness = thickness;
      const LayeredImage image = reference::render(reference::make_renderer(behind_pane(lobes)), view, pbr());
      for (const int x : {30, 60}) {
        const int y = 50;
        // The pixel's ray meets the pane, is refracted, and what is drawn behind where it leaves is seen.
        const glm::dvec2 ndc((x + 0.5) / kSide * 2 - 1, 1 - (y + 0.5) / kSide * 2);
        const double t = std::tan(Angle::degrees(10).in_radians());
        const glm::dvec3 ray = view.pose.world_from_view() * glm::dvec4(ndc.x * t, ndc.y * t, -1, 0);
        const glm::dvec3 at = eye - ray * (eye.z / ray.z);
        const glm::dvec3 exit =
            at + static_cast<double>(thickness) *
                     reference::refracted(glm::normalize(eye - at), {0, 0, 1}, static_cast<double>(ior));
        const glm::dvec3 seen = eye + (exit - eye) * ((-3 - eye.z) / (exit.z - eye.z));
        EXPECT_NEAR(reference::at(image, "R", x, y), seen.x / 20 + 0.5, 5e-4) << ior << ' ' << thickness;
        EXPECT_NEAR(reference::at(image, "G", x, y), seen.y / 20 + 0.5, 5e-4) << ior << ' ' << thickness;
      }
    }
  }
}

// Beer and Lambert, with the object's scale; and the share that facets keep.
TEST(MaterialLobes, GlassTakesOnColourWithDistance) {
  const View view = reference::look({0, 0, 4}, {0, 0, 0}, 20, 1);
  MaterialLobes lobes = clear_glass();
  lobes.ior = 1;
  lobes.volume.thickness = 0.5F;
  lobes.volume.attenuation_distance = 2;
  lobes.volume.attenuation_color = {0.25F, 0.5F, 1};
  Scene scene = behind_pane(lobes);
  scene.nodes[1].parent_from_node = glm::dmat4(2);
  scene.nodes[1].parent_from_node[3][3] = 1;
  const LayeredImage image = reference::render(reference::make_renderer(scene), view, pbr());
  const int middle = kSide / 2;
  EXPECT_NEAR(reference::at(image, "R", middle, middle), 0.5 * std::sqrt(0.25), 3e-3);
  EXPECT_NEAR(reference::at(image, "G", middle, middle), 0.5 * std::sqrt(0.5), 3e-3);
  EXPECT_NEAR(reference::at(image, "B", middle, middle), 0.25, 1e-5);

  lobes = {};
  lobes.transmission.factor = 1;
  const LayeredImage glazed = reference::render(reference::make_renderer(behind_pane(lobes)), view, pbr());
  EXPECT_NEAR(reference::at(glazed, "B", middle, middle), 0.25 * 0.96, 5e-4);
  lobes.transmission.factor = 0.5F;
  const LayeredImage half = reference::render(reference::make_renderer(behind_pane(lobes)), view, pbr());
  EXPECT_NEAR(reference::at(half, "B", middle, middle), 0.125 * 0.96, 5e-4);
}

// What is rough shows a mean: of an even slope, the same in the middle.
TEST(MaterialLobes, RoughGlassBlurs) {
  const View view = reference::look({0, 0, 4}, {0, 0, 0}, 20, 1);
  MaterialLobes lobes = clear_glass();
  Scene scene = behind_pane(lobes, 0.5F);
  const LayeredImage image = reference::render(reference::make_renderer(scene), view, pbr());
  const double across = reference::at(image, "R", kSide / 2 + 20, kSide / 2) -
                        reference::at(image, "R", kSide / 2 - 20, kSide / 2);
  EXPECT_NEAR(reference::at(image, "R", kSide / 2, kSide / 2), 0.5, 0.01);
  EXPECT_GT(across, 0);
}

// Light through a pane is tinted once; through a volume once as well, by the roots of its two sides.
TEST(MaterialLobes, ShadowsOfGlassAreTinted) {
  for (const bool is_volume : {false, true}) {
    Scene scene;
    reference::add_object(scene, "floor", reference::floor(5));
    if (is_volume) {
      reference::add_object(scene, "glass", reference::box({0, 1, 0}, {1, 0.2F, 1}));
    } else {
      Primitive pane = reference::floor(1, 1);
      reference::add_object(scene, "glass", pane);
    }
    Material& glass = scene.materials[1];
    glass.base_color = {0.5F, 1, 0.25F, 1};
    glass.metallic = 0;
    MaterialLobes lobes;
    lobes.transmission.factor = 0.5F;
    lobes.volume.thickness = is_volume ? 1 : 0;
    lobes.volume.attenuation_distance = 1;
    lobes.volume.attenuation_color = {1, 0.5F, 1};
    glass.lobes = std::make_shared<const MaterialLobes>(lobes);
    Light sun;
    sun.name = "sun";
    sun.type = LightType::directional;
    reference::add_light(scene, sun, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
    RenderSettings settings = pbr();
    settings.layers = {Layer::light};
    const View view = reference::look({0, 0.5, 3}, {0, 0, 0}, 30, 1);
    scene.ambient_is_set = true;
    const LayeredImage with = reference::render(reference::make_renderer(scene), view, settings);
    scene.nodes[1].casts_shadow = false;
    const LayeredImage without = reference::render(reference::make_renderer(scene), view, settings);
    const double tint[3] = {0.25, is_volume ? 0.25 : 0.5, 0.125};
    for (int c = 0; c < 3; ++c) {
      const std::string channel = std::string("light.sun.") + "RGB"[c];
      const float lit = reference::at(without, channel, kSide / 2, kSide / 2);
      ASSERT_GT(lit, 0);
      EXPECT_NEAR(reference::at(with, channel, kSide / 2, kSide / 2) / lit, tint[c], 1e-5) << is_volume << c;
    }
  }
}

}  // namespace
}  // namespace laterna
