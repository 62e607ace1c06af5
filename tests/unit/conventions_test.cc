// One test per sentence of docs/conventions.md, named by its number.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <regex>
#include <set>

#include "laterna/lamps.h"
#include "laterna/light_color.h"
#include "laterna/measure.h"
#include "laterna/render.h"
#include "reference/projector_scenes.h"
#include "reference/shapes.h"
#include "shade/sample_offsets.h"
#include "shadow/depth_comparison.h"
#include "unit/scene_test_files.h"

namespace laterna {
namespace {

using reference::add_light;
using reference::add_object;
using reference::at;
using reference::make_renderer;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kPi = std::numbers::pi;

// ------------------------------------------------------------------------------------------------ small scenes

// A white wall square-on to +Z at z = 0, four metres wide and high.
Scene wall_scene() {
  Scene scene;
  add_object(scene, "wall", reference::wall(2, 2, 0));
  scene.ambient_is_set = true;
  return scene;
}

// Sees the wall fill the picture, without perspective.
View wall_view() { return reference::square_on(2, 1); }

RenderSettings settings_of(int side, ShadingModel model, std::vector<Layer> layers = {}) {
  RenderSettings settings = reference::test_settings(side, side);
  settings.shading = model;
  settings.layers = std::move(layers);
  return settings;
}

LayeredImage draw(Scene scene, const View& view, const RenderSettings& settings) {
  return reference::render(make_renderer(std::move(scene)), view, settings);
}

// Illuminance on the wall under one light, in a picture of `side` pixels.
LayeredImage draw_lux(Scene scene, int side) {
  return draw(std::move(scene), wall_view(), settings_of(side, ShadingModel::phong, {Layer::lux}));
}

Light light_of(LightType type, double intensity) {
  Light light;
  light.name = "light";
  light.type = type;
  light.intensity = intensity;
  return light;
}

// A projector 5 m in front of the wall, whose square frame is the whole wall.
Light wall_projector(int slide = -1) {
  Light light = reference::projector("light", 0.4, 0.4, slide);
  light.intensity = 25;  // 1 lux on the wall
  return light;
}

Scene projected_wall(Light light) {
  Scene scene = wall_scene();
  add_light(scene, std::move(light), {0, 0, 5}, {0, 0, 0});
  return scene;
}

// World coordinates of a pixel's centre on the wall.
double wall_position(int pixel, int side) { return (pixel + 0.5) / side * 4 - 2; }

// ------------------------------------------------------------------------------------------------ space

TEST(Conventions, S1_TheWorldIsRightHanded) {
  Scene scene;
  add_object(scene, "right", reference::wall(0.5F, 0.5F, 0));
  scene.nodes.back().parent_from_node[3] = {2, 0, 0, 1};
  add_object(scene, "up", reference::wall(0.5F, 0.5F, 0));
  scene.nodes.back().parent_from_node[3] = {0, 2, 0, 1};
  View view;  // the pose of an identity matrix: at the origin, looking along −Z
  view.pose.position_ws = {0, 0, 10};
  view.projection = Projection::orthographic(3, 3, 0.1, 100);
  const LayeredImage image = draw(scene, view, settings_of(30, ShadingModel::papers, {Layer::object}));
  EXPECT_EQ(at(image, "id.object", 25, 15), 0);  // +X is on the right
  EXPECT_EQ(at(image, "id.object", 15, 5), 1);   // +Y is at the top
  const Pose pose = Pose::look_at({1, 2, 3}, {-4, 5, 0}, {0, 1, 0}).value();
  EXPECT_NEAR(glm::length(glm::cross(pose.right_ws(), pose.up_ws()) + pose.forward_ws()), 0, 1e-14);
}

TEST(Conventions, S2_LengthsAreMetres) {
  Scene scene = wall_scene();
  add_light(scene, light_of(LightType::point, 1), {0, 0, 1}, {0, 0, 0});
  // One candela gives one lux at one metre, and a quarter at two.
  EXPECT_NEAR(at(draw_lux(scene, 401), "lux.Y", 200, 200), 1, 1e-6);
  scene.nodes.back().parent_from_node[3].z = 2;
  EXPECT_NEAR(at(draw_lux(scene, 401), "lux.Y", 200, 200), 0.25, 1e-6);
}

TEST(Conventions, S3_PlusYIsUpUnlessAFileIsReadWithPlusZUp) {
  const TemporaryFolder folder;
  const auto file = folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  const auto highest = [&](LoadOptions::Up up) {
    LoadOptions options;
    options.up = up;
    const Scene scene = testing_scenes::load_or_fail({file}, options);
    const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene);
    glm::dvec3 high(-kInfinity);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
      if (scene.nodes[i].mesh < 0) continue;
      for (const Primitive& p : scene.meshes[static_cast<std::size_t>(scene.nodes[i].mesh)].primitives) {
        for (const glm::vec3 v : p.positions) {
          high = glm::max(high, glm::dvec3(world_from_node[i] * glm::dvec4(v, 1)));
        }
      }
    }
    return high;
  };
  EXPECT_EQ(highest(LoadOptions::Up::y), glm::dvec3(1, 0, 1));
  const glm::dvec3 turned = highest(LoadOptions::Up::z);
  EXPECT_NEAR(turned.x, 1, 1e-6);
  EXPECT_NEAR(turned.y, 1, 1e-6);
  EXPECT_NEAR(turned.z, 0, 1e-6);
}

TEST(Conventions, S4_CamerasAndLightsLookDownTheirOwnMinusZ) {
  const Pose pose = Pose::from_matrix(glm::dmat4(1.0)).value();
  EXPECT_EQ(pose.forward_ws(), glm::dvec3(0, 0, -1));
  EXPECT_EQ(pose.right_ws(), glm::dvec3(1, 0, 0));
  EXPECT_EQ(pose.up_ws(), glm::dvec3(0, 1, 0));
  // A light on a node without rotation, five metres in front of the wall, lights it.
  Scene scene = wall_scene();
  scene.lights.push_back(light_of(LightType::directional, 3));
  Node node;
  node.light = 0;
  node.parent_from_node[3] = {0, 0, 5, 1};
  scene.nodes.push_back(node);
  EXPECT_FLOAT_EQ(at(draw_lux(scene, 8), "lux.Y", 4, 4), 3);
}

TEST(Conventions, S5_NodeScaleChangesNeitherFieldNorConeNorBrightness) {
  Scene scene = wall_scene();
  Light spot = light_of(LightType::spot, 50);
  spot.outer_cone = Angle::degrees(15);
  add_light(scene, spot, {0, 0, 5}, {0, 0, 0});
  scene.cameras.push_back({"camera", Projection::perspective(Angle::degrees(50), 1, 0.1, 100), true});
  Node camera;
  camera.camera = 0;
  camera.parent_from_node = Pose::look_at({1, 1, 6}, {0, 0, 0}, {0, 1, 0})->world_from_view();
  scene.nodes.push_back(camera);
  const auto picture = [&](double scale) {
    Scene scaled = scene;
    for (std::size_t i = 1; i < scaled.nodes.size(); ++i) {
      for (int column = 0; column < 3; ++column) scaled.nodes[i].parent_from_node[column] *= scale;
    }
    const Renderer renderer = make_renderer(std::move(scaled));
    const View view = renderer.camera_view("camera", 24, 24).value();
    return reference::render(renderer, view, settings_of(24, ShadingModel::phong)).channels[0].values;
  };
  const std::vector<float> plain = picture(1);
  EXPECT_GT(*std::max_element(plain.begin(), plain.end()), 1);
  EXPECT_EQ(picture(4), plain);  // a power of two, so that not even rounding differs
}

TEST(Conventions, S6_AnglesAreRadiansInGltfAndDegreesInRigs) {
  EXPECT_DOUBLE_EQ(Angle::degrees(180).in_radians(), kPi);
  EXPECT_DOUBLE_EQ(Angle::radians(kPi / 3).in_degrees(), 60);
  const TemporaryFolder folder;
  const auto gltf =
      folder.write("camera.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
      "nodes": [{"camera": 0}], "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}]})");
  const auto rig =
      folder.write("rig.json", R"({"cameras": [{"name": "main", "position": [0, 0, 5], "target": [0, 0, 0],
      "yfov_deg": 28.64788975654116}]})");
  LoadOptions options;
  options.rigs = {rig};
  const Scene scene = testing_scenes::load_or_fail({gltf}, options);
  ASSERT_EQ(scene.cameras.size(), 2U);
  for (const Camera& camera : scene.cameras) EXPECT_NEAR(camera.projection.yfov().in_radians(), 0.5, 1e-12);
}

TEST(Conventions, S7_TheFrontIsCounterClockwise) {
  Scene scene;
  reference::Mesher mesh;
  mesh.triangle({-9, -9, 0}, {9, -9, 0}, {0, 9, 0});  // counter-clockwise seen from +Z
  add_object(scene, "triangle", mesh.primitive);
  const auto is_seen = [&](double z) {
    const LayeredImage image = draw(scene, reference::look({0, 0, z}, {0, 0, 0}, 30, 1),
                                    settings_of(8, ShadingModel::papers, {Layer::object}));
    return at(image, "id.object", 4, 4) == 0;
  };
  EXPECT_TRUE(is_seen(5));
  EXPECT_FALSE(is_seen(-5));
  scene.materials[0].double_sided = true;
  EXPECT_TRUE(is_seen(-5));
}

TEST(Conventions, S8_ANodesMatrixTakesItsPointsToItsParent) {
  Scene scene;
  Node child;
  child.parent = 1;
  child.parent_from_node[3] = {1, 0, 0, 1};
  Node parent;  // turns +X to +Y
  parent.parent_from_node[0] = {0, 1, 0, 0};
  parent.parent_from_node[1] = {-1, 0, 0, 0};
  parent.parent_from_node[3] = {0, 0, 7, 1};
  scene.nodes = {child, parent};
  EXPECT_EQ(world_from_nodes(scene)[0] * glm::dvec4(2, 0, 0, 1), glm::dvec4(0, 3, 7, 1));
}

// ------------------------------------------------------------------------------------------------ matrices

View oblique_view() { return reference::look({1, 2, 3}, {-2, 0, -4}, 50, 1.5, {0, 1, 0}, 0.5, 40); }

TEST(Conventions, M1_MatricesAreNamedDestinationFromSource) {
  const View view = oblique_view();
  const glm::dvec4 point_ws(0.3, -1, -2, 1);
  const glm::dvec4 in_steps = view.clip_from_view() * (view.view_from_world() * point_ws);
  EXPECT_LT(glm::distance(view.clip_from_world() * point_ws, in_steps), 1e-13);
  // The eye is the origin of its own space, and what it looks at is on its −Z.
  EXPECT_LT(glm::length(glm::dvec3(view.view_from_world() * glm::dvec4(1, 2, 3, 1))), 1e-13);
  const glm::dvec4 target_vs = view.view_from_world() * glm::dvec4(-2, 0, -4, 1);
  EXPECT_NEAR(target_vs.x, 0, 1e-13);
  EXPECT_NEAR(target_vs.y, 0, 1e-13);
  EXPECT_NEAR(target_vs.z, -std::sqrt(9 + 4 + 49), 1e-13);
}

TEST(Conventions, M2_ClipSpaceIsOpenGLs) {
  const View view = oblique_view();
  const Projection& p = view.projection;
  for (const double distance : {p.near, p.far}) {
    for (const double x : {p.left, p.right}) {
      for (const double y : {p.bottom, p.top}) {
        const glm::dvec4 clip = view.clip_from_view() * glm::dvec4(x * distance, y * distance, -distance, 1);
        EXPECT_NEAR(clip.x / clip.w, x == p.left ? -1 : 1, 1e-12);
        EXPECT_NEAR(clip.y / clip.w, y == p.bottom ? -1 : 1, 1e-12);
        EXPECT_NEAR(clip.z / clip.w, distance == p.near ? -1 : 1, 1e-12);
      }
    }
  }
}

TEST(Conventions, M3_WIsTheDistanceAlongTheAxisOrOne) {
  View view = oblique_view();
  const glm::dvec4 point = glm::dvec4(view.pose.position_ws + 7.0 * view.pose.forward_ws() +
                                          2.0 * view.pose.right_ws() - 3.0 * view.pose.up_ws(),
                                      1);
  EXPECT_NEAR((view.clip_from_world() * point).w, 7, 1e-13);
  view.projection = Projection::orthographic(2, 2, 1, 9);
  EXPECT_EQ((view.clip_from_world() * point).w, 1);
}

TEST(Conventions, M4_TheFarPlaneMayBeInfinitelyFar) {
  View view;
  view.projection = Projection::perspective(Angle::degrees(60), 1, 0.1, kInfinity);
  EXPECT_EQ(find_fault(view.projection), "");
  const glm::dvec4 clip = view.clip_from_view() * glm::dvec4(0, 0, -1e9, 1);
  EXPECT_NEAR(clip.z / clip.w, 1, 1e-9);
  EXPECT_LE(clip.z, clip.w);
  view.projection = Projection::orthographic(1, 1, 0.1, kInfinity);
  EXPECT_EQ(find_fault(view.projection), "an orthographic view needs a finite far distance");
}

TEST(Conventions, M5_ImageCoordinatesAreCountedFromTheTopLeftCorner) {
  const View view = oblique_view();
  const Projection& p = view.projection;
  const auto image_of = [&](double x, double y, double distance) {
    const glm::dvec4 world =
        view.pose.world_from_view() * glm::dvec4(x * distance, y * distance, -distance, 1);
    const glm::dvec4 image = view.image_from_world() * world;
    return glm::dvec3(image) / image.w;
  };
  EXPECT_LT(glm::distance(image_of(p.left, p.top, p.near), glm::dvec3(0, 0, 0)), 1e-12);
  EXPECT_LT(glm::distance(image_of(p.right, p.bottom, p.far), glm::dvec3(1, 1, 1)), 1e-12);
}

TEST(Conventions, M6_YfovIsTheWholeVerticalAngle) {
  const Projection p = Projection::perspective(Angle::degrees(90), 2, 0.1, 10);
  EXPECT_NEAR(p.top, 1, 1e-15);
  EXPECT_NEAR(p.bottom, -1, 1e-15);
  EXPECT_NEAR(p.right, 2, 1e-15);
  EXPECT_NEAR(p.aspect(), 2, 1e-15);
  EXPECT_NEAR(p.yfov().in_degrees(), 90, 1e-12);
}

TEST(Conventions, M7_IntrinsicsAreOpenCvs) {
  // cv::projectPoints: u = fx x/z + cx, v = fy y/z + cy, with y down and z ahead.
  const double fx = 500, fy = 400, cx = 300, cy = 250;
  View view;
  view.projection = Projection::from_intrinsics(fx, fy, cx, cy, 640, 480, 0.1, 100);
  const glm::dvec3 point_cv(0.4, -0.3, 2);
  const glm::dvec2 centre(fx * point_cv.x / point_cv.z + cx, fy * point_cv.y / point_cv.z + cy);
  const glm::dvec4 image = view.image_from_world() * glm::dvec4(point_cv.x, -point_cv.y, -point_cv.z, 1);
  // Centres of pixels are at whole numbers there and half a pixel farther here.
  EXPECT_NEAR(image.x / image.w * 640, centre.x + 0.5, 1e-9);
  EXPECT_NEAR(image.y / image.w * 480, centre.y + 0.5, 1e-9);
}

// ------------------------------------------------------------------------------------------------ pictures

TEST(Conventions, P1_RowZeroIsTheTopRow) {
  // Only the upper half of the wall is there.
  Scene scene;
  add_object(scene, "upper", reference::wall(2, 1, 0));
  scene.nodes[0].parent_from_node[3].y = 1;
  scene.ambient = glm::vec3(1);
  scene.ambient_is_set = true;
  const LayeredImage image = draw(scene, wall_view(), settings_of(4, ShadingModel::papers));
  EXPECT_EQ(at(image, "R", 1, 0), 1);
  EXPECT_EQ(at(image, "R", 1, 3), 0);
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "a.exr", "a.hdr", "a.pfm"}) {
    ASSERT_TRUE(write_image(image, folder.path() / name).has_value()) << name;
    const Result<Image> read = read_image(folder.path() / name);
    ASSERT_TRUE(read.has_value()) << name;
    EXPECT_EQ(read->value(1, 0, 0), 1) << name;
    EXPECT_EQ(read->value(1, 3, 0), 0) << name;
  }
}

TEST(Conventions, P2_PixelsAreSquaresWithTheirCentresAtHalves) {
  // The wall covers [0.5, 1.5) pixels: the centres at 0.5 and, by the top-left rule, not the one at 1.5.
  Scene scene;
  reference::Mesher mesh;
  mesh.quad({-1.75F, -2, 0}, {-1.25F, -2, 0}, {-1.25F, 2, 0}, {-1.75F, 2, 0});
  add_object(scene, "strip", mesh.primitive);
  const LayeredImage image =
      draw(scene, wall_view(), settings_of(8, ShadingModel::papers, {Layer::position}));
  const auto is_covered = [&](int x) { return at(image, "A", x, 3) == 1; };
  EXPECT_TRUE(is_covered(0));
  EXPECT_FALSE(is_covered(1));
  EXPECT_FLOAT_EQ(at(image, "P.X", 0, 3), -1.75F);
  Scene lit = projected_wall(wall_projector());
  const PointReport report =
      inspect_point(make_renderer(std::move(lit)), wall_view(), 8, 8, "light", {-1.75, 1.75, 0}).value();
  EXPECT_NEAR(report.pixel.x, 0.5, 1e-12);
  EXPECT_NEAR(report.pixel.y, 0.5, 1e-12);
}

// Four quarters of different linear red: top left, top right, bottom left, bottom right.
constexpr std::array<float, 4> kQuarters = {0.1F, 0.2F, 0.3F, 0.4F};
glm::vec3 quarter(int x, int y, int side) {
  return glm::vec3(kQuarters[static_cast<std::size_t>((y * 2 / side) * 2 + x * 2 / side)]);
}

void expect_quarters(const LayeredImage& image) {
  const int low = image.width / 4;
  const int high = image.width * 3 / 4;
  EXPECT_NEAR(at(image, "R", low, low), kQuarters[0], 1e-6);
  EXPECT_NEAR(at(image, "R", high, low), kQuarters[1], 1e-6);
  EXPECT_NEAR(at(image, "R", low, high), kQuarters[2], 1e-6);
  EXPECT_NEAR(at(image, "R", high, high), kQuarters[3], 1e-6);
}

TEST(Conventions, P3_TextureCoordinatesAreCountedFromTheTopLeftCorner) {
  Scene scene;
  Primitive wall = reference::wall(2, 2, 0);
  wall.uv[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};  // bottom left, bottom right, top right, top left
  add_object(scene, "wall", wall);
  scene.materials[0].base_color_texture.picture =
      reference::add_linear_picture(scene, 16, 16, [](int x, int y) { return quarter(x, y, 16); });
  scene.ambient = glm::vec3(1);
  scene.ambient_is_set = true;
  ASSERT_EQ(scene.meshes[0].primitives[0].positions[0], glm::vec3(-2, -2, 0));
  ASSERT_EQ(scene.meshes[0].primitives[0].positions[2], glm::vec3(2, 2, 0));
  expect_quarters(draw(scene, wall_view(), settings_of(16, ShadingModel::papers)));
}

TEST(Conventions, P4_SamplesLieInDirect3DsStandardPatterns) {
  // D3D11_STANDARD_MULTISAMPLE_PATTERN, in sixteenths of a pixel from its centre; the order does not matter.
  const auto offsets = [](int count) {
    std::set<std::pair<int, int>> all;
    for (const shade::SampleOffset& o : shade::sample_offsets(count, {})) all.insert({o.x, o.y});
    return all;
  };
  const auto sixteenths = [](const std::set<std::pair<int, int>>& pattern) {
    std::set<std::pair<int, int>> all;
    for (const auto& [x, y] : pattern) all.insert({16 * x, 16 * y});
    return all;
  };
  EXPECT_EQ(offsets(1), sixteenths({{0, 0}}));
  EXPECT_EQ(offsets(2), sixteenths({{4, 4}, {-4, -4}}));
  EXPECT_EQ(offsets(4), sixteenths({{-2, -6}, {6, -2}, {-6, 2}, {2, 6}}));
  EXPECT_EQ(offsets(8), sixteenths({{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}}));
  // clang-format off
  EXPECT_EQ(offsets(16), sixteenths({{1, 1}, {-1, -3}, {-3, 2}, {4, -1}, {-5, -2}, {2, 5}, {5, 3}, {3, -5},
                                     {-2, 6}, {0, -7}, {-4, -6}, {-6, 4}, {-8, 0}, {7, -4}, {6, 7}, {-7, -8}}));
  // clang-format on
}

TEST(Conventions, P5_ColoursOfAnImageAreNotMultipliedByAlpha) {
  const TemporaryFolder folder;
  Image image(2, 1, 4, PixelType::u8, Transfer::srgb);
  const std::array<std::uint8_t, 8> pixels = {200, 100, 50, 0, 200, 100, 50, 128};
  std::copy(pixels.begin(), pixels.end(), image.values<std::uint8_t>().begin());
  ASSERT_TRUE(write_image(image, folder.path() / "a.png").has_value());
  const Image read = read_image(folder.path() / "a.png").value();
  const auto values = read.values<std::uint8_t>();
  EXPECT_TRUE(std::equal(values.begin(), values.end(), pixels.begin(), pixels.end()));
}

// The left quarter of each pixel is covered, by the colour 0.8.
LayeredImage quarter_covered() {
  Scene scene;
  reference::Mesher mesh;
  for (int x = 0; x < 4; ++x) {
    const auto left = static_cast<float>(x) - 2;
    mesh.quad({left, -2, 0}, {left + 0.25F, -2, 0}, {left + 0.25F, 2, 0}, {left, 2, 0});
  }
  add_object(scene, "strips", mesh.primitive, glm::vec3(0.8F));
  scene.ambient = glm::vec3(1);
  scene.ambient_is_set = true;
  RenderSettings settings = settings_of(4, ShadingModel::papers);
  settings.samples = 16;
  return draw(scene, wall_view(), settings);
}

TEST(Conventions, P6_AIsCoverageAndColoursAreMultipliedByIt) {
  const LayeredImage image = quarter_covered();
  EXPECT_EQ(at(image, "A", 2, 2), 0.25F);
  EXPECT_NEAR(at(image, "R", 2, 2), 0.2F, 1e-7);
}

TEST(Conventions, P7_ColoursOfPngFilesAreDividedByAlpha) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_image(quarter_covered(), folder.path() / "a.png").has_value());
  const Image read = read_image(folder.path() / "a.png").value();
  ASSERT_EQ(read.channels(), 4);
  EXPECT_EQ(read.value(2, 2, 3), 64 / 255.0F);
  EXPECT_EQ(read.value(2, 2, 0), 231 / 255.0F);  // sRGB of 0.8
}

// ------------------------------------------------------------------------------------------------ colour

double srgb_to_linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

int grey_picture(Scene& scene, int code) {
  return reference::add_picture(scene, 4, 4,
                                [code](int, int) { return glm::u8vec3(static_cast<std::uint8_t>(code)); });
}

TEST(Conventions, C1_ColourIsLinearLightBetweenReadingAndWriting) {
  // Two slides of sRGB code 188, half of the light each, make white.
  Scene scene = wall_scene();
  const int slide = grey_picture(scene, 188);
  for (const char* name : {"a", "b"}) {
    Light light = wall_projector(slide);
    light.name = name;
    add_light(scene, light, {0, 0, 5}, {0, 0, 0});
  }
  const Renderer renderer = make_renderer(std::move(scene));
  std::array<std::uint8_t, 16 * 3> pixels{};
  RenderTarget target;
  target.color8 = {pixels.data(), 3, 12, 1};
  ASSERT_TRUE(renderer.render_into(wall_view(), settings_of(4, ShadingModel::papers), target).has_value());
  EXPECT_EQ(pixels[5 * 3], 255);
}

TEST(Conventions, C2_BaseColoursEmissiveTexturesAndSlidesAreSrgb) {
  const double expected = srgb_to_linear(100 / 255.0);
  Scene slide = wall_scene();
  const int picture = grey_picture(slide, 100);
  add_light(slide, wall_projector(picture), {0, 0, 5}, {0, 0, 0});
  EXPECT_NEAR(at(draw(slide, wall_view(), settings_of(4, ShadingModel::papers)), "R", 2, 2), expected, 4e-4);
  Scene base = wall_scene();
  base.materials[0].base_color_texture.picture = grey_picture(base, 100);
  base.ambient = glm::vec3(1);
  EXPECT_NEAR(at(draw(base, wall_view(), settings_of(4, ShadingModel::papers)), "R", 2, 2), expected, 4e-4);
  Scene emissive = wall_scene();
  emissive.materials[0].emissive = glm::vec3(1);
  emissive.materials[0].emissive_texture.picture = grey_picture(emissive, 100);
  EXPECT_NEAR(at(draw(emissive, wall_view(), settings_of(4, ShadingModel::papers)), "R", 2, 2), expected,
              4e-4);
}

TEST(Conventions, C3_DataTexturesAndIntensityMapsAreLinear) {
  const double expected = 100 / 255.0;
  Scene map = wall_scene();
  Light light = wall_projector(grey_picture(map, 100));
  light.slide_is_intensity = true;
  add_light(map, light, {0, 0, 5}, {0, 0, 0});
  EXPECT_NEAR(at(draw(map, wall_view(), settings_of(4, ShadingModel::papers)), "R", 2, 2), expected, 1e-6);

  Scene occlusion = wall_scene();
  occlusion.materials[0].occlusion_texture.picture = grey_picture(occlusion, 100);
  occlusion.ambient = glm::vec3(1);
  EXPECT_NEAR(at(draw(occlusion, wall_view(), settings_of(4, ShadingModel::papers)), "R", 2, 2), expected,
              1e-6);

  // Blue is metallic: of the diffuse light of phong, the rest remains.
  Scene metallic = wall_scene();
  metallic.materials[0].metallic = 1;
  metallic.materials[0].metallic_roughness_texture.picture =
      reference::add_picture(metallic, 4, 4, [](int, int) { return glm::u8vec3(0, 255, 100); });
  metallic.materials[0].base_color = {0, 0.5F, 0, 1};
  metallic.phong = PhongHighlight{};
  add_light(metallic, light_of(LightType::directional, 1), {0, 0, 5}, {0, 0, 0});
  const auto green = [&](const Scene& scene) {
    return at(draw(scene, wall_view(), settings_of(4, ShadingModel::pbr)), "G", 2, 2);
  };
  Scene factor = metallic;
  factor.materials[0].metallic_roughness_texture = {};
  factor.materials[0].metallic = 100 / 255.0F;
  EXPECT_NEAR(green(metallic), green(factor), 1e-6);

  // A normal of (153, 128, 230)/255: linear, so that its x is 0.2 and its z 0.8.
  Scene bent = wall_scene();
  bent.meshes[0].primitives[0].uv[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  bent.materials[0].normal_texture.picture =
      reference::add_picture(bent, 4, 4, [](int, int) { return glm::u8vec3(153, 128, 230); });
  const LayeredImage normals = draw(bent, wall_view(), settings_of(4, ShadingModel::phong, {Layer::normal}));
  const glm::dvec3 n = glm::normalize(glm::dvec3(153, 128, 230) / 127.5 - 1.0);
  EXPECT_NEAR(at(normals, "N.X", 2, 2), n.x, 1e-5);
  EXPECT_NEAR(at(normals, "N.Z", 2, 2), n.z, 1e-5);
}

TEST(Conventions, C4_HdrExrAndPfmFilesHoldLinearLight) {
  const TemporaryFolder folder;
  LayeredImage image;
  image.width = image.height = 1;
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, {0.25F}});
  for (const char* name : {"a.hdr", "a.exr", "a.pfm"}) {
    ASSERT_TRUE(write_image(image, folder.path() / name).has_value()) << name;
    const Image read = read_image(folder.path() / name).value();
    EXPECT_EQ(read.transfer(), Transfer::linear) << name;
    EXPECT_EQ(read.value(0, 0, 0), 0.25F) << name;
  }
}

TEST(Conventions, C5_SrgbIsTheCurveOfIec61966) {
  const TemporaryFolder folder;
  LayeredImage image;
  image.width = 4;
  image.height = 1;
  // On the straight part, near its end, in the middle, and white.
  image.channels.push_back({"Y", {0.001F, 0.0031308F, 0.5F, 1}});
  WriteOptions options;
  options.depth = WriteOptions::Depth::bits16;
  ASSERT_TRUE(write_image(image, folder.path() / "a.png", options).has_value());
  const Image read = read_image(folder.path() / "a.png").value();
  EXPECT_NEAR(read.value(0, 0, 0), 12.92 * 0.001, 1e-5);
  EXPECT_NEAR(read.value(1, 0, 0), 0.04045, 1e-5);
  EXPECT_NEAR(read.value(2, 0, 0), 1.055 * std::pow(0.5, 1 / 2.4) - 0.055, 1e-5);
  EXPECT_EQ(read.value(3, 0, 0), 1);
}

TEST(Conventions, C6_FactorsAndColoursInNumbersAreLinear) {
  Scene scene = wall_scene();
  scene.materials[0].base_color = glm::vec4(0.5F, 0.5F, 0.5F, 1);
  scene.meshes[0].primitives[0].colors.assign(4, glm::vec4(0.5F, 0.5F, 0.5F, 1));
  scene.ambient = glm::vec3(0.5F);
  scene.background = glm::vec3(0.3F);
  Light light = wall_projector();
  light.color = glm::vec3(0.25F);
  add_light(scene, light, {0, 0, 5}, {0, 0, 0});
  const View wide = reference::square_on(4, 1);
  const LayeredImage image = draw(scene, wide, settings_of(8, ShadingModel::papers));
  EXPECT_NEAR(at(image, "R", 4, 4), 0.5 * 0.5 * (0.5 + 0.25), 1e-7);
  EXPECT_EQ(at(image, "R", 0, 0), 0.3F);
}

TEST(Conventions, C7_ExposureIsAFactorOnLinearLightOfEncodedFiles) {
  const TemporaryFolder folder;
  LayeredImage image;
  image.width = image.height = 1;
  image.channels.push_back({"Y", {0.125F}});
  WriteOptions options;
  options.exposure = 4;
  ASSERT_TRUE(write_image(image, folder.path() / "a.png", options).has_value());
  EXPECT_EQ(read_image(folder.path() / "a.png")->value(0, 0, 0), 188 / 255.0F);  // sRGB of 0.5
  ASSERT_TRUE(write_image(image, folder.path() / "a.exr", options).has_value());
  EXPECT_EQ(read_image(folder.path() / "a.exr")->value(0, 0, 0), 0.125F);
}

TEST(Conventions, C8_AutomaticExposureBringsTheLogMeanToMiddleGrey) {
  LayeredImage image;
  image.width = 2;
  image.height = 1;
  // The log-mean of 0.09 and 0.36 is 0.18; doubled, it must be halved.
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, {0.18F, 0.72F}});
  image.channels.push_back({"A", {1, 1}});
  EXPECT_NEAR(automatic_exposure(image), 0.5, 1e-3);
  // A dark room with a lamp's light on a twentieth of it, which is not to be lost.
  image.width = 100;
  for (Channel& channel : image.channels) {
    channel.values.assign(100, channel.name == "A" ? 1.0F : 0.001F);
    if (channel.name != "A") std::fill_n(channel.values.begin(), 5, 8.0F);
  }
  EXPECT_NEAR(automatic_exposure(image), 1.0 / 8, 1e-6);
}

// ------------------------------------------------------------------------------------------------ layers

TEST(Conventions, D1_ZIsTheDistanceAlongTheAxis) {
  const LayeredImage image = draw(wall_scene(), reference::look({0, 0, 3}, {0, 0, 0}, 60, 1),
                                  settings_of(9, ShadingModel::phong, {Layer::depth}));
  for (const float z : image.find("Z")->values) EXPECT_FLOAT_EQ(z, 3);
}

TEST(Conventions, D2_WhereNothingIsLayersSaySo) {
  const LayeredImage image =
      draw(wall_scene(), reference::square_on(4, 1),
           settings_of(8, ShadingModel::phong,
                       {Layer::depth, Layer::object, Layer::position, Layer::normal, Layer::albedo}));
  EXPECT_EQ(at(image, "Z", 0, 0), kInfinity);
  EXPECT_EQ(at(image, "id.object", 0, 0), -1);
  for (const char* name : {"P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "albedo.R", "albedo.G", "albedo.B"}) {
    EXPECT_EQ(at(image, name, 0, 0), 0) << name;
  }
  EXPECT_EQ(at(image, "id.object", 4, 4), 0);
}

TEST(Conventions, D3_DepthMapsHoldMetresAlongTheirAxis) {
  Light light = wall_projector();
  light.projection = {false, -0.8, 0.8, -0.8, 0.8, 0.1, 100};  // twice as wide as the wall
  const Renderer renderer = make_renderer(projected_wall(light));
  const LayeredImage map = renderer.depth_map("light").value();
  const int side = map.width;
  EXPECT_FLOAT_EQ(at(map, "Z", side / 2, side / 2), 5);
  EXPECT_FLOAT_EQ(at(map, "Z", side * 3 / 10, side * 3 / 10), 5);  // 30° off the axis
  EXPECT_EQ(at(map, "Z", 2, 2), kInfinity);
}

TEST(Conventions, D4_InPicturesOfDepthNearIsLightAndFarIsDark) {
  LayeredImage depth;
  depth.width = 4;
  depth.height = 1;
  depth.channels.push_back({"Z", {1, 2, 3, kInfinity}});
  const LayeredImage picture = depth_picture(depth).value();
  EXPECT_GT(at(picture, "R", 0, 0), at(picture, "R", 1, 0));
  EXPECT_GT(at(picture, "R", 1, 0), at(picture, "R", 2, 0));
  EXPECT_EQ(at(picture, "R", 3, 0), 1);
  EXPECT_LT(at(picture, "R", 0, 0), 1);
}

TEST(Conventions, D5_BeautyIsAmbientPlusTheLightsInOrder) {
  Scene scene = wall_scene();
  add_object(scene, "torus", reference::torus({0, 0, 0.5F}, 1, 0.3F, 32), {0.3F, 0.7F, 0.1F});
  scene.ambient = glm::vec3(0.07F);
  const std::array<const char*, 3> names = {"a", "b", "c"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    Light light = light_of(LightType::point, 3 + static_cast<double>(i));
    light.name = names[i];
    add_light(scene, light, {1.3 * static_cast<double>(i) - 1, 1, 3}, {0, 0, 0});
  }
  RenderSettings settings = settings_of(32, ShadingModel::pbr, {Layer::light});
  settings.samples = 4;
  const LayeredImage image = draw(scene, wall_view(), settings);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      float sum = at(image, "ambient.G", x, y);
      for (const char* name : names) sum += at(image, std::string("light.") + name + ".G", x, y);
      ASSERT_EQ(at(image, "G", x, y), sum) << x << " " << y;
    }
  }
}

TEST(Conventions, D6_UvIsTheSlideCoordinateAndNaNOutside) {
  Light light = wall_projector();
  light.projection = {false, -0.2, 0.2, -0.2, 0.2, 0.1, 100};  // the middle half of the wall
  const LayeredImage image =
      draw(projected_wall(light), wall_view(), settings_of(16, ShadingModel::papers, {Layer::uv}));
  EXPECT_NEAR(at(image, "uv.light.u", 4, 8), (wall_position(4, 16) + 1) / 2, 1e-6);
  EXPECT_NEAR(at(image, "uv.light.v", 4, 8), (wall_position(8, 16) + 1) / 2, 1e-6);
  EXPECT_TRUE(std::isnan(at(image, "uv.light.u", 3, 8)));
}

TEST(Conventions, D7_LuxIsIlluminanceOnTheTrianglesNormalInRec709Weights) {
  Scene scene = wall_scene();
  for (glm::vec3& normal : scene.meshes[0].primitives[0].normals) normal = {0.6F, 0, 0.8F};
  scene.materials[0].base_color = {0.1F, 0.2F, 0.3F, 1};  // does not matter
  Light light = light_of(LightType::directional, 10);
  light.color = {1, 0.5F, 0.25F};
  add_light(scene, light, {0, 3, 4}, {0, 0, 0});
  EXPECT_NEAR(at(draw_lux(scene, 4), "lux.Y", 2, 2), 10 * 0.8 * (0.2126 + 0.7152 * 0.5 + 0.0722 * 0.25),
              1e-5);
}

TEST(Conventions, D11_LuminanceIsThePicturesLuminance) {
  Scene scene = wall_scene();
  scene.materials[0].base_color = {0, 0, 0, 1};
  scene.materials[0].emissive = {300, 200, 100};  // cd/m²
  scene.ambient_is_set = true;
  const LayeredImage image =
      draw(std::move(scene), wall_view(), settings_of(4, ShadingModel::pbr, {Layer::luminance}));
  EXPECT_NEAR(at(image, "luminance.Y", 2, 2), 0.2126 * 300 + 0.7152 * 200 + 0.0722 * 100, 1e-3);
}

TEST(Conventions, D12_PixelDensityIsPixelsPerMetreWhereTheyAreSparsest) {
  Light light = light_of(LightType::projector, 1);
  light.projection = {false, -0.2, 0.2, -0.1, 0.1, 0.1, 100};  // 2 m × 1 m on a wall 5 m away
  light.aspect_from_slide = false;
  light.panel_width = 1000;
  light.panel_height = 400;
  Scene scene = wall_scene();
  add_light(scene, light, {0, 0, 5}, {0, 0, 0});
  const std::string name = "pixel_density." + light.name;
  const LayeredImage image =
      draw(std::move(scene), wall_view(), settings_of(5, ShadingModel::papers, {Layer::pixel_density}));
  EXPECT_NEAR(at(image, name, 2, 2), 400, 1e-3);
}

TEST(Conventions, D8_NIsTheShadingNormalOnTheSideThatIsSeen) {
  Scene scene = wall_scene();
  scene.materials[0].double_sided = true;
  const auto normal_z = [&](double z) {
    return at(draw(scene, reference::look({0, 0, z}, {0, 0, 0}, 30, 1),
                   settings_of(4, ShadingModel::phong, {Layer::normal})),
              "N.Z", 2, 2);
  };
  EXPECT_FLOAT_EQ(normal_z(5), 1);
  EXPECT_FLOAT_EQ(normal_z(-5), -1);
  // The vertices' normals, not the triangles'.
  const glm::vec3 tilted = glm::normalize(glm::vec3(0.6F, 0, 0.8F));
  scene.meshes[0].primitives[0].normals.assign(4, tilted);
  EXPECT_NEAR(normal_z(5), 0.8, 1e-6);
}

TEST(Conventions, D9_PIsTheWorldPosition) {
  Scene scene = wall_scene();
  scene.nodes[0].parent_from_node[3] = {10, 20, 30, 1};
  const LayeredImage image = draw(scene, reference::look({10, 20, 35}, {10, 20, 30}, 30, 1),
                                  settings_of(5, ShadingModel::phong, {Layer::position}));
  EXPECT_NEAR(at(image, "P.X", 2, 2), 10, 1e-5);
  EXPECT_NEAR(at(image, "P.Y", 2, 2), 20, 1e-5);
  EXPECT_NEAR(at(image, "P.Z", 2, 2), 30, 1e-5);
}

TEST(Conventions, D10_WithoutABackgroundNothingIsBlackAndTransparent) {
  Scene scene = wall_scene();
  scene.ambient = glm::vec3(1);
  const View wide = reference::square_on(4, 1);
  const LayeredImage plain = draw(scene, wide, settings_of(8, ShadingModel::papers));
  EXPECT_EQ(at(plain, "R", 0, 0), 0);
  EXPECT_EQ(at(plain, "A", 0, 0), 0);
  EXPECT_EQ(at(plain, "A", 4, 4), 1);
  scene.background = glm::vec3(0.5F);
  const LayeredImage filled = draw(scene, wide, settings_of(8, ShadingModel::papers));
  EXPECT_EQ(at(filled, "R", 0, 0), 0.5F);
  EXPECT_EQ(at(filled, "A", 0, 0), 1);
}

// ------------------------------------------------------------------------------------------------ light

// Angle between the wall's normal and the ray from a light on its axis at distance z.
struct WallPoint {
  double cosine, distance;
};
WallPoint wall_point(int x, int y, int side, double z) {
  const double dx = wall_position(x, side);
  const double dy = wall_position(y, side);
  const double distance = std::sqrt(dx * dx + dy * dy + z * z);
  return {z / distance, distance};
}

TEST(Conventions, I1_PointsAndSpotsHaveCandela) {
  for (const LightType type : {LightType::point, LightType::spot}) {
    Scene scene = wall_scene();
    Light light = light_of(type, 40);
    light.inner_cone = Angle::degrees(80);
    light.outer_cone = Angle::degrees(85);
    add_light(scene, light, {0, 0, 3}, {0, 0, 0});
    const LayeredImage image = draw_lux(scene, 9);
    for (const int x : {0, 2, 4}) {
      const WallPoint p = wall_point(x, 4, 9, 3);
      EXPECT_NEAR(at(image, "lux.Y", x, 4), 40 * p.cosine / (p.distance * p.distance), 1e-5);
    }
  }
}

TEST(Conventions, I2_DirectionalLightsHaveLux) {
  Scene scene = wall_scene();
  add_light(scene, light_of(LightType::directional, 7), {0, 3, 4}, {0, 0, 0});
  EXPECT_NEAR(at(draw_lux(scene, 4), "lux.Y", 0, 3), 7 * 0.8, 1e-5);
  scene.nodes.back().parent_from_node[3] = {0, 300, 400, 1};
  EXPECT_NEAR(at(draw_lux(scene, 4), "lux.Y", 0, 3), 7 * 0.8, 1e-5);
}

TEST(Conventions, I3_ProjectorsLightASquareOnWallEvenly) {
  Light light = wall_projector();
  light.intensity = 100;
  const LayeredImage image = draw_lux(projected_wall(light), 9);
  for (const float lux : image.find("lux.Y")->values) EXPECT_NEAR(lux, 100.0 / 25, 1e-5);
}

TEST(Conventions, I4_UniformCandelaFallsWithTheCubeOfTheCosine) {
  Light light = wall_projector();
  light.intensity = 100;
  light.profile = BeamProfile::uniform_candela;
  const LayeredImage image = draw_lux(projected_wall(light), 9);
  for (const int x : {0, 3, 4}) {
    const double cosine = wall_point(x, 0, 9, 5).cosine;
    EXPECT_NEAR(at(image, "lux.Y", x, 0), 100.0 / 25 * cosine * cosine * cosine, 1e-5);
  }
}

TEST(Conventions, I5_LumensAreWhatTheWholeFrameThrows) {
  for (const BeamProfile profile : {BeamProfile::flat_field, BeamProfile::uniform_candela}) {
    Light light = wall_projector();
    light.lumens = 500;
    light.profile = profile;
    const LayeredImage image = draw_lux(projected_wall(light), 64);
    double flux = 0;  // ∫ E dA over the wall's 16 m², by its pixels
    for (const float lux : image.find("lux.Y")->values) flux += static_cast<double>(lux) * 16 / (64 * 64);
    EXPECT_NEAR(flux, 500, 0.05);
  }
}

TEST(Conventions, I6_AnIntensityMapIsCandelaPerDirection) {
  Scene scene = wall_scene();
  Light light =
      wall_projector(reference::add_linear_picture(scene, 4, 4, [](int, int) { return glm::vec3(0.5F); }));
  light.slide_is_intensity = true;
  light.intensity = 80;
  add_light(scene, light, {0, 0, 5}, {0, 0, 0});
  const LayeredImage image = draw_lux(scene, 9);
  for (const int x : {0, 4}) {
    const WallPoint p = wall_point(x, 4, 9, 5);
    EXPECT_NEAR(at(image, "lux.Y", x, 4), 0.5 * 80 * p.cosine / (p.distance * p.distance), 1e-5);
  }
}

TEST(Conventions, I15_ColourTemperatureKeepsLuminance) {
  for (const double kelvin : {1500.0, 2856.0, 9000.0}) {
    Scene scene = wall_scene();
    Light light = light_of(LightType::directional, 10);
    light.color = color_of_temperature(kelvin);
    EXPECT_NE(light.color.r, light.color.b);
    add_light(scene, light, {0, 0, 5}, {0, 0, 0});
    EXPECT_NEAR(at(draw_lux(scene, 4), "lux.Y", 2, 2), 10, 1e-5);
  }
}

TEST(Conventions, I16_BlackLevelIsAFractionOfWhite) {
  Light light = wall_projector(0);
  light.intensity = 100;
  light.black_level = 0.01;
  Scene scene = projected_wall(light);
  scene.pictures.push_back({});
  scene.pictures[0].name = "black";
  scene.pictures[0].pixels = std::make_shared<Image>(2, 2, 3, PixelType::u8, Transfer::srgb);
  const LayeredImage image = draw_lux(std::move(scene), 9);
  for (const float lux : image.find("lux.Y")->values) EXPECT_NEAR(lux, 0.01 * 100 / 25, 1e-6);
}

TEST(Conventions, I7_WhiteUnderOneLux) {
  const auto radiance = [](ShadingModel model) {
    Scene scene = wall_scene();
    scene.phong = PhongHighlight{0, 1};
    scene.materials[0].base_color = {1, 1, 1, 1};
    scene.materials[0].metallic = 0;
    add_light(scene, light_of(LightType::directional, 1), {0, 0, 5}, {0, 0, 0});
    return at(draw(scene, wall_view(), settings_of(4, model)), "R", 2, 2);
  };
  EXPECT_EQ(radiance(ShadingModel::papers), 1);
  EXPECT_FLOAT_EQ(radiance(ShadingModel::phong), 1);
  // Of a dielectric, 4 % are reflected by the surface: for base colour 1 the diffuse part is 0.96/π, and the lobe of
  // roughness 1 seen along its own direction adds 0.04 · D V = 0.04/π · 1/4.
  EXPECT_NEAR(radiance(ShadingModel::pbr), (0.96 + 0.04 / 4) / kPi, 1e-6);
}

TEST(Conventions, I8_SpotConesAreHalfAngles) {
  Scene scene = wall_scene();
  Light light = light_of(LightType::spot, 9);
  light.inner_cone = Angle::degrees(15);
  light.outer_cone = Angle::degrees(25);
  light.shadow.technique = ShadowTechnique::none;
  add_light(scene, light, {0, 0, 3}, {0, 0, 0});
  const int side = 401;
  const LayeredImage image = draw_lux(scene, side);
  for (int x = side / 2; x < side; ++x) {
    const WallPoint p = wall_point(x, side / 2, side, 3);
    const double angle_deg = std::acos(p.cosine) * 180 / kPi;
    const double unhindered = 9 * p.cosine / (p.distance * p.distance);
    if (angle_deg < 14.9) {
      ASSERT_NEAR(at(image, "lux.Y", x, side / 2), unhindered, 1e-5) << angle_deg;
    } else if (angle_deg > 25.1) {
      ASSERT_EQ(at(image, "lux.Y", x, side / 2), 0) << angle_deg;
    } else if (angle_deg > 15.1 && angle_deg < 24.9) {
      ASSERT_LT(at(image, "lux.Y", x, side / 2), unhindered) << angle_deg;
      ASSERT_GT(at(image, "lux.Y", x, side / 2), 0) << angle_deg;
    }
  }
}

TEST(Conventions, I9_RangeIsUnlimitedUnlessSet) {
  EXPECT_EQ(Light().range, kInfinity);
  for (const Attenuation attenuation : {Attenuation::gltf_windowed, Attenuation::linear}) {
    const auto lux = [&](double distance) {
      Scene scene = wall_scene();
      Light light = light_of(LightType::point, 10);
      light.attenuation = attenuation;
      light.range = 4;
      add_light(scene, light, {0, 0, distance}, {0, 0, 0});
      return at(draw_lux(scene, 401), "lux.Y", 200, 200);
    };
    EXPECT_GT(lux(3.9), 0);
    EXPECT_EQ(lux(4.1), 0);
  }
}

TEST(Conventions, I10_NothingIsLitBehindALens) {
  Scene scene = wall_scene();
  Light light = wall_projector();
  light.outside = Outside::repeat;  // not for want of a frame
  add_light(scene, light, {0, 0, 5}, {0, 0, 10});
  const LayeredImage image = draw(scene, wall_view(), settings_of(8, ShadingModel::papers));
  for (const float r : image.find("R")->values) EXPECT_EQ(r, 0);
}

TEST(Conventions, I11_OutsideItsSlideAProjectorIsDark) {
  Light light = wall_projector();
  light.projection = {false, -0.2, 0.2, -0.2, 0.2, 0.1, 100};
  const LayeredImage image = draw(projected_wall(light), wall_view(), settings_of(16, ShadingModel::papers));
  for (int x = 0; x < 16; ++x) EXPECT_EQ(at(image, "R", x, 8), x >= 4 && x < 12 ? 1 : 0) << x;
}

TEST(Conventions, I12_BeyondTheFrameASlideIsClampedRepeatedOrMirrored) {
  const auto row = [](Outside outside) {
    Scene scene = wall_scene();
    // Two halves, 0.25 on the left and 0.75 on the right. The frame is the middle quarter of the wall.
    Light light = wall_projector(reference::add_linear_picture(
        scene, 64, 1, [](int x, int) { return glm::vec3(x < 32 ? 0.25F : 0.75F); }));
    light.projection = {false, -0.1, 0.1, -0.1, 0.1, 0.1, 100};
    light.outside = outside;
    add_light(scene, light, {0, 0, 5}, {0, 0, 0});
    const LayeredImage image = draw(scene, wall_view(), settings_of(64, ShadingModel::papers));
    // In the middles of half slides, from a whole one before the frame to a whole one after it.
    std::array<float, 6> halves{};
    for (int i = 0; i < 6; ++i) halves[static_cast<std::size_t>(i)] = at(image, "R", 12 + 8 * i, 32);
    return halves;
  };
  constexpr float a = 0.25F, b = 0.75F;
  EXPECT_EQ(row(Outside::clamp), (std::array{a, a, a, b, b, b}));
  EXPECT_EQ(row(Outside::repeat), (std::array{a, b, a, b, a, b}));
  EXPECT_EQ(row(Outside::mirror), (std::array{b, a, a, b, b, a}));
  EXPECT_EQ(row(Outside::black), (std::array{0.0F, 0.0F, a, b, 0.0F, 0.0F}));
}

TEST(Conventions, I13_TheFramesWidthFollowsTheSlide) {
  Scene scene = wall_scene();
  Light light =
      wall_projector(reference::add_linear_picture(scene, 30, 60, [](int, int) { return glm::vec3(1); }));
  light.projection = Projection::perspective(Angle::degrees(40), 1, 0.1, 100);
  light.aspect_from_slide = true;
  add_light(scene, light, {0, 0, 5}, {0, 0, 0});
  const Projection frame = make_renderer(scene).light_view("light")->projection;
  EXPECT_NEAR(frame.yfov().in_degrees(), 40, 1e-9);
  EXPECT_NEAR(frame.aspect(), 0.5, 1e-12);
}

TEST(Conventions, I14_ASlideStandsUprightAlongTheBeam) {
  Scene scene = wall_scene();
  const int slide =
      reference::add_linear_picture(scene, 16, 16, [](int x, int y) { return quarter(x, y, 16); });
  add_light(scene, wall_projector(slide), {0, 0, 5}, {0, 0, 0});
  expect_quarters(draw(scene, wall_view(), settings_of(16, ShadingModel::papers)));
}

// ------------------------------------------------------------------------------------------------ shadows

// A plate between light and wall that hides the wall's left half, and is no part of the picture.
Scene half_shadowed_wall(Light light) {
  Scene scene = projected_wall(std::move(light));
  add_object(scene, "plate", reference::wall(2, 2, 0));
  scene.materials.back().double_sided = true;
  scene.nodes.back().parent_from_node[3] = {-2, 0, 1, 1};
  scene.nodes.back().visible = false;
  return scene;
}

// ------------------------------------------------------------------------------------------------ measured lamps

// 10 cd at photometric zero; sideways 40 cd along C0, 80 along C90, 120 along C180, 160 along C270.
LightDistribution four_sided_lamp() {
  LightDistribution lamp;
  lamp.vertical_deg = {0, 90};
  lamp.horizontal_deg = {0, 90, 180, 270, 360};
  lamp.candela = {10, 40, 10, 80, 10, 120, 10, 160, 10, 40};
  return lamp;
}

Light lamp_light() {
  Light light = light_of(LightType::point, 1);
  light.distribution = std::make_shared<const LightDistribution>(four_sided_lamp());
  return light;
}

TEST(Conventions, B1_ALampsZeroIsMinusZAndC0PlusX) {
  // 45° to each side of the axis of a lamp 2 m before the wall: the mean of both ends of the section.
  const LayeredImage image = [] {
    Scene scene = wall_scene();
    add_light(scene, lamp_light(), {0, 0, 2}, {0, 0, 0});
    return draw_lux(scene, 9);
  }();
  const auto candela = [&](int x, int y) {
    const WallPoint p = wall_point(x, y, 9, 2);
    return at(image, "lux.Y", x, y) * p.distance * p.distance / p.cosine;
  };
  EXPECT_NEAR(candela(4, 4), 10, 1e-3);
  const double share = std::atan(wall_position(8, 9) / 2) / (kPi / 2);
  EXPECT_NEAR(candela(8, 4), 10 + 30 * share, 1e-3);
  EXPECT_NEAR(candela(4, 0), 10 + 70 * share, 1e-3);
  EXPECT_NEAR(candela(0, 4), 10 + 110 * share, 1e-3);
  EXPECT_NEAR(candela(4, 8), 10 + 150 * share, 1e-3);
}

TEST(Conventions, B2_ALampInARigHangs) {
  const TemporaryFolder folder;
  folder.write("lamp.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n10 5\n");
  const Scene scene = testing_scenes::load_or_fail(
      {}, {.rigs = {folder.write(
               "rig.json", R"({"lights": [{"type": "point", "position": [1, 2, 3], "ies": "lamp.ies"}]})")}});
  const Pose pose = Pose::from_matrix(scene.nodes.at(0).parent_from_node).value();
  EXPECT_EQ(pose.forward_ws(), glm::dvec3(0, -1, 0));
  EXPECT_EQ(pose.right_ws(), glm::dvec3(1, 0, 0));
  EXPECT_EQ(pose.position_ws, glm::dvec3(1, 2, 3));
}

TEST(Conventions, B3_ALampsCandelaAreItsFilesTimesItsIntensity) {
  for (const double scale : {1.0, 2.5}) {
    Scene scene = wall_scene();
    Light light = lamp_light();
    light.intensity = scale;
    add_light(scene, light, {0, 0, 2}, {0, 0, 0});
    EXPECT_NEAR(at(draw_lux(scene, 9), "lux.Y", 4, 4), scale * 10 / 4, 1e-5);
  }
}

TEST(Conventions, B4_LumensAreTheWholeFlux) {
  const auto on_axis = [](Light light) {
    light.lumens = 600;
    Scene scene = wall_scene();
    add_light(scene, light, {0, 0, 2}, {0, 0, 0});
    return at(draw_lux(scene, 9), "lux.Y", 4, 4) * 4;  // candela
  };
  EXPECT_NEAR(on_axis(lamp_light()), 10 * 600 / luminous_flux(four_sided_lamp()), 1e-3);
  EXPECT_NEAR(on_axis(light_of(LightType::point, 1)), 600 / (4 * kPi), 1e-3);
  // Between 10° and 30° the cone's light falls as the square of a share of the cosines: a third of it is left on average.
  Light spot = light_of(LightType::spot, 1);
  spot.inner_cone = Angle::degrees(10), spot.outer_cone = Angle::degrees(30);
  const double inner = std::cos(kPi / 18), outer = std::cos(kPi / 6);
  EXPECT_NEAR(on_axis(spot), 600 / (2 * kPi * (1 - inner + (inner - outer) / 3)), 1e-2);
  // Half the frame at 1, half at 0, of a frame of 0.4 × 0.4 by tangents: half its solid angle.
  Scene scene = wall_scene();
  Light map = wall_projector(
      reference::add_linear_picture(scene, 4, 4, [](int x, int) { return glm::vec3(x < 2 ? 1.0F : 0.0F); }));
  map.slide_is_intensity = true;
  map.lumens = 600;
  add_light(scene, map, {0, 0, 5}, {0, 0, 0});
  const double solid_angle = 4 * std::atan(0.16 / std::sqrt(1 + 0.16 + 0.16));
  const WallPoint p = wall_point(2, 4, 9, 5);
  EXPECT_NEAR(at(draw_lux(scene, 9), "lux.Y", 2, 4),
              600 / (solid_angle / 2) * p.cosine / (p.distance * p.distance), 1e-2);
}

TEST(Conventions, H1_VisibilityIsTheFractionThatArrives) {
  const LayeredImage image = draw(half_shadowed_wall(wall_projector()), wall_view(),
                                  settings_of(16, ShadingModel::phong, {Layer::visibility}));
  EXPECT_EQ(at(image, "visibility.light", 3, 8), 0);
  EXPECT_EQ(at(image, "visibility.light", 12, 8), 1);
}

TEST(Conventions, H2_LitWhenNoFartherThanTheMapHoldsPlusTheBias) {
  // Depths are reversed, one over the distance.
  EXPECT_TRUE(shadow::is_lit(1 / 4.0F, 1 / 4.0F, 0));      // the surface that the map saw
  EXPECT_TRUE(shadow::is_lit(1 / 4.0F, 1 / 3.0F, 0));      // nearer
  EXPECT_FALSE(shadow::is_lit(1 / 4.0F, 1 / 5.0F, 0));     // farther
  EXPECT_TRUE(shadow::is_lit(1 / 4.0F, 1 / 5.0F, 0.06F));  // farther by less than the bias
}

TEST(Conventions, H3_OutsideAShadowMapEverythingIsLit) {
  const auto visibility = [](bool outside_is_lit) {
    Light sun = light_of(LightType::directional, 1);
    sun.fit = false;
    sun.projection = Projection::orthographic(1, 1, 0, 10);  // the middle of the wall
    sun.shadow.outside_is_lit = outside_is_lit;
    return draw(projected_wall(sun), wall_view(), settings_of(16, ShadingModel::phong, {Layer::visibility}));
  };
  EXPECT_EQ(at(visibility(true), "visibility.light", 1, 8), 1);
  EXPECT_EQ(at(visibility(false), "visibility.light", 1, 8), 0);
  EXPECT_EQ(at(visibility(false), "visibility.light", 8, 8), 1);
}

TEST(Conventions, H4_SixMapsInTheOrderOfTheAxes) {
  Scene scene = wall_scene();
  add_light(scene, light_of(LightType::point, 1), {1, 2, 3}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  ASSERT_EQ(renderer.depth_map_views("light")->size(), 6U);
  const std::array<glm::dvec3, 6> axes = {
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  for (int face = 0; face < 6; ++face) {
    const Pose pose = renderer.depth_map_views("light")->at(static_cast<std::size_t>(face)).view.pose;
    EXPECT_EQ(pose.position_ws, glm::dvec3(1, 2, 3)) << face;
    EXPECT_EQ(pose.forward_ws(), axes[static_cast<std::size_t>(face)]) << face;
    EXPECT_EQ(pose.up_ws(), face / 2 == 1 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0)) << face;
  }
}

TEST(Conventions, H5_SlidesNeedNoShadows) {
  RenderSettings settings = settings_of(16, ShadingModel::papers);
  const Scene scene = half_shadowed_wall(wall_projector());
  EXPECT_EQ(at(draw(scene, wall_view(), settings), "R", 3, 8), 0);
  settings.shadows = ShadowTechnique::none;
  EXPECT_EQ(at(draw(scene, wall_view(), settings), "R", 3, 8), 1);
}

// ------------------------------------------------------------------------------------------------ sameness

LayeredImage sample_picture(int threads, InstructionSet set) {
  Scene scene = wall_scene();
  add_object(scene, "torus", reference::torus({0, 0, 0.5F}, 1, 0.3F, 48), {0.3F, 0.7F, 0.1F});
  const int slide =
      reference::add_picture(scene, 32, 32, [](int x, int y) { return glm::u8vec3(8 * x, 8 * y, 99); });
  Light light = wall_projector(slide);
  add_light(scene, light, {1, 2, 5}, {0, 0, 0});
  RenderSettings settings = settings_of(150, ShadingModel::pbr, {Layer::light, Layer::visibility});
  settings.samples = 2;
  const Renderer renderer = make_renderer(std::move(scene), threads, set);
  return reference::render(renderer, reference::look({2, 1, 4}, {0, 0, 0}, 60, 1), settings);
}

TEST(Conventions, R1_ThreadsAndInstructionSetsDoNotMatter) {
  const LayeredImage first = sample_picture(1, InstructionSet::scalar);
  for (const InstructionSet set : supported_instruction_sets()) {
    const LayeredImage other = sample_picture(3, set);
    for (std::size_t i = 0; i < first.channels.size(); ++i) {
      EXPECT_EQ(first.channels[i].values, other.channels[i].values) << name_of(set) << first.channels[i].name;
    }
  }
}

TEST(Conventions, R2_WhatIsStoredWithAPictureIsTheSameToo) {
  const LayeredImage first = sample_picture(1, InstructionSet::scalar);
  EXPECT_FALSE(first.metadata.empty());
  EXPECT_EQ(first.metadata, sample_picture(2, best_instruction_set()).metadata);
}

// ------------------------------------------------------------------------------------------------ messages

TEST(Conventions, E1_DiagnosticsNameFileAndPlace) {
  EXPECT_EQ(to_string(Diagnostic{"a.gltf", "nodes[3]", "expected a number"}),
            "a.gltf: nodes[3]: expected a number");
  EXPECT_EQ(to_string(Diagnostic{"a.png", "", "is empty"}), "a.png: is empty");
  EXPECT_EQ(to_string(Diagnostic{"", "meshes[0]", "has no positions"}), "meshes[0]: has no positions");
}

TEST(Conventions, E2_ExitCodesAreTheFailuresNumbers) {
  EXPECT_EQ(static_cast<int>(Failure::bad_usage), 2);
  EXPECT_EQ(static_cast<int>(Failure::bad_input), 3);
  EXPECT_EQ(static_cast<int>(Failure::cannot_write), 4);
}

// ------------------------------------------------------------------------------------------------ the page itself

TEST(ConventionsPage, EverySentenceHasATestAndEveryTestASentence) {
  std::ifstream page(LATERNA_SOURCE_DIR "/docs/conventions.md");
  ASSERT_TRUE(page.is_open());
  std::set<std::string> sentences;
  const std::regex bullet("^- \\*\\*([A-Z][0-9]+)\\*\\* .*\\.$");
  std::smatch match;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("- ", 0) != 0) continue;
    ASSERT_TRUE(std::regex_match(line, match, bullet)) << line;
    EXPECT_TRUE(sentences.insert(match[1]).second) << line;
  }
  std::set<std::string> tests;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    if (std::string_view(suite.name()) != "Conventions") continue;
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const std::string name = suite.GetTestInfo(k)->name();
      tests.insert(name.substr(0, name.find('_')));
    }
  }
  EXPECT_EQ(sentences, tests);
}

}  // namespace
}  // namespace laterna
