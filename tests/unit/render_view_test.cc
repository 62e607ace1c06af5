// Cameras, views and the scenes that are hard to see.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "reference/everything.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using reference::everything;
using reference::same_bits;

RenderSettings settings_of_view(int width, int height, std::vector<Layer> layers = {}) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.layers = std::move(layers);
  return settings;
}

// ---------------------------------------------------------------------------------------------- cameras

int add_camera(Scene& scene, const std::string& name, const View& view) {
  Camera camera;
  camera.name = name;
  camera.projection = view.projection;
  Node node;
  node.name = name;
  node.camera = static_cast<int>(scene.cameras.size());
  node.parent_from_node = view.pose.world_from_view();
  scene.cameras.push_back(camera);
  scene.nodes.push_back(node);
  return static_cast<int>(scene.nodes.size()) - 1;
}

TEST(RenderCameras, ManyCamerasOnOneLoadedScene) {
  Scene scene = everything();
  const View front = reference::everything_view(120, 90),
             side = reference::look({7, 2, 1}, {0, 1, 0}, 50, 4.0 / 3);
  add_camera(scene, "front", front);
  add_camera(scene, "side", side);
  const Renderer renderer = reference::make_renderer(scene);
  const RenderSettings settings = settings_of_view(120, 90);
  for (const auto& [name, view] : {std::pair{"front", front}, {"side", side}, {"front", front}}) {
    const LayeredImage by_name =
        reference::render(renderer, renderer.camera_view(name, 120, 90).value(), settings);
    const LayeredImage by_itself = reference::render(reference::make_renderer(everything()), view, settings);
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < by_name.channels[c].values.size(); ++i) {
        // The pose has gone through a matrix.
        ASSERT_NEAR(by_name.channels[c].values[i], by_itself.channels[c].values[i], 1e-3) << name;
      }
    }
  }
  const View first = renderer.camera_view("", 120, 90).value();
  EXPECT_EQ(first.pose.position_ws, renderer.camera_view("front", 120, 90)->pose.position_ws);
}

TEST(RenderCameras, ACameraThatIsNotThereIsAnErrorThatListsThoseThatAre) {
  Scene scene = everything();
  const auto error = [&] {
    return to_string(reference::make_renderer(scene).camera_view("back", 10, 10).error());
  };
  EXPECT_EQ(error(), "the scene has no camera \"back\": it has none");
  add_camera(scene, "front", reference::everything_view(4, 3));
  add_camera(scene, "side", reference::everything_view(4, 3));
  EXPECT_EQ(error(), "the scene has no camera \"back\": it has \"front\", \"side\"");
}

// "The frustum's width follows the picture's aspect; otherwise a picture of another aspect shows more, never less."
TEST(RenderCameras, ThePicturesAspectWidensTheFrustum) {
  Scene scene = everything();
  add_camera(scene, "free", reference::look({0, 1, 5}, {0, 1, 0}, 60, 1));
  add_camera(scene, "fixed", reference::look({0, 1, 5}, {0, 1, 0}, 60, 1.5));
  scene.cameras[1].aspect_from_picture = false;
  const Renderer renderer = reference::make_renderer(scene);
  const double side = std::tan(30 * 3.14159265358979 / 180);
  for (const auto& [width, height] : {std::pair{300, 100}, {150, 100}, {100, 100}, {100, 400}}) {
    const double aspect = static_cast<double>(width) / height;
    const Projection free = renderer.camera_view("free", width, height)->projection;
    EXPECT_NEAR(free.top, side, 1e-12);
    EXPECT_NEAR(free.right, side * aspect, 1e-12);
    const Projection fixed = renderer.camera_view("fixed", width, height)->projection;
    EXPECT_NEAR(fixed.aspect(), aspect, 1e-12);
    EXPECT_GE(fixed.right, 1.5 * side - 1e-12);
    EXPECT_GE(fixed.top, side - 1e-12);
    EXPECT_NEAR(std::min(fixed.right / 1.5, fixed.top), side, 1e-12);
  }
}

TEST(RenderCameras, TheOverviewSeesTheWholeScene) {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> place(-30, 30), size(0.1F, 10);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene;
    const glm::vec3 centre(place(random), place(random), place(random)),
        half(size(random), size(random), size(random));
    reference::add_object(scene, "box", reference::box(centre, half));
    const Renderer renderer = reference::make_renderer(std::move(scene));
    for (const auto& [width, height] : {std::pair{300, 100}, {100, 300}}) {
      const View view = renderer.overview(width, height);
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                             (corner & 4) != 0 ? 1 : -1);
        const glm::dvec4 clip = view.clip_from_world() * glm::dvec4(centre + sign * half, 1);
        EXPECT_LE(std::abs(clip.x), clip.w);
        EXPECT_LE(std::abs(clip.y), clip.w);
        EXPECT_LE(std::abs(clip.z), clip.w);
      }
      EXPECT_GT(view.pose.position_ws.y, centre.y);
      EXPECT_GT(view.pose.position_ws.z, centre.z);
    }
  }
}

// Where the corner of a thin triangle appears: the pinhole of OpenCV's calib3d, u = fx x/z + cx, v = fy y/z + cy, with
// x right, y down, z ahead, and (0, 0) the centre of the top-left pixel.
TEST(RenderCameras, IntrinsicsOfOpenCVPutEveryPointOnItsPixel) {
  constexpr double kFx = 412.3, kFy = 398.7, kCx = 171.25, kCy = 118.9;
  constexpr int kWidth = 360, kHeight = 240;
  const Pose pose = Pose::look_at({1, 2, 5}, {0.2, 0.4, -1}, {0.1, 1, 0}).value();
  const View view = {pose, Projection::from_intrinsics(kFx, kFy, kCx, kCy, kWidth, kHeight, 0.1, 100)};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> x(-0.35, 0.35), y(-0.25, 0.25), depth(2, 20);
  for (int i = 0; i < 1000; ++i) {
    const double z = depth(random);
    const glm::dvec3 camera(x(random) * z, y(random) * z, z);
    const glm::dvec3 world = pose.position_ws + camera.x * pose.right_ws() - camera.y * pose.up_ws() +
                             camera.z * pose.forward_ws();
    const glm::dvec4 image = view.image_from_world() * glm::dvec4(world, 1);
    ASSERT_NEAR(image.x / image.w * kWidth - 0.5, kFx * camera.x / camera.z + kCx, 1e-9);
    ASSERT_NEAR(image.y / image.w * kHeight - 0.5, kFy * camera.y / camera.z + kCy, 1e-9);
  }
}

// The same through the renderer: the world position that the picture holds at a pixel is the one whose pinhole image is
// that pixel's centre.
TEST(RenderCameras, IntrinsicsHoldInThePicture) {
  constexpr double kFx = 160.5, kFy = 155.25, kCx = 70.4, kCy = 52.8;
  constexpr int kWidth = 150, kHeight = 110;
  const Pose pose = Pose::look_at({1, 2, 5}, {0.2, 0.4, -1}, {0.1, 1, 0}).value();
  const View view = {pose, Projection::from_intrinsics(kFx, kFy, kCx, kCy, kWidth, kHeight, 0.1, 100)};
  const LayeredImage picture =
      reference::render(reference::make_renderer(everything()), view,
                        settings_of_view(kWidth, kHeight, {Layer::position, Layer::depth}));
  int seen = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      if (std::isinf(reference::at(picture, "Z", column, row))) continue;
      const glm::dvec3 p(reference::at(picture, "P.X", column, row),
                         reference::at(picture, "P.Y", column, row),
                         reference::at(picture, "P.Z", column, row));
      const glm::dvec3 from_eye = p - pose.position_ws;
      const double z = glm::dot(from_eye, pose.forward_ws());
      ASSERT_NEAR(kFx * glm::dot(from_eye, pose.right_ws()) / z + kCx, column, 0.01);
      ASSERT_NEAR(-kFy * glm::dot(from_eye, pose.up_ws()) / z + kCy, row, 0.01);
      ASSERT_NEAR(reference::at(picture, "Z", column, row), z, 1e-5 * z);
      ++seen;
    }
  }
  EXPECT_GT(seen, kWidth * kHeight / 2);
}

TEST(RenderLightViews, ALightSeesWhatItsShadowMapHolds) {
  const Renderer renderer = reference::make_renderer(everything());
  for (const char* name : {"lantern", "spot", "sun", "parallel"}) {
    const Result<View> view = renderer.light_view(name);
    ASSERT_TRUE(view) << name;
    EXPECT_EQ(view->pose.position_ws, renderer.depth_map_views(name)->at(0).view.pose.position_ws);
    EXPECT_EQ(renderer.depth_map_views(name)->size(), 1U);
  }
  EXPECT_EQ(renderer.depth_map_views("bulb")->size(), 6U);
  EXPECT_EQ(
      to_string(renderer.light_view("bulb").error()),
      "light \"bulb\" shines all round: it has no one view (a picture of all directions from there draws "
      "`laterna environment --from-scene`)");
  EXPECT_EQ(to_string(renderer.depth_map("bulb", 6).error()),
            "light \"bulb\" has 6 depth maps, counted from 0; there is no number 6");
  EXPECT_EQ(to_string(renderer.light_view("star").error()).substr(0, 45),
            "the scene has no light \"star\": it has \"bulb\",");
}

// ---------------------------------------------------------------------------------------------- scenes of little or nothing

void expect_finite(const LayeredImage& picture, const std::string& what) {
  for (const char* channel : {"R", "G", "B", "A"}) {
    for (const float value : picture.find(channel)->values)
      ASSERT_TRUE(std::isfinite(value)) << what << " " << channel;
  }
}

TEST(RenderEdges, AnEmptySceneIsBlackAndTransparentOrItsBackground) {
  const View view = reference::look({0, 0, 3}, {0, 0, 0}, 40, 1);
  for (const bool has_background : {false, true}) {
    Scene scene;
    if (has_background) scene.background = glm::vec3(0.25F, 0.5F, 2);
    const Renderer renderer = reference::make_renderer(std::move(scene));
    const LayeredImage picture =
        reference::render(renderer, view, settings_of_view(70, 70, reference::all_layers()));
    for (std::size_t i = 0; i < picture.channels[0].values.size(); ++i) {
      ASSERT_EQ(picture.find("R")->values[i], has_background ? 0.25F : 0.0F);
      ASSERT_EQ(picture.find("B")->values[i], has_background ? 2.0F : 0.0F);
      ASSERT_EQ(picture.find("A")->values[i], has_background ? 1.0F : 0.0F);
      ASSERT_EQ(picture.find("Z")->values[i], std::numeric_limits<float>::infinity());
      ASSERT_EQ(picture.find("id.object")->values[i], -1.0F);
    }
    expect_finite(reference::render(renderer, renderer.overview(50, 40), settings_of_view(50, 40)),
                  "overview of nothing");
  }
}

TEST(RenderEdges, ASceneWithoutLightGetsADefaultSunAndSaysSo) {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(2), {0.5F, 0.5F, 0.5F});
  const Renderer dark = reference::make_renderer(scene);
  ASSERT_EQ(dark.scene().warnings.size(), 1U);
  EXPECT_EQ(dark.scene().warnings[0].message,
            "the scene has no light: it is lit by a default sun and a little ambient light");
  ASSERT_EQ(dark.scene().lights.size(), 1U);
  EXPECT_EQ(dark.scene().lights[0].name, "default sun");
  const View view = reference::look({0, 3, 0.1}, {0, 0, 0}, 40, 1);
  EXPECT_GT(reference::at(reference::render(dark, view, settings_of_view(9, 9)), "G", 4, 4), 0.1F);
  // Neither with a light, nor where the ambient light is set, even to nothing.
  scene.ambient_is_set = true;
  const Renderer ambient = reference::make_renderer(scene);
  EXPECT_TRUE(ambient.scene().warnings.empty());
  EXPECT_EQ(reference::at(reference::render(ambient, view, settings_of_view(9, 9)), "G", 4, 4), 0.0F);
  scene.ambient_is_set = false;
  Light off;
  off.enabled = false;
  reference::add_light(scene, off, {0, 1, 0}, {0, 0, 0.1});
  EXPECT_TRUE(reference::make_renderer(scene).scene().warnings.empty());
}

TEST(RenderEdges, TrianglesWithoutAreaAreNotSeenAndDisturbNothing) {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(3));
  Light light;
  light.intensity = 20;
  reference::add_light(scene, light, {1, 3, 1}, {0, 0, 0});
  const View view = reference::look({0, 2, 5}, {0, 0, 0}, 45, 1);
  const LayeredImage expected =
      reference::render(reference::make_renderer(scene), view, settings_of_view(100, 100));
  reference::Mesher mesh;
  mesh.triangle({0, 1, 0}, {0, 1, 0}, {0, 1, 0});
  mesh.triangle({-1, 1, 0}, {0, 1, 0}, {1, 1, 0});
  mesh.triangle({-1, 1, 0}, {1, 1, 0}, {-1, 1, 0});
  mesh.triangle({0, 1, 0}, {1e-30F, 1, 0}, {0, 1 + 1e-30F, 0});
  reference::add_object(scene, "nothing", mesh.primitive);
  scene.materials.back().double_sided = true;
  for (const ShadowFilter filter : {ShadowFilter::refined, ShadowFilter::percentage_closer}) {
    scene.lights[0].shadow.filter = filter;
    const LayeredImage picture =
        reference::render(reference::make_renderer(scene), view, settings_of_view(100, 100));
    if (filter == ShadowFilter::refined) {
      EXPECT_TRUE(same_bits(picture, expected));
    }
    expect_finite(picture, "degenerate triangles");
  }
}

TEST(RenderEdges, InsideAnObjectItsBacksAreInvisibleUnlessTheyAreTwoSided) {
  for (const bool is_double_sided : {false, true}) {
    Scene scene;
    reference::add_object(scene, "box", reference::box({0, 0, 0}, {1, 1, 1}));
    scene.materials.back().double_sided = is_double_sided;
    Light light;
    light.intensity = 5;
    reference::add_light(scene, light, {0.5, 0.5, 0.5}, {0, 0, 0});
    const LayeredImage picture =
        reference::render(reference::make_renderer(scene), reference::look({0.1, 0, 0}, {0, 0, -1}, 90, 1),
                          settings_of_view(64, 64, {Layer::depth}));
    for (std::size_t i = 0; i < picture.channels[0].values.size(); ++i) {
      ASSERT_EQ(picture.find("A")->values[i], is_double_sided ? 1.0F : 0.0F);
      ASSERT_EQ(picture.find("R")->values[i] > 0, is_double_sided);
    }
    expect_finite(picture, "inside");
  }
}

// A floor that passes under the camera and behind it: every pixel below the horizon sees it where the ray meets it.
TEST(RenderEdges, TrianglesThroughTheNearPlaneAreCutThere) {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(400, -1));
  Light sun;
  sun.type = LightType::directional;
  reference::add_light(scene, sun, {1, 3, 1}, {0, 0, 0});
  const Renderer renderer = reference::make_renderer(std::move(scene));
  for (const double near : {0.01, 0.5, 3.0}) {
    const View view = reference::look({0, 0, 0}, {0.3, -0.4, -1}, 80, 1, {0, 1, 0}, near, 1000);
    const LayeredImage picture =
        reference::render(renderer, view, settings_of_view(90, 90, {Layer::depth, Layer::position}));
    for (int y = 0; y < 90; ++y) {
      for (int x = 0; x < 90; ++x) {
        const double side = std::tan(40 * 3.14159265358979 / 180);
        const glm::dvec3 ray = view.pose.forward_ws() + view.pose.right_ws() * side * ((x + 0.5) / 45 - 1) -
                               view.pose.up_ws() * side * ((y + 0.5) / 45 - 1);
        const double z = -1 / ray.y;
        const glm::dvec3 hit = ray * z;
        const float depth = reference::at(picture, "Z", x, y);
        if (ray.y >= -1e-3 || std::abs(hit.x) > 399 || std::abs(hit.z) > 399) continue;
        if (z > near * 1.01) {
          ASSERT_NEAR(depth, z, 2e-5 * z) << x << ", " << y << " near " << near;
          ASSERT_NEAR(reference::at(picture, "P.Y", x, y), -1, 2e-5 * z);
        } else if (z < near * 0.99) {
          ASSERT_TRUE(std::isinf(depth)) << x << ", " << y << " near " << near;
        }
      }
    }
    expect_finite(picture, "near plane");
  }
}

// Lights in surfaces, on them and far away; mirrors; all models: nothing that is no number.
TEST(RenderEdges, BeautyIsFiniteWhereverLightsAndCamerasStand) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-2, 2);
  const glm::dvec3 places[] = {{0, 0, 0},       {0, 1, 0},     {0.5, 0.5, 0.5},
                               {1e-7, 1e-9, 0}, {0, -1e-6, 0}, {1e6, 2e6, 1e6}};
  for (const LightType type :
       {LightType::point, LightType::spot, LightType::directional, LightType::projector}) {
    for (const glm::dvec3& at : places) {
      Scene scene;
      reference::add_object(scene, "floor", reference::floor(4));
      scene.materials.back().double_sided = true;
      reference::add_object(scene, "mirror", reference::sphere({0, 0.5F, 0}, 0.5F, 24));
      scene.materials.back().metallic = 1;
      scene.materials.back().roughness = 0;
      Light light;
      light.type = type;
      light.intensity = 1e6;
      light.projection.near = 1e-6;
      light.shadow.resolution = 64;
      reference::add_light(scene, light, at, at + glm::dvec3(0.1, -1, 0.2));
      const Renderer renderer = reference::make_renderer(std::move(scene));
      for (const ShadingModel model : {ShadingModel::papers, ShadingModel::phong, ShadingModel::pbr}) {
        for (const ShadowTechnique technique : {ShadowTechnique::map, ShadowTechnique::raytraced}) {
          RenderSettings settings = settings_of_view(66, 50);
          settings.shading = model;
          settings.shadows = technique;
          const glm::dvec3 eye(place(random), place(random), place(random));
          const View view = reference::look(eye, {0, 0.3, 0}, 100, 1.3, {0, 1, 0.01}, 1e-5);
          expect_finite(reference::render(renderer, view, settings),
                        "light " + std::to_string(static_cast<int>(type)) + " at " + std::to_string(at.x) +
                            " model " + std::to_string(static_cast<int>(model)));
        }
      }
    }
  }
}

TEST(RenderEdges, PicturesThatHoldNoNumbersAreRefused) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float bad : {kInfinity, -kInfinity, std::nanf("")}) {
    Scene scene = everything();
    auto image = std::make_shared<Image>(8, 6, 3, PixelType::f32, Transfer::linear);
    image->values<float>()[3 * (8 * 4 + 5) + 2] = bad;
    Picture picture;
    picture.name = "broken.exr";
    picture.pixels = image;
    scene.pictures.push_back(picture);
    const int index = static_cast<int>(scene.pictures.size()) - 1;
    EXPECT_TRUE(Renderer::create(scene));  // nothing uses it
    for (const bool is_slide : {true, false}) {
      Scene with = scene;
      (is_slide ? with.lights.back().slide : with.materials[0].base_color_texture.picture) = index;
      const Result<Renderer> renderer = Renderer::create(std::move(with));
      ASSERT_FALSE(renderer);
      EXPECT_EQ(renderer.error().failure, Failure::bad_input);
      const std::string text = std::isnan(bad) ? "nan" : bad > 0 ? "inf" : "-inf";
      EXPECT_EQ(to_string(renderer.error()),
                "broken.exr: pixel 5, 4: expected finite numbers in a picture that is used, got " + text);
    }
  }
}

}  // namespace
}  // namespace laterna
