// Environments in scenes and pictures: layers, light meters, rigs, glTF, the cache, probes.
#include <gtest/gtest.h>

#include <fstream>
#include <glm/geometric.hpp>

#include "image/environment_cache.h"
#include "laterna/environment_probe.h"
#include "laterna/image_based_light.h"
#include "laterna/write_scene.h"
#include "reference/shapes.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace reference;
using namespace testing_scenes;

std::shared_ptr<const Image> plain_sky(glm::vec3 colour, int height = 4) {
  auto sky = std::make_shared<Image>(2 * height, height, 3, PixelType::f32, Transfer::linear);
  const auto values = sky->values<float>();
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = colour[static_cast<int>(i % 3)];
  return sky;
}

Scene room_under(const std::shared_ptr<const Image>& sky) {
  Scene scene;
  add_object(scene, "floor", floor(4, -1), {0.5F, 0.6F, 0.7F});
  add_object(scene, "ball", sphere({0, 0, 0}, 1, 24), {0.9F, 0.5F, 0.2F});
  add_object(scene, "pane", wall(1, 1, 1.5F));
  scene.materials[2].alpha_mode = AlphaMode::blend;
  scene.materials[2].base_color.a = 0.4F;
  Light lamp;
  lamp.name = "lamp";
  lamp.intensity = 20;
  add_light(scene, lamp, {2, 4, 1}, {0, 0, 0});
  scene.ambient = glm::vec3(0.1F);
  scene.pictures.push_back({});
  scene.pictures.back().pixels = sky;
  scene.environment.emplace();
  scene.environment->picture = 0;
  return scene;
}

const View kView = look({1, 2, 6}, {0, 0, 0}, 45, 1);

TEST(EnvironmentLayers, AddUpToThePictureBitForBit) {
  const Renderer renderer = make_renderer(room_under(plain_sky({0.3F, 0.5F, 0.9F})));
  for (const int samples : {1, 4}) {
    for (const Passes passes : {Passes::single, Passes::multi}) {
      for (const int accumulate : {1, 3}) {
        if (passes == Passes::multi && accumulate > 1) continue;
        RenderSettings settings = test_settings(48, 48);
        settings.samples = samples;
        settings.passes = passes;
        settings.accumulate = accumulate;
        const LayeredImage plain = reference::render(renderer, kView, settings);
        settings.layers = {Layer::light};
        const LayeredImage image = reference::render(renderer, kView, settings);
        for (const std::string channel : {"R", "G", "B"}) {
          EXPECT_EQ(plain.find(channel)->values, image.find(channel)->values);
          for (int i = 0; i < 48 * 48; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const float sum = image.find("ambient." + channel)->values[k] +
                              image.find("light.lamp." + channel)->values[k] +
                              image.find("environment." + channel)->values[k];
            ASSERT_EQ(image.find(channel)->values[k], sum);
          }
        }
      }
    }
  }
}

TEST(EnvironmentLayers, StandBehindTheScene) {
  Scene scene = room_under(plain_sky({0.3F, 0.5F, 0.9F}));
  scene.background = glm::vec3(7);
  const View up = look({0, 3, 0}, {0, 9, 0.1}, 45, 1);
  LayeredImage image = reference::render(make_renderer(scene), up, test_settings(8, 8));
  EXPECT_FLOAT_EQ(at(image, "B", 3, 3), 0.9F);
  EXPECT_EQ(at(image, "A", 3, 3), 1);
  scene.environment->visible = false;
  image = reference::render(make_renderer(scene), up, test_settings(8, 8));
  EXPECT_EQ(at(image, "B", 3, 3), 7);
  scene.background.reset();
  image = reference::render(make_renderer(scene), up, test_settings(8, 8));
  EXPECT_EQ(at(image, "A", 3, 3), 0);
}

// A picture may hold any finite number; what is too bright or less than dark is held to what sums can bear.
TEST(EnvironmentLayers, AreNumbersWhateverTheirPictureHolds) {
  for (const float extreme : {3e38F, -5.0F}) {
    const LayeredImage image = reference::render(make_renderer(room_under(plain_sky(glm::vec3(extreme)))),
                                                 kView, test_settings(16, 16));
    for (const char* channel : {"R", "G", "B"}) {
      for (const float value : image.find(channel)->values) {
        ASSERT_TRUE(std::isfinite(value)) << extreme;
        ASSERT_GE(value, 0) << extreme;
      }
    }
  }
}

// Lux is of direct lights alone; without an environment nothing else changes.
TEST(EnvironmentLayers, LightMetersLeaveItOut) {
  Scene scene = room_under(plain_sky(glm::vec3(3)));
  RenderSettings settings = test_settings(32, 32);
  settings.layers = {Layer::lux, Layer::visibility};
  const LayeredImage with = reference::render(make_renderer(scene), kView, settings);
  scene.environment.reset();
  const LayeredImage without = reference::render(make_renderer(scene), kView, settings);
  EXPECT_EQ(with.find("lux.Y")->values, without.find("lux.Y")->values);
  EXPECT_EQ(with.find("visibility.lamp")->values, without.find("visibility.lamp")->values);
  EXPECT_EQ(without.find("environment.R"), nullptr);
}

TEST(EnvironmentFiles, RigsNameThem) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_image(*plain_sky(glm::vec3(1)), folder / "sky.hdr").has_value());
  const Scene scene =
      load_or_fail({folder.write("s.gltf", triangle_builder().text())},
                   {.rigs = {folder.write(
                        "r.json", R"({"environment": {"image": "sky.hdr", "chart": "latlong", "exposure": 1,
         "rotation_deg": 90, "visible": false, "center": [1, 2, 3], "box": {"low": [0, 0, 0], "high": [4, 5, 6]}}})")}});
  ASSERT_TRUE(scene.environment.has_value());
  const Environment& e = *scene.environment;
  EXPECT_EQ(e.chart, EnvironmentChart::latlong);
  EXPECT_EQ(e.intensity, 2);
  EXPECT_FALSE(e.visible);
  EXPECT_EQ(e.distance, EnvironmentDistance::box);
  EXPECT_EQ(e.center_ws, glm::dvec3(1, 2, 3));
  EXPECT_EQ(e.box_high_ws, glm::dvec3(4, 5, 6));
  EXPECT_NEAR((e.world_from_environment * glm::dvec3(0, 0, -1)).x, -1, 1e-12);  // ahead goes to the left
  EXPECT_EQ(scene.pictures[static_cast<std::size_t>(e.picture)].file.filename(), "sky.hdr");
}

// EXT_lights_image_based: faces as seen from inside, +X red at a glance to the right, mips for roughness.
TEST(EnvironmentFiles, GltfImageBasedLight) {
  const TemporaryFolder folder;
  const glm::vec3 colours[6] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
  for (int face = 0; face < 6; ++face) {
    Image image(4, 4, 4, PixelType::u8, Transfer::srgb);
    for (std::size_t i = 0; i < 16; ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        image.values<std::uint8_t>()[4 * i + k] = colours[face][static_cast<int>(k)] > 0 ? 255 : 0;
      image.values<std::uint8_t>()[4 * i + 3] = 51;  // RGBD: divided by a fifth
    }
    ASSERT_TRUE(write_image(image, folder / ("face" + std::to_string(face) + ".png")).has_value());
  }
  json document = json::parse(triangle_builder().text());
  document["images"] = json::array();
  for (int face = 0; face < 6; ++face)
    document["images"].push_back({{"uri", "face" + std::to_string(face) + ".png"}});
  json light = {{"intensity", 0.5},
                {"rotation", {0, 0, 0, 1}},
                {"specularImageSize", 4},
                {"specularImages", {{0, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 4, 5}}},
                {"irradianceCoefficients", json::array()}};
  for (int i = 0; i < 9; ++i) light["irradianceCoefficients"].push_back({i == 0 ? 2 : 0, 0, 0});
  document["extensions"]["EXT_lights_image_based"]["lights"] = json::array({light});
  document["extensionsUsed"] = {"EXT_lights_image_based"};
  document["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
  const Scene scene = load_or_fail({folder.write("ibl.gltf", document.dump())});
  ASSERT_TRUE(scene.environment.has_value());
  EXPECT_EQ(scene.environment->specular_pictures.size(), 2U);
  EXPECT_EQ((*scene.environment->irradiance)[0], glm::dvec3(2, 0, 0));
  EXPECT_EQ(warnings_of(scene), "");
  const Renderer renderer = make_renderer(scene);
  const glm::dvec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int face = 0; face < 6; ++face) {
    const View view = look({0, 0, 9}, glm::dvec3(0, 0, 9) + axes[face], 10, 1, {0.1, 0.7, 0.7}, 10);
    const LayeredImage image = reference::render(renderer, view, test_settings(9, 9));
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(at(image, std::string(1, "RGB"[k]), 4, 4), colours[face][k] * 2.5F, 1e-5) << face;
  }
}

// A sky that changes evenly from side to side, whose light is known in closed form: 0.5 + 0.4 d of red toward +X, green toward
// +Y and blue toward +Z. A surface toward n gets π (0.5 + 0.4 · ⅔ n) of it.
glm::dvec3 even_sky(const glm::dvec3& direction) { return 0.5 + 0.4 * glm::normalize(direction); }

// EXT_lights_image_based has OpenGL's faces (OpenGL 4.6, table 8.19), each flipped about its vertical axis. (s, t) from the
// picture's top left.
glm::dvec3 direction_of_face(int face, double s, double t) {
  const double sc = 1 - 2 * s, tc = 2 * t - 1;
  const std::array<glm::dvec3, 6> directions = {
      {{1, -tc, -sc}, {-1, -tc, sc}, {sc, 1, tc}, {sc, -1, -tc}, {sc, -tc, 1}, {-sc, -tc, -1}}};
  return directions[static_cast<std::size_t>(face)];
}

// Its harmonics as the extension's source (Ramamoorthi & Hanrahan 2001) has them: E = Σ L_lm Y_lm of the normal, with
// Y₀₀ = 0.282095 and Y₁₋₁, Y₁₀, Y₁₁ = 0.488603 (y, z, x).
std::array<glm::dvec3, 9> even_sky_irradiance() {
  const double pi = 3.14159265358979323846, mean = 0.5 * pi / 0.2820947918,
               slope = 0.4 * 2 * pi / 3 / 0.4886025119;
  return {glm::dvec3(mean), {0, slope, 0}, {0, 0, slope}, {slope, 0, 0}};
}

TEST(EnvironmentFiles, GltfFacesAndHarmonicsAreTheRightWayRound) {
  constexpr int kSide = 32;
  constexpr glm::vec3 kBox(5, 30, 20);  // where none of the directions below looks
  const TemporaryFolder folder;
  json document = json::parse(triangle_builder().text());
  document["images"] = json::array();
  for (int face = 0; face < 6; ++face) {
    Image image(kSide, kSide, 3, PixelType::u8, Transfer::srgb);
    for (int i = 0; i < kSide * kSide; ++i) {
      const glm::dvec3 light =
          even_sky(direction_of_face(face, (i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide));
      for (int k = 0; k < 3; ++k) {
        const double c = light[k];  // above the curve's straight part
        image.values<std::uint8_t>()[static_cast<std::size_t>(3 * i + k)] =
            static_cast<std::uint8_t>(std::lround(255 * (1.055 * std::pow(c, 1 / 2.4) - 0.055)));
      }
    }
    const std::string name = "face" + std::to_string(face) + ".png";
    ASSERT_TRUE(write_image(image, folder / name).has_value());
    document["images"].push_back({{"uri", name}});
  }
  json light = {{"specularImageSize", kSide},
                {"specularImages", {{0, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 4, 5}}},
                {"irradianceCoefficients", json::array()}};
  for (const glm::dvec3& c : even_sky_irradiance())
    light["irradianceCoefficients"].push_back({c.x, c.y, c.z});
  document["extensions"]["EXT_lights_image_based"]["lights"] = json::array({light});
  document["extensionsUsed"] = {"EXT_lights_image_based"};
  document["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
  Scene scene = load_or_fail({folder.write("ibl.gltf", document.dump())});
  add_object(scene, "box", box(kBox, glm::vec3(0.5F)));
  const Renderer renderer = make_renderer(scene);
  RenderSettings settings = test_settings(9, 9);
  settings.shading = ShadingModel::papers;
  for (int i = 0; i < 27; ++i) {
    const glm::dvec3 toward(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (toward == glm::dvec3(0)) continue;
    const View view = look({0, 0, 9}, glm::dvec3(0, 0, 9) + toward, 10, 1, {0.1, 0.7, 0.6}, 2);
    const LayeredImage image = reference::render(renderer, view, settings);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(at(image, std::string(1, "RGB"[k]), 4, 4), even_sky(toward)[k], 0.01) << i << ' ' << k;
  }
  for (int face = 0; face < 6; ++face) {
    const glm::dvec3 normal = direction_of_face(face, 0.5, 0.5);
    const View view = look(glm::dvec3(kBox) + 3.0 * normal, kBox, 10, 1, {0.1, 0.7, 0.6}, 2);
    const LayeredImage image = reference::render(renderer, view, settings);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(at(image, std::string(1, "RGB"[k]), 4, 4), 0.5 + 0.4 * 2 / 3 * normal[k], 1e-4)
          << face << ' ' << k;
    }
  }
}

TEST(EnvironmentFiles, GltfFacesAndHarmonicsAreWrittenTheRightWayRound) {
  constexpr int kWidth = 128;
  auto sky = std::make_shared<Image>(kWidth, kWidth / 2, 3, PixelType::f32, Transfer::linear);
  for (int i = 0; i < kWidth * kWidth / 2; ++i) {
    // Its middle looks along −Z, and to the right is +X.
    const double azimuth = ((i % kWidth + 0.5) / kWidth - 0.5) * 2 * 3.14159265358979323846;
    const double height = (0.5 - (i / kWidth + 0.5) / (kWidth / 2)) * 3.14159265358979323846;
    const glm::dvec3 light = even_sky(
        {std::sin(azimuth) * std::cos(height), std::sin(height), -std::cos(azimuth) * std::cos(height)});
    for (int k = 0; k < 3; ++k)
      sky->values<float>()[static_cast<std::size_t>(3 * i + k)] = static_cast<float>(light[k]);
  }
  Scene scene;
  add_object(scene, "box", box({0, 0, 0}, glm::vec3(0.5F)));
  scene.pictures.push_back({});
  scene.pictures.back().pixels = sky;
  scene.environment.emplace();
  scene.environment->picture = 0;
  ASSERT_TRUE(filter_environment(scene, {32}).has_value());
  const std::array<glm::dvec3, 9> expected = even_sky_irradiance();
  for (std::size_t i = 0; i < 9; ++i) {
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR((*scene.environment->irradiance)[i][k], expected[i][k], 0.01) << i << ' ' << k;
  }
  for (int face = 0; face < 6; ++face) {
    const int picture = scene.environment->specular_pictures[0][static_cast<std::size_t>(face)];
    const Image& image = *scene.pictures[static_cast<std::size_t>(picture)].pixels;
    for (const int x : {1, 30}) {
      for (const int y : {1, 30}) {
        const glm::dvec3 light = even_sky(direction_of_face(face, (x + 0.5) / 32, (y + 0.5) / 32));
        for (int k = 0; k < 3; ++k) {
          const double c = image.value(x, y, k);
          const double linear = std::pow((c + 0.055) / 1.055, 2.4) / image.value(x, y, 3);
          EXPECT_NEAR(linear, light[k], 0.01) << face << ' ' << x << ' ' << y << ' ' << k;
        }
      }
    }
  }
}

// Written as EXT_lights_image_based and read back, balls of three roughnesses look as they did: directions, brightness far
// above white, the turn and the harmonics' signs. What is left are faces of 8 bits.
TEST(EnvironmentFiles, GltfImageBasedLightIsWritten) {
  const TemporaryFolder folder;
  auto sky = std::make_shared<Image>(64, 32, 3, PixelType::f32, Transfer::linear);
  const auto values = sky->values<float>();
  for (std::size_t i = 0; i < values.size() / 3; ++i) {
    const auto d = direction_from_image(
        EnvironmentChart::latlong,
        {(static_cast<double>(i % 64) + 0.5) / 64, (static_cast<double>(i / 64) + 0.5) / 32});
    const double window = glm::dot(*d, glm::normalize(glm::dvec3(-2, 1, 1))) > 0.9 ? 40 : 0;
    values[3 * i] = static_cast<float>(0.5 + 0.4 * d->x + window);
    values[3 * i + 1] = static_cast<float>(0.5 + 0.4 * d->y + window);
    values[3 * i + 2] = static_cast<float>(0.5 - 0.4 * d->z);
  }
  Scene scene;
  for (int i = 0; i < 3; ++i) {
    add_object(scene, "ball", sphere({2.2F * static_cast<float>(i - 1), 0, 0}, 1, 32), {0.9F, 0.8F, 0.7F});
    scene.materials.back().metallic = i == 2 ? 0.0F : 1.0F;
    scene.materials.back().roughness = 0.5F * static_cast<float>(i);
  }
  scene.pictures.push_back({});
  scene.pictures.back().pixels = sky;
  scene.environment.emplace();
  scene.environment->picture = 0;
  scene.environment->intensity = 0.7;
  scene.environment->world_from_environment = {0, 0, -1, 0, 1, 0, 1, 0, 0};
  const View view = look({1, 2, 8}, {0, 0, 0}, 45, 1);
  RenderSettings settings = test_settings(64, 64);
  settings.shading = ShadingModel::pbr;
  const LayeredImage before = reference::render(make_renderer(scene), view, settings);

  ASSERT_TRUE(filter_environment(scene, {128}).has_value());
  ASSERT_EQ(scene.environment->specular_pictures.size(), 4U);
  const auto written = write_scene(scene, folder / "lit.glb");
  ASSERT_TRUE(written.has_value());
  EXPECT_TRUE(written->empty());
  const Scene read = load_or_fail({folder / "lit.glb"});
  ASSERT_TRUE(read.environment.has_value());
  EXPECT_EQ(*read.environment->irradiance, *scene.environment->irradiance);
  const LayeredImage after = reference::render(make_renderer(read), view, settings);
  double error = 0, sum = 0;
  for (const char* channel : {"R", "G", "B"}) {
    const std::vector<float>&a = before.find(channel)->values, &b = after.find(channel)->values;
    for (std::size_t i = 0; i < a.size(); ++i) {
      error += std::abs(a[i] - b[i]);
      sum += a[i];
    }
  }
  EXPECT_LT(error / sum, 0.02);
  EXPECT_FALSE(filter_environment(scene, {100}).has_value());
}

TEST(EnvironmentCache, KeepsWhatIsWholeAndNothingElse) {
  const TemporaryFolder folder;
  const image::EnvironmentCache cache(folder / "kept", std::uint64_t{1} << 20);
  image::EnvironmentMap map;
  std::vector<glm::vec3> texels(64, glm::vec3(0.5F, 1, 2));
  map.mirrored.set(map.mirrored.add_level(8), texels);
  map.mirrored.add_level(4);
  map.irradiance[3] = {1, 2, 3};
  const image::ContentKey key = image::environment_key(EnvironmentChart::latlong, 8, 8, texels);
  EXPECT_FALSE(cache.find(key).has_value());
  cache.keep(key, map);
  const auto found = cache.find(key);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(std::vector<float>(found->mirrored.g.begin(), found->mirrored.g.end()),
            std::vector<float>(map.mirrored.g.begin(), map.mirrored.g.end()));
  EXPECT_EQ(found->irradiance[3], glm::dvec3(1, 2, 3));
  texels[5].x += 1e-6F;
  EXPECT_FALSE(cache.find(image::environment_key(EnvironmentChart::latlong, 8, 8, texels)).has_value());
  // Every truncation, and every byte changed, is as if nothing had been kept.
  const std::filesystem::path file = folder / "kept" / (key.text() + ".environment");
  std::ifstream in(file, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  const auto write = [&](const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; };
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    write(whole.substr(0, length));
    EXPECT_FALSE(cache.find(key).has_value()) << length;
  }
  for (std::size_t at_byte = 0; at_byte < whole.size(); at_byte += 11) {
    std::string damaged = whole;
    damaged[at_byte] = static_cast<char>(damaged[at_byte] ^ 4);
    write(damaged);
    EXPECT_FALSE(cache.find(key).has_value()) << at_byte;
  }
  write(whole);
  EXPECT_TRUE(cache.find(key).has_value());
}

TEST(EnvironmentCache, StaysWithinItsSize) {
  const TemporaryFolder folder;
  image::EnvironmentMap map;
  map.mirrored.add_level(16);  // 4 kB
  const image::EnvironmentCache cache(folder.path(), 10000);
  for (std::uint64_t i = 0; i < 6; ++i) {
    image::ContentKey key;
    key.add(i);
    cache.keep(key, map);
    EXPECT_TRUE(cache.find(key).has_value());
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
  const image::EnvironmentCache unwritable("/proc/nowhere", 10000);
  unwritable.keep({}, map);
  EXPECT_FALSE(unwritable.find({}).has_value());
}

// With the cache a scene looks the same.
TEST(EnvironmentCache, ChangesNoPicture) {
  const TemporaryFolder folder;
  RendererOptions options;
  options.environment_cache = folder.path();
  int steps = 0;
  options.environment_progress = [&](double) { return ++steps > 0; };
  const auto picture = [&] {
    const auto renderer = Renderer::create(room_under(plain_sky({1, 2, 3}, 8)), options);
    return renderer ? reference::render(*renderer, kView, test_settings(32, 32)).find("G")->values
                    : std::vector<float>();
  };
  const std::vector<float> first = picture();
  EXPECT_GT(std::exchange(steps, 0), 0);
  EXPECT_EQ(picture(), first);
  EXPECT_EQ(steps, 0);  // nothing was worked out again
  EXPECT_FALSE(first.empty());
}

// What a point of a scene sees: a red wall at the right, a green one at the left, blue above, nothing elsewhere.
TEST(EnvironmentProbeTest, LooksToAllSides) {
  Scene scene;
  add_object(scene, "right", box({5, 0, 0}, {0.1F, 9, 9}), {1, 0, 0});
  add_object(scene, "left", box({-5, 0, 0}, {0.1F, 9, 9}), {0, 1, 0});
  add_object(scene, "above", box({0, 5, 0}, {4, 0.1F, 4}), {0, 0, 1});
  scene.ambient = glm::vec3(1);
  scene.ambient_is_set = true;
  const Renderer renderer = make_renderer(scene);
  RenderSettings settings = test_settings(1, 1);
  const auto cube = render_environment(renderer, {{0, 0, 0}, 16}, settings);
  ASSERT_TRUE(cube.has_value());
  const auto sky = convert_environment(*cube, {EnvironmentChart::cube, EnvironmentChart::latlong, 32, 1});
  ASSERT_TRUE(sky.has_value());
  const auto seen = [&](glm::dvec3 direction, const char* channel) {
    const glm::dvec2 position = image_from_direction(EnvironmentChart::latlong, direction);
    return at(*sky, channel, static_cast<int>(position.x * 63.99), static_cast<int>(position.y * 31.99));
  };
  EXPECT_NEAR(seen({1, 0, 0.1}, "R"), 1, 1e-3);
  EXPECT_NEAR(seen({-1, 0, 0.1}, "G"), 1, 1e-3);
  EXPECT_NEAR(seen({0.1, 1, 0}, "B"), 1, 1e-3);
  EXPECT_NEAR(seen({0, -1, 0.1}, "R") + seen({0, -1, 0.1}, "G") + seen({0, -1, 0.1}, "B"), 0, 1e-3);
  EXPECT_FALSE(render_environment(renderer, {{0, 0, 0}, 0}, settings).has_value());
}

}  // namespace
}  // namespace laterna
