// Scenes written as glTF and read again.
#include "laterna/write_scene.h"

#include <gtest/gtest.h>

#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/file_io.h"
#include "image/encoder.h"
#include "laterna/lamps.h"
#include "reference/scene_differences.h"
#include "scene/ies_writer.h"
#include "scene/instance_transforms.h"
#include "scene/setting_names.h"
#include "scene/texture_transform.h"
#include "unit/gltf_builder.h"
#include "unit/lamp_texts.h"

namespace laterna {
namespace {

using namespace testing_scenes;

Image picture(int width, int height, PixelType type) {
  Image image(width, height, 3, type, type == PixelType::f32 ? Transfer::linear : Transfer::srgb);
  for (std::size_t i = 0; i < image.bytes().size(); ++i)
    image.bytes()[i] = static_cast<std::byte>(i * 37 % 120);
  return image;
}

Picture encoded(const Image& image) {
  Picture result;
  result.encoded_owner = std::make_shared<const std::vector<std::byte>>(image::encode_png(image, 1));
  result.encoded = *result.encoded_owner;
  return result;
}

Picture pixels(const Image& image) {
  Picture result;
  result.pixels = std::make_shared<const Image>(image);
  return result;
}

Material full_material() {
  Material material;
  material.name = "brick \"old\"";
  material.base_color = {0.25F, 0.1F, 0.7F, 0.5F};
  material.base_color_texture = {
      0,
      {Wrap::clamp, Wrap::mirror, Filter::nearest, Filter::linear, MipFilter::nearest},
      1,
      composed({{0.125, -3}, 0.3, {2, 0.7}})};
  material.metallic = 0.2F;
  material.roughness = 0.3F;
  material.metallic_roughness_texture = {1, {}, 0, composed({{0, 0.5}, 0, {1, 2}})};
  material.normal_texture.picture = 1;
  material.normal_scale = 0.6F;
  material.occlusion_texture.picture = 0;
  material.occlusion_strength = 0.9F;
  material.emissive = {3.3F, 0.1F, 5};
  material.emissive_texture = {
      0, {Wrap::repeat, Wrap::repeat, Filter::linear, Filter::nearest, MipFilter::none}, 0};
  material.alpha_mode = AlphaMode::mask;
  material.alpha_cutoff = 0.45F;
  material.double_sided = material.unlit = true;
  return material;
}

Primitive full_triangle() {
  Primitive triangle;
  triangle.positions = {{0, 0, 0.1F}, {1, 0, 0}, {0, 1, 0}};
  triangle.normals = {{0, 0, 1}, {0, 0.6F, 0.8F}, {0, 0, 1}};
  triangle.tangents = {{1, 0, 0, -1}, {1, 0, 0, 1}, {0.6F, 0.8F, 0, 1}};
  triangle.uv = {std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}},
                 std::vector<glm::vec2>{{0, 1}, {1, 2}, {0.1F, 1}}};
  triangle.colors = {{1, 0.1F, 0, 1}, {0, 1, 0, 0.5F}, {0, 0, 1, 1}};
  triangle.indices = {0, 1, 2, 2, 1, 0};
  triangle.material = 0;
  return triangle;
}

ShadowSettings full_shadow() {
  ShadowSettings s;
  s.technique = ShadowTechnique::map;
  s.resolution = 777;
  s.filter = ShadowFilter::averaged_depths;
  s.kernel = 5;
  s.constant_bias = 0.01;
  s.slope_bias = -2;
  s.caster_faces = CasterFaces::back_only;
  s.outside_is_lit = false;
  s.depth = ShadowDepth::radial;
  s.soft_edge = 0.3;
  s.moments = ShadowMoments::variance;
  s.bleeding_reduction = 0.3F;
  s.blur = 3.1F;
  s.planes = {{glm::normalize(glm::dvec3(0.3, 2, -0.7)), -1.7}};
  s.smooth = 3;
  s.smooth_kernel = SmoothKernel::binomial;
  s.orders_objects = s.culls_occluders = false;
  s.cascades = 3;
  s.split_lambda = 0.1;
  s.cascade_distance = 12.3;
  s.color = {0.1F, 0.2F, 0.3F};
  s.opacity = 0.7F;
  s.ambient = 0.15F;
  s.fill = 0.35F;
  return s;
}

Light full_projector() {
  Light light;
  light.type = LightType::projector;
  light.color = {1.7F, 0.3F, 0.123F};
  light.intensity = 190.3;
  light.enabled = false;
  light.attenuation = Attenuation::linear;
  light.range = 17.7;
  light.projection = Projection::perspective(Angle::degrees(26), 1.6, 0.2, 55).shifted(0.1, 0.5);
  light.aspect_from_slide = false;
  light.slide = 0;
  light.profile = BeamProfile::uniform_candela;
  light.outside = Outside::mirror;
  light.blend = BlendMode::reverse_subtract;
  light.black_level = 0.002;
  light.panel_width = 1920;
  light.panel_height = 1200;
  light.distortion = {-0.02, 0.001, 0.0001, -0.0002, 0.0003};
  light.aperture = {0.03, 4.2};
  light.shadow = full_shadow();
  return light;
}

LightDistribution full_lamp() {
  LightDistribution lamp;
  lamp.luminaire = "Floodlight 7";
  lamp.vertical_deg = {0, 30, 90};
  lamp.horizontal_deg = {0, 90.5, 200, 360};
  lamp.candela = {100, 50.5, 1, 100, 33.3, 0.1, 100, 12.0 / 7, 0, 100, 50.5, 1};
  lamp.rated_lumens = 812.5;
  lamp.watts = 8.5;
  lamp.opening_m = {0.1, 0.2, -0.3};
  lamp.tilt = {{0, 1}, {45, 0.95}};
  return lamp;
}

void hang(Scene& scene, Light light, const std::string& name) {
  Node node;
  node.name = name;
  node.light = static_cast<int>(scene.lights.size());
  node.parent_from_node = glm::translate(glm::dmat4(1.0), {0.1 * node.light, 2, 3});
  node.parent_from_node = glm::rotate(node.parent_from_node, 0.7 + node.light, {1, 2, 3});
  light.name = name;
  scene.lights.push_back(std::move(light));
  scene.nodes.push_back(std::move(node));
}

void add_lights(Scene& scene) {
  hang(scene, full_projector(), "projector");

  Light fitted = full_projector();  // whose frame follows its slide
  fitted.distortion = {};
  fitted.aspect_from_slide = true;
  fitted.projection =
      Projection::perspective(Angle::degrees(31.7), 1, 0.1, std::numeric_limits<double>::infinity());
  fitted.enabled = true;
  fitted.attenuation = Attenuation::gltf_windowed;
  fitted.lumens = 3000;
  fitted.intensity = 1;
  hang(scene, fitted, "fitted");

  Light beam;  // of floats, through a calibrated lens
  beam.type = LightType::projector;
  beam.slide = 2;
  beam.slide_is_intensity = true;
  beam.aspect_from_slide = false;
  beam.projection = Projection::from_intrinsics(1201.7, 1199.3, 633.1, 359.9, 1280, 720, 0.1, 90);
  beam.source.width = 0.2;
  beam.source.height = 0.1;
  hang(scene, beam, "beam");

  Light parallel;
  parallel.type = LightType::projector;
  parallel.aspect_from_slide = false;
  parallel.projection = {true, -1, 0.3, -0.7, 2.1, -3, 8};
  parallel.attenuation = Attenuation::none;
  hang(scene, parallel, "parallel");

  Light sun;
  sun.type = LightType::directional;
  sun.intensity = 2.2;
  sun.fit = false;
  sun.projection = Projection::orthographic(7.3, 5.1, -2, 40);
  sun.source.angular_diameter = Angle::degrees(0.53);
  hang(scene, sun, "sun");
  sun.projection = {true, -1, 2, -3, 4, 0, 9};
  hang(scene, sun, "window");

  Light warped;
  warped.type = LightType::directional;
  warped.shadow.warp = ShadowWarp::light_space_perspective;
  hang(scene, warped, "warped");

  Light spot;
  spot.type = LightType::spot;
  spot.inner_cone = spot.outer_cone = Angle::degrees(20);
  spot.source.radius = 0.07;
  spot.shadow.technique = ShadowTechnique::none;
  hang(scene, spot, "spot");

  Light bulb;
  bulb.lumens = 806;
  bulb.shadow.layout = ShadowLayout::dual_paraboloid;
  hang(scene, bulb, "bulb");

  Light lamp;
  lamp.distribution = std::make_shared<const LightDistribution>(full_lamp());
  lamp.intensity = 0.3;
  lamp.color = {2, 1, 0.5F};
  hang(scene, lamp, "lamp");
  lamp.type = LightType::spot;
  lamp.inner_cone = Angle::degrees(10);
  lamp.shadow = {};
  lamp.shadow.technique = ShadowTechnique::exact;
  hang(scene, lamp, "lamp in a can");
}

void add_cameras(Scene& scene) {
  const double endless = std::numeric_limits<double>::infinity();
  const std::pair<Projection, bool> cameras[] = {
      {Projection::perspective(Angle::degrees(34), 1, 0.1, endless), true},
      {Projection::perspective(Angle::degrees(77.7), 16.0 / 9, 0.01, 60), false},
      {Projection::perspective(Angle::degrees(60), 1.5, 0.1, 70).shifted(0.25, -0.1), false},
      {Projection::from_intrinsics(2905.88, 2905.88, 1416.1, 1064.2, 2832, 2128, 0.1, endless), false},
      {Projection::orthographic(2.5, 1.5, 0, 10), false},
      {Projection::orthographic(1.7, 1.7, -4, 10), true},
      {{true, -1, 3, -2, 0.5, 1, 9}, false}};
  for (const auto& [projection, from_picture] : cameras) {
    Node node;
    node.name = "camera " + std::to_string(scene.cameras.size());
    node.camera = static_cast<int>(scene.cameras.size());
    scene.cameras.push_back({node.name, projection, from_picture});
    scene.nodes.push_back(std::move(node));
  }
}

// Every member of everything, set to something else than its default.
Scene full_scene() {
  Scene scene;
  scene.pictures = {encoded(picture(7, 5, PixelType::u8)), pixels(picture(4, 4, PixelType::u16)),
                    pixels(picture(3, 2, PixelType::f32))};
  scene.materials = {full_material()};
  scene.meshes = {{"triangle", {full_triangle()}}};
  Node node;
  node.name = "floor";
  node.mesh = 0;
  node.casts_shadow = node.receives_shadow = node.visible = false;
  node.node_from_instance = {
      to_matrix(
          {{1, 2, 3}, *normalized_rotation(glm::dvec4(glm::vec4(0.5F, 0.1F, -0.7F, 0.5F))), {1, 2, 0.5}}),
      glm::dmat4(1.0)};
  scene.nodes.push_back(node);
  node = {};
  node.parent = 0;
  node.mesh = 0;
  node.parent_from_node = glm::scale(glm::translate(glm::dmat4(1.0), {0, 1.0 / 3, 0}), {1, 1, -2});
  scene.nodes.push_back(node);
  add_lights(scene);
  add_cameras(scene);
  scene.ambient = {0.12F, 0.13F, 0.16F};
  scene.ambient_is_set = true;
  scene.background = glm::vec3(0.01F, 0.02F, 3);
  scene.phong = PhongHighlight{0.15F, 40.7F};
  return scene;
}

std::string lines(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& line : all) text += line + "\n";
  return text;
}

json document_of(const std::filesystem::path& file) {
  const auto bytes = read_file(file);
  return json::parse(reinterpret_cast<const char*>(bytes->data()),
                     reinterpret_cast<const char*>(bytes->data()) + bytes->size());
}

void write_or_fail(const Scene& scene, const std::filesystem::path& file,
                   const SceneWriteOptions& options = {}) {
  const auto warnings = write_scene(scene, file, options);
  ASSERT_TRUE(warnings) << to_string(warnings.error());
  for (const Diagnostic& warning : *warnings) ADD_FAILURE() << to_string(warning);
}

TEST(WriteScene, EveryMemberComesBack) {
  const Scene scene = full_scene();
  const TemporaryFolder folder;
  for (const char* name : {"all.glb", "all.gltf", "one.gltf"}) {
    write_or_fail(scene, folder / name, {.embeds = std::string(name) == "one.gltf"});
    const Scene again = load_or_fail({folder / name});
    EXPECT_EQ(lines(reference::differences(scene, again)), "") << name;
  }
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"all.bin", "all.glb", "all.gltf", "all.image0.png", "all.image1.png",
                                      "all.image2.exr", "all.lamp1.ies", "one.gltf"}));
}

TEST(WriteScene, TheSameSceneMakesTheSameBytes) {
  const TemporaryFolder folder;
  write_or_fail(full_scene(), folder / "a.glb");
  write_or_fail(load_or_fail({folder / "a.glb"}), folder / "b.glb");
  write_or_fail(load_or_fail({folder / "b.glb"}), folder / "c.glb");
  EXPECT_EQ(*read_file(folder / "b.glb"), *read_file(folder / "c.glb"));
}

TEST(WriteScene, OtherProgramsNeedNothingOfOurs) {
  const TemporaryFolder folder;
  write_or_fail(full_scene(), folder / "a.gltf");
  const json file = document_of(folder / "a.gltf");
  EXPECT_FALSE(file.contains("extensionsRequired"));
  const std::vector<std::string> used = file["extensionsUsed"];
  EXPECT_EQ(used,
            (std::vector<std::string>{"EXT_lights_ies", "EXT_mesh_gpu_instancing", "KHR_lights_punctual",
                                      "KHR_materials_emissive_strength", "KHR_materials_unlit",
                                      "KHR_texture_transform", "LATERNA_lighting", "LATERNA_projector"}));
  const std::string text = file.dump();
  for (const std::string& name : used) EXPECT_NE(text.find("\"" + name + "\":"), std::string::npos) << name;
}

// glTF 2.0, 3.6: alignment, and what accessors and views must say.
TEST(WriteScene, AccessorsKeepTheRulesOfGltf) {
  const TemporaryFolder folder;
  write_or_fail(full_scene(), folder / "a.gltf");
  const json file = document_of(folder / "a.gltf");
  EXPECT_EQ(file["buffers"][0]["byteLength"], std::filesystem::file_size(folder / "a.bin"));
  std::size_t end = 0;
  for (const json& view : file["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
    EXPECT_GE(view["byteOffset"].get<std::size_t>(), end);
    end = view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>();
  }
  EXPECT_LE(end, file["buffers"][0]["byteLength"].get<std::size_t>());
  const json& primitive = file["meshes"][0]["primitives"][0];
  const json& positions = file["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(positions["min"], (json::array({0.0, 0.0, 0.0})));
  EXPECT_EQ(positions["max"], (json::array({1.0, 1.0, 0.1})));
  const auto target_of = [&](const json& accessor) {
    return file["bufferViews"]
               [file["accessors"][accessor.get<std::size_t>()]["bufferView"].get<std::size_t>()]["target"];
  };
  EXPECT_EQ(target_of(primitive["attributes"]["TANGENT"]), 34962);
  EXPECT_EQ(target_of(primitive["indices"]), 34963);
  EXPECT_EQ(file["accessors"][primitive["indices"].get<std::size_t>()]["componentType"], kU16);
}

TEST(WriteScene, AssimpReadsWhatIsWritten) {
  const TemporaryFolder folder;
  Scene scene = full_scene();
  scene.nodes[0].node_from_instance.clear();
  for (const char* name : {"a.glb", "a.gltf"}) {
    write_or_fail(scene, folder / name);
    Assimp::Importer importer;
    const aiScene* read = importer.ReadFile((folder / name).string(), 0);
    ASSERT_NE(read, nullptr) << importer.GetErrorString();
    EXPECT_EQ(read->mNumMeshes, 1U);
    EXPECT_EQ(read->mMeshes[0]->mNumFaces, 2U);
    EXPECT_EQ(read->mNumCameras, scene.cameras.size());
    EXPECT_EQ(read->mNumLights, scene.lights.size() - 2);  // it knows no measured lamps
  }
}

// What programs see that do not read LATERNA_projector: candela on the axis, within a cone that holds the frame.
TEST(WriteScene, AProjectorIsASpotForOthers) {
  Scene scene;
  Light light;
  light.type = LightType::projector;
  light.color = {2, 1, 0};
  light.intensity = 100;
  light.aspect_from_slide = false;
  light.projection = Projection::perspective(Angle::degrees(90), 2, 0.1, 10);
  light.attenuation = Attenuation::gltf_windowed;
  light.range = 25;
  hang(scene, light, "lantern");
  light.lumens = 3000;  // over 4 × 2 m at 1 m: 375 lx
  light.color = {1, 1, 1};
  light.shadow.resolution = 512;
  hang(scene, light, "bright");
  light.enabled = false;
  hang(scene, light, "off");
  const TemporaryFolder folder;
  write_or_fail(scene, folder / "a.gltf");
  const json lights = document_of(folder / "a.gltf")["extensions"]["KHR_lights_punctual"]["lights"];
  EXPECT_EQ(lights[0]["type"], "spot");
  EXPECT_EQ(lights[0]["color"], (json::array({1.0, 0.5, 0.0})));
  EXPECT_EQ(lights[0]["intensity"], 200);
  EXPECT_EQ(lights[0]["range"], 25);
  EXPECT_NEAR(lights[0]["spot"]["outerConeAngle"].get<double>(), std::atan(std::sqrt(5)), 1e-12);
  EXPECT_NEAR(lights[0]["spot"]["innerConeAngle"].get<double>(), std::atan(1), 1e-12);
  EXPECT_NEAR(lights[1]["intensity"].get<double>(), 375, 1e-10);
  EXPECT_EQ(lights[2]["intensity"], 0);
  const json& projector = lights[1]["extensions"]["LATERNA_projector"];
  EXPECT_NEAR(projector["yfov"].get<double>(), std::acos(0), 1e-15);
  EXPECT_EQ(projector["aspectRatio"], 2);
  EXPECT_EQ(projector["luminousFlux"], 3000);
  EXPECT_EQ(projector["shadow"], (json{{"resolution", 512}}));
}

TEST(WriteScene, PicturesKeepTheirBytes) {
  const TemporaryFolder folder;
  const auto png = image::encode_png(picture(5, 4, PixelType::u8), 1);
  std::filesystem::create_directories(folder.path() / "in" / "my pictures");
  std::filesystem::create_directories(folder.path() / "out");
  folder.write("in/my pictures/a #1.png", png);
  Scene scene;
  Light light;
  light.type = LightType::projector;
  light.slide = 0;
  scene.pictures.emplace_back();
  scene.pictures[0].file = folder / "in/my pictures/a #1.png";
  hang(scene, light, "lantern");
  // Below the scene: named where it is. Elsewhere: beside it.
  write_or_fail(scene, folder / "in/a.gltf");
  EXPECT_EQ(document_of(folder / "in/a.gltf")["images"][0]["uri"], "my%20pictures/a%20%231.png");
  write_or_fail(scene, folder / "out/a.gltf");
  EXPECT_EQ(document_of(folder / "out/a.gltf")["images"][0]["uri"], "a.a%20%231.png");
  EXPECT_EQ(*read_file(folder / "out/a.a #1.png"), png);
  write_or_fail(scene, folder / "out/a.glb");
  const Scene read = load_or_fail({folder / "out/a.glb"});
  EXPECT_TRUE(std::ranges::equal(read.pictures[0].encoded, png));
  for (const char* name : {"in/a.gltf", "out/a.gltf"})
    EXPECT_EQ(lines(reference::differences(scene, load_or_fail({folder / name}))), "") << name;
}

TEST(WriteScene, FilmsAreNamed) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "film");
  std::filesystem::create_directories(folder / "out");
  const auto png = image::encode_png(picture(5, 4, PixelType::u8), 1);
  for (const char* name : {"film/f.001.png", "film/f.002.png"}) folder.write(name, png);
  Scene scene;
  Light light;
  light.type = LightType::projector;
  light.slide = 0;
  scene.pictures.emplace_back();
  scene.pictures[0].file = folder / "film/f.###.png";
  scene.pictures[0].film = FilmTiming{12.5, -3, 0.5, AtEnd::ping_pong};
  hang(scene, light, "cinema");
  const auto warnings = write_scene(scene, folder / "out/a.glb");
  ASSERT_TRUE(warnings) << to_string(warnings.error());
  ASSERT_EQ(warnings->size(), 1U);
  EXPECT_EQ(warnings->front().message,
            "a film is not taken in: the file names it as \"../film/f.%23%23%23.png\"");
  EXPECT_EQ(lines(reference::differences(scene, load_or_fail({folder / "out/a.glb"}))), "");
}

TEST(WriteScene, LampsBecomeLm63) {
  const auto lamp = full_lamp();
  const auto text = write_ies(lamp);
  ASSERT_TRUE(text) << text.error();
  EXPECT_EQ(text->substr(0, 17), "IESNA:LM-63-2002\n");
  // A lamp that is round has one plane; symmetries of EULUMDAT are written out.
  testing_lamps::LdtText quarter;
  quarter.symmetry = 4;
  for (const std::string& file : {testing_lamps::IesText().text(), quarter.text()}) {
    const auto read = read_lamp(std::as_bytes(std::span(file)), "lamp", {});
    ASSERT_TRUE(read) << to_string(read.error());
    const auto again = write_ies(*read);
    EXPECT_TRUE(again) << again.error();
  }
  auto odd = lamp;
  odd.candela.back() = 2;  // where its first plane has 1
  EXPECT_EQ(write_ies(odd).error(), "LM-63 would have other planes of the lamp than it has");
}

TEST(WriteScene, WhatCannotBeCarriedIsTold) {
  Scene scene;
  Light light;
  light.attenuation = Attenuation::custom;
  light.custom_attenuation = [](float) { return 1.0F; };
  hang(scene, light, "odd");
  scene.materials.emplace_back().base_color.x = 2;
  scene.materials[0].emissive_texture = {0, {}, 0, {1, 0.5F, 0, 0, 1, 0}};
  scene.pictures = {pixels(picture(2, 2, PixelType::f32))};
  const TemporaryFolder folder;
  const auto warnings = write_scene(scene, folder / "a.glb");
  ASSERT_TRUE(warnings);
  std::string all;
  for (const Diagnostic& warning : *warnings) all += to_string(warning) + "\n";
  EXPECT_EQ(all,
            "materials[0].base_color: glTF holds 0 to 1: the nearest is written\n"
            "pictures[0]: glTF has no OpenEXR textures: it becomes a PNG of 16 bits\n"
            "materials[0].emissiveTexture: glTF cannot shear texture coordinates: they are left as the mesh "
            "has them\n"
            "lights[0].custom_attenuation: a function cannot be written down: inverse_square is\n");
  load_or_fail({folder / "a.glb"});
}

TEST(WriteScene, RefusesWithAReason) {
  const TemporaryFolder folder;
  const auto message = [](const auto& result) { return result ? std::string() : to_string(result.error()); };
  const std::string obj = (folder / "a.obj").string();
  EXPECT_EQ(message(write_scene({}, obj)),
            obj + ": scenes are written as glTF: the name must end in .glb or .gltf");
  EXPECT_EQ(message(check_scene_output(obj)), message(write_scene({}, obj)));
  Scene scene;
  scene.nodes.emplace_back().mesh = 3;
  EXPECT_EQ(write_scene(scene, folder / "a.glb").error().failure, Failure::bad_usage);
  scene = {};
  scene.pictures.emplace_back().file = folder / "gone.png";
  Light light;
  light.type = LightType::projector;
  light.slide = 0;
  hang(scene, light, "lantern");
  EXPECT_EQ(write_scene(scene, folder / "a.glb").error().failure, Failure::bad_input);
  EXPECT_EQ(write_scene(Scene(), folder / "none/a.glb").error().failure, Failure::cannot_write);
  EXPECT_TRUE(folder.names().empty());
}

// A name that is spelled twice must come to the same, and none may be left in the style of rigs.
TEST(WriteScene, NamesAreSpelledOnce) {
  for (const auto& [rig, own] : kGltfNames.pairs()) {
    EXPECT_EQ(kGltfNames.spelled(own), own);
    EXPECT_EQ(own.find('_'), std::string_view::npos) << own;
    EXPECT_NE(rig, own);
  }
}

}  // namespace
}  // namespace laterna
