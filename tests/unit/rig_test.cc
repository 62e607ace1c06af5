// Rigs: what people type becomes cameras, lights and settings.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/light_color.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

Scene load_rig(const std::string& text, const TemporaryFolder& folder) {
  return load_or_fail({}, {.rigs = {folder.write("rig.json", text)}});
}

Scene load_rig(const std::string& text) {
  const TemporaryFolder folder;
  return load_rig(text, folder);
}

Light load_light(const std::string& keys) {
  const Scene scene = load_rig(R"({"lights": [{)" + keys + "}]}");
  return scene.lights.empty() ? Light{} : scene.lights[0];
}

Camera load_camera(const std::string& keys) {
  const Scene scene = load_rig(R"({"cameras": [{"position": [0,0,5], "target": [0,0,0], )" + keys + "}]}");
  return scene.cameras.empty() ? Camera{} : scene.cameras[0];
}

constexpr const char* kStand = R"("position": [0, 5, 0], "target": [0, 0, -5])";

TEST(Rig, TheExampleOfTheDocumentation) {
  const TemporaryFolder folder;
  folder.write("slide.png", "x");
  const Scene scene = load_rig(R"({
    "ambient": [0.12, 0.13, 0.16],
    "cameras": [{"name": "main", "position": [-10.6, 4, -0.6], "target": [0, 3.4, -0.3], "up": [0, 1, 0], "yfov_deg": 60, "near": 0.1, "far": 60}],
    "lights": [
      {"name": "sun", "type": "directional", "position": [-5, 30, 6.6], "target": [-0.5, 4.5, -0.3], "color": [1, 0.91, 0.77], "lux": 2.2,
       "shadow": {"resolution": 2048}},
      {"name": "magic lantern", "type": "projector", "position": [-8, 5, 1.2], "target": [0.5, 2.6, -3], "yfov_deg": 40, "aspect": 1,
       "slide": "slide.png", "candela": 120, "near": 0.3, "far": 30, "shadow": {"resolution": 1024}}
    ]})",
                               folder);
  EXPECT_EQ(scene.ambient, glm::vec3(0.12F, 0.13F, 0.16F));
  EXPECT_TRUE(scene.ambient_is_set);
  EXPECT_FALSE(scene.background.has_value());
  ASSERT_EQ(scene.cameras.size(), 1U);
  EXPECT_NEAR(scene.cameras[0].projection.top, std::tan(3.14159265358979 / 6), 1e-14);
  EXPECT_EQ(scene.cameras[0].projection.far, 60);
  EXPECT_TRUE(scene.cameras[0].aspect_from_picture);
  ASSERT_EQ(scene.lights.size(), 2U);
  const Light& sun = scene.lights[0];
  EXPECT_EQ(sun.type, LightType::directional);
  EXPECT_EQ(sun.intensity, 2.2);
  EXPECT_EQ(sun.color, glm::vec3(1, 0.91F, 0.77F));
  EXPECT_TRUE(sun.fit);
  EXPECT_EQ(sun.shadow.resolution, 2048);
  const Light& lantern = scene.lights[1];
  EXPECT_EQ(lantern.type, LightType::projector);
  EXPECT_EQ(lantern.intensity, 120);
  EXPECT_FALSE(lantern.aspect_from_slide);
  EXPECT_EQ(lantern.projection.near, 0.3);
  EXPECT_EQ(lantern.attenuation, Attenuation::inverse_square);
  EXPECT_EQ(scene.pictures.at(static_cast<std::size_t>(lantern.slide)).file, folder.path() / "slide.png");
  const int node = find_light_node(scene, "magic lantern");
  ASSERT_GE(node, 0);
  const glm::dmat4& matrix = scene.nodes[static_cast<std::size_t>(node)].parent_from_node;
  EXPECT_EQ(glm::dvec3(matrix[3]), glm::dvec3(-8, 5, 1.2));
  const glm::dvec3 gaze = glm::normalize(glm::dvec3(0.5, 2.6, -3) - glm::dvec3(-8, 5, 1.2));
  EXPECT_LT(glm::distance(-glm::dvec3(matrix[2]), gaze), 1e-15);
}

TEST(Rig, UpIsYUnlessOneLooksAlongIt) {
  const auto up_of = [](const std::string& position, const std::string& more) {
    const Scene scene = load_rig(R"({"cameras": [{"position": )" + position +
                                 R"(, "target": [0,0,0], "yfov_deg": 40)" + more + "}]}");
    return glm::dvec3(scene.nodes.at(0).parent_from_node[1]);
  };
  EXPECT_EQ(up_of("[0, 0, 9]", ""), glm::dvec3(0, 1, 0));
  EXPECT_EQ(up_of("[0, 9, 0]", ""), glm::dvec3(0, 0, -1));  // looking down: like a map
  EXPECT_EQ(up_of("[0, -9, 0]", ""), glm::dvec3(0, 0, 1));  // looking up
  EXPECT_EQ(up_of("[0, 9, 0]", R"(, "up": [1, 0, 0])"), glm::dvec3(1, 0, 0));
}

TEST(Rig, FrustumsOfEveryKind) {
  const Camera by_height = load_camera(R"("yfov_deg": 90, "aspect": 2)");
  EXPECT_NEAR(by_height.projection.top, 1, 1e-15);
  EXPECT_NEAR(by_height.projection.right, 2, 1e-15);
  EXPECT_FALSE(by_height.aspect_from_picture);
  EXPECT_EQ(by_height.projection.near, 0.1);
  EXPECT_TRUE(std::isinf(by_height.projection.far));
  EXPECT_EQ(by_height.name, "camera 1");

  const Camera by_width = load_camera(R"("hfov_deg": 90, "aspect": 2)");
  EXPECT_NEAR(by_width.projection.right, 1, 1e-15);
  EXPECT_NEAR(by_width.projection.top, 0.5, 1e-15);

  const Camera pinhole = load_camera(
      R"("intrinsics": {"fx": 100, "fy": 200, "cx": 49.5, "cy": 99.5, "width": 100, "height": 200})");
  EXPECT_EQ(pinhole.projection.left, -0.5);
  EXPECT_EQ(pinhole.projection.right, 0.5);
  EXPECT_EQ(pinhole.projection.top, 0.5);
  EXPECT_EQ(pinhole.projection.bottom, -0.5);
  EXPECT_FALSE(pinhole.aspect_from_picture);

  const Camera parallel = load_camera(R"("orthographic": {"height": 6}, "far": 20)");
  EXPECT_TRUE(parallel.projection.is_orthographic);
  EXPECT_EQ(parallel.projection.top, 3);
  EXPECT_EQ(parallel.projection.right, 3);
  EXPECT_EQ(parallel.projection.near, 0);
  EXPECT_TRUE(parallel.aspect_from_picture);
}

TEST(Rig, ColoursByTemperatureFilterAndGel) {
  const auto color = [](const std::string& keys) {
    return load_light(R"("type": "point", "position": [1, 2, 3], )" + keys).color;
  };
  EXPECT_EQ(color(R"("color_temperature": 3200)"), color_of_temperature(3200));
  EXPECT_EQ(color(R"("color_temperature": 3200, "filter": [1, 0.5, 0])"),
            color_of_temperature(3200) * glm::vec3(1, 0.5F, 0));
  const Gel* orange = nullptr;
  for (const Gel& gel : list_gels()) orange = gel.name == "full_cto" ? &gel : orange;
  ASSERT_NE(orange, nullptr);
  EXPECT_EQ(color(R"("color": [2, 1, 0.5], "gel": "full_cto")"),
            glm::vec3(2, 1, 0.5F) * transmission(*orange));
}

TEST(Rig, ProjectorsPanels) {
  const Light light = load_light(
      std::string(R"("type": "projector", "yfov_deg": 30, "black_level": 0.0005, "pixels": [1920, 1080], )") +
      kStand);
  EXPECT_EQ(light.black_level, 0.0005);
  EXPECT_EQ(light.panel_width, 1920);
  EXPECT_EQ(light.panel_height, 1080);
}

TEST(Rig, PointLights) {
  const Light plain = load_light(R"("type": "point", "position": [1, 2, 3])");
  EXPECT_EQ(plain.name, "light 1");
  EXPECT_EQ(plain.intensity, 1);
  EXPECT_EQ(plain.attenuation, Attenuation::inverse_square);
  EXPECT_TRUE(plain.enabled);
  const Light windowed =
      load_light(R"("type": "point", "position": [1, 2, 3], "candela": 50, "range": 8, "enabled": false)");
  EXPECT_EQ(windowed.intensity, 50);
  EXPECT_EQ(windowed.attenuation, Attenuation::gltf_windowed);
  EXPECT_EQ(windowed.range, 8);
  EXPECT_FALSE(windowed.enabled);
}

TEST(Rig, AttenuationByName) {
  EXPECT_EQ(load_light(R"("type": "point", "position": [1, 2, 3], "attenuation": "none")").attenuation,
            Attenuation::none);
  EXPECT_EQ(load_light(R"("type": "point", "position": [1, 2, 3], "attenuation": "linear", "range": 5)")
                .attenuation,
            Attenuation::linear);
  EXPECT_EQ(
      load_light(R"("type": "point", "position": [1, 2, 3], "attenuation": "inverse_square")").attenuation,
      Attenuation::inverse_square);
  EXPECT_EQ(
      load_light(R"("type": "point", "position": [1, 2, 3], "attenuation": "gltf_windowed", "range": 5)")
          .range,
      5);
}

TEST(Rig, SpotLights) {
  const Light spot = load_light(
      std::string(R"("type": "spot", "candela": 900, "inner_cone_deg": 10, "outer_cone_deg": 25, )") +
      kStand);
  EXPECT_EQ(spot.type, LightType::spot);
  EXPECT_EQ(spot.inner_cone, Angle::degrees(10));
  EXPECT_EQ(spot.outer_cone, Angle::degrees(25));
  const Light plain = load_light(std::string(R"("type": "spot", )") + kStand);
  EXPECT_EQ(plain.inner_cone, Angle::degrees(0));
  EXPECT_EQ(plain.outer_cone, Angle::degrees(45));
}

TEST(Rig, DirectionalLightsWithTheirOwnBox) {
  const Light sun = load_light(
      std::string(
          R"("type": "directional", "lux": 3, "half_width": 4, "half_height": 2, "near": -1, "far": 30, )") +
      kStand);
  EXPECT_FALSE(sun.fit);
  EXPECT_TRUE(sun.projection.is_orthographic);
  EXPECT_EQ(sun.projection.right, 4);
  EXPECT_EQ(sun.projection.top, 2);
  EXPECT_EQ(sun.projection.near, -1);
  EXPECT_EQ(sun.projection.far, 30);
}

TEST(Rig, Projectors) {
  const TemporaryFolder folder;
  folder.write("slides/cat picture.png", "x");
  const auto load = [&](const std::string& keys) {
    return load_rig(R"({"lights": [{"type": "projector", )" + std::string(kStand) + ", " + keys + "}]}",
                    folder)
        .lights.at(0);
  };
  const Light plain = load(R"("yfov_deg": 30)");
  EXPECT_EQ(plain.slide, -1);
  EXPECT_TRUE(plain.aspect_from_slide);
  EXPECT_EQ(plain.profile, BeamProfile::flat_field);
  EXPECT_EQ(plain.outside, Outside::black);
  EXPECT_EQ(plain.projection.near, 0.1);

  const Light full =
      load(R"("yfov_deg": 30, "slide": "slides/cat picture.png", "lumens": 3000, "profile": "uniform_candela",
                             "outside": "mirror", "attenuation": "none")");
  EXPECT_EQ(full.slide, 0);
  EXPECT_FALSE(full.slide_is_intensity);
  EXPECT_EQ(full.lumens, 3000);
  EXPECT_EQ(full.profile, BeamProfile::uniform_candela);
  EXPECT_EQ(full.outside, Outside::mirror);
  EXPECT_EQ(full.attenuation, Attenuation::none);

  EXPECT_TRUE(load(R"("yfov_deg": 30, "intensity_map": "slides/cat picture.png")").slide_is_intensity);
  EXPECT_FALSE(load(R"("intrinsics": {"fx": 1, "fy": 1, "cx": 0, "cy": 0, "width": 2, "height": 1})")
                   .aspect_from_slide);
  EXPECT_TRUE(load(R"("orthographic": {"height": 2}, "far": 9)").projection.is_orthographic);
  const Light square = load(R"("hfov_deg": 90)");  // neither slide nor aspect: as wide as high
  EXPECT_NEAR(square.projection.top, 1, 1e-15);
  EXPECT_FALSE(square.aspect_from_slide);
}

// A rig is typed by its user: it may name any file, and names are not decoded as in a URL.
TEST(Rig, SlidesMayLieAnywhere) {
  const TemporaryFolder folder;
  const auto slide = folder.write("elsewhere/100%20 cats.png", "x");
  const Scene scene = load_rig(
      R"({"lights": [{"type": "projector", "position": [0, 5, 0], "target": [0, 0, 0], "yfov_deg": 30, "slide": ")" +
          slide.string() + "\"}]}",
      folder);
  ASSERT_EQ(scene.pictures.size(), 1U);
  EXPECT_EQ(scene.pictures[0].file, slide);
}

TEST(Rig, Shadows) {
  const auto shadow_of = [](const std::string& value) {
    return load_light(R"("type": "point", "position": [1, 2, 3], "shadow": )" + value).shadow;
  };
  EXPECT_EQ(shadow_of("true"), ShadowSettings{});
  EXPECT_EQ(shadow_of("{}"), ShadowSettings{});
  EXPECT_EQ(shadow_of("false").technique, ShadowTechnique::none);
  EXPECT_EQ(shadow_of(R"({"technique": "exact"})").technique, ShadowTechnique::exact);
  const ShadowSettings full =
      shadow_of(R"({"technique": "raytraced", "resolution": 16384, "filter": "percentage_closer", "kernel": 9,
      "constant_bias": 0.01, "slope_bias": 1.5, "caster_faces": "back_only", "outside": "shadowed"})");
  EXPECT_EQ(full.technique, ShadowTechnique::raytraced);
  EXPECT_EQ(full.resolution, 16384);
  EXPECT_EQ(full.filter, ShadowFilter::percentage_closer);
  EXPECT_EQ(full.kernel, 9);
  EXPECT_EQ(full.constant_bias, 0.01);
  EXPECT_EQ(full.slope_bias, 1.5);
  EXPECT_EQ(full.caster_faces, CasterFaces::back_only);
  EXPECT_FALSE(full.outside_is_lit);
  EXPECT_EQ(ShadowSettings{}.filter, ShadowFilter::refined);
  EXPECT_EQ(shadow_of(R"({"filter": "refined"})").filter, ShadowFilter::refined);
  EXPECT_EQ(shadow_of(R"({"filter": "nearest"})").filter, ShadowFilter::nearest);
  EXPECT_EQ(shadow_of(R"({"filter": "bilinear"})").filter, ShadowFilter::bilinear);
  EXPECT_EQ(shadow_of(R"({"filter": "percentage_closer"})").kernel, 3);
  EXPECT_EQ(shadow_of(R"({"technique": "map"})").technique, ShadowTechnique::map);
  EXPECT_EQ(
      load_light(
          R"("type": "directional", "position": [1, 2, 3], "target": [0, 0, 0], "shadow": {"warp": "light_space_perspective"})")
          .shadow.warp,
      ShadowWarp::light_space_perspective);
  const ShadowSettings cascades =
      shadow_of(R"({"cascades": 8, "split_lambda": 0, "cascade_distance": 30.5})");
  EXPECT_EQ(cascades.cascades, 8);
  EXPECT_EQ(cascades.split_lambda, 0);
  EXPECT_EQ(cascades.cascade_distance, 30.5);
  EXPECT_EQ(shadow_of(R"({"technique": "none"})").technique, ShadowTechnique::none);
  EXPECT_EQ(shadow_of(R"({"technique": "pcss"})").technique, ShadowTechnique::pcss);
}

TEST(Rig, ShadowDepthsAndMoments) {
  const auto shadow_of = [](const std::string& value) {
    return load_light(R"("type": "point", "position": [1, 2, 3], "shadow": )" + value).shadow;
  };
  const ShadowSettings full = shadow_of(R"({"technique": "variance", "moments": "variance", "blur": 3.5,
      "bleeding_reduction": 0.75, "depth": "radial", "soft_edge": 0.25, "filter": "averaged_depths", "kernel": 5})");
  EXPECT_EQ(full.technique, ShadowTechnique::variance);
  EXPECT_EQ(full.moments, ShadowMoments::variance);
  EXPECT_EQ(full.blur, 3.5F);
  EXPECT_EQ(full.bleeding_reduction, 0.75F);
  EXPECT_EQ(full.depth, ShadowDepth::radial);
  EXPECT_EQ(full.soft_edge, 0.25);
  EXPECT_EQ(full.filter, ShadowFilter::averaged_depths);
  EXPECT_EQ(full.kernel, 5);
  EXPECT_EQ(shadow_of(R"({"moments": "exponential"})"), ShadowSettings{});
}

TEST(Rig, Settings) {
  const Scene scene =
      load_rig(R"({"background": [0.5, 0.25, 0], "shading": {"specular": 0.5, "shininess": 20}})");
  EXPECT_EQ(scene.background, glm::vec3(0.5F, 0.25F, 0));
  EXPECT_FALSE(scene.ambient_is_set);
  ASSERT_TRUE(scene.phong.has_value());
  EXPECT_EQ(scene.phong->specular, 0.5F);
  EXPECT_EQ(scene.phong->shininess, 20);
}

TEST(Rig, NodesOfTheSceneAreChangedByName) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  builder.document["nodes"][0]["name"] = "wall";
  builder.add("nodes", {{"name", "roof"}, {"children", {2}}});
  builder.add("nodes", {{"name", "tiles"}, {"mesh", 0}});
  builder.add("meshes", builder.document["meshes"][0]);
  builder.document["meshes"][1]["name"] = "lawn";
  builder.add("nodes", {{"mesh", 1}});
  const auto scene_file = folder.write("scene.gltf", builder.text());
  const auto rig = folder.write("rig.json", R"({"nodes": [{"name": "wall", "casts_shadow": false},
      {"name": "roof", "visible": false}, {"name": "tiles", "receives_shadow": false}, {"name": "lawn", "casts_shadow": false}]})");
  const Scene scene = load_or_fail({scene_file}, {.rigs = {rig}});
  EXPECT_FALSE(scene.nodes[0].casts_shadow);
  EXPECT_TRUE(scene.nodes[0].visible);
  EXPECT_FALSE(scene.nodes[1].visible);
  EXPECT_FALSE(scene.nodes[2].visible);  // below the roof
  EXPECT_FALSE(scene.nodes[2].receives_shadow);
  EXPECT_TRUE(scene.nodes[2].casts_shadow);
  EXPECT_FALSE(scene.nodes[3].casts_shadow);  // found by its mesh's name
}

TEST(Rig, AJsonFileAmongTheScenesIsARig) {
  const TemporaryFolder folder;
  const Scene scene = load_or_fail(
      {folder.write("scene.gltf", triangle_builder().text()),
       folder.write("lights.json", R"({"lights": [{"type": "point", "position": [0, 1, 0]}]})")});
  EXPECT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.meshes.size(), 1U);
}

TEST(Rig, GeneratedNamesAvoidWrittenOnes) {
  const Scene scene = load_rig(R"({"lights": [{"type": "point", "position": [0, 1, 0]},
                                              {"type": "point", "position": [0, 1, 0], "name": "light 1"}]})");
  EXPECT_EQ(scene.lights[0].name, "light 1.2");
  EXPECT_EQ(scene.lights[1].name, "light 1");
  EXPECT_EQ(scene.nodes[0].name, "light 1.2");
}

TEST(Rig, AFrustumIsItsFourSides) {
  const std::string sides = R"("frustum": {"left": -0.5, "right": 0.25, "bottom": -0.1, "top": 0.4})";
  const Camera camera = load_camera(sides + R"(, "near": 0.2)");
  EXPECT_FALSE(camera.aspect_from_picture);
  EXPECT_EQ(camera.projection.left, -0.5);
  EXPECT_EQ(camera.projection.right, 0.25);
  EXPECT_EQ(camera.projection.bottom, -0.1);
  EXPECT_EQ(camera.projection.top, 0.4);
  EXPECT_EQ(camera.projection.near, 0.2);
  EXPECT_FALSE(camera.projection.is_orthographic);
  const std::string projector = std::string(R"("type": "projector", )") + kStand + ", ";
  EXPECT_FALSE(load_light(projector + sides).aspect_from_slide);
  EXPECT_TRUE(load_light(projector + sides + R"(, "aspect_from_slide": true)").aspect_from_slide);
  const std::string parallel =
      R"("frustum": {"left": -5, "right": 2, "bottom": -1, "top": 4, "parallel": true}, "near": -3, "far": 7)";
  const Projection box = load_light(projector + parallel).projection;
  EXPECT_TRUE(box.is_orthographic);
  EXPECT_EQ(box.left, -5);
  EXPECT_EQ(box.near, -3);
  const Light window =
      load_light(std::string(R"("type": "directional", )") + kStand +
                 R"(, "frustum": {"left": -5, "right": 2, "bottom": -1, "top": 4}, "far": 9)");
  EXPECT_FALSE(window.fit);
  EXPECT_TRUE(window.projection.is_orthographic);
  EXPECT_EQ(window.projection.right, 2);
}

}  // namespace
}  // namespace laterna
