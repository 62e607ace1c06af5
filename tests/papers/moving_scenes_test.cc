// Document 004's moving models: rows 43 to 45 of the papers' list, and row 77 where things move.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "frame/flatten.h"
#include "reference/everything.h"
#include "reference/shapes.h"
#include "scene/scene_pose.h"

namespace laterna {
namespace {

// The model that Debian's assimp-testmodels and the shared scenes have.
std::filesystem::path model() {
  for (const std::filesystem::path& folder : {std::filesystem::path("/usr/share/assimp/models/MD2"),
                                              std::filesystem::path(LATERNA_SHARED_DIR) / "scenes/md2"}) {
    if (std::filesystem::exists(folder / "sydney.md2")) return folder / "sydney.md2";
  }
  return {};
}

// A decoder of its own: corners of all triangles of a frame, Quake's axes turned so that y is up.
std::vector<std::array<glm::dvec3, 3>> decode_frame(const std::string& bytes, std::size_t frame) {
  const auto number = [&](std::size_t at) {
    std::int32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return static_cast<std::size_t>(value);
  };
  const char* data = bytes.data() + number(56) + frame * number(16);
  float scale[3], offset[3];
  std::memcpy(scale, data, 12);
  std::memcpy(offset, data + 12, 12);
  std::vector<std::array<glm::dvec3, 3>> triangles;
  for (std::size_t t = 0; t < number(32); ++t) {
    std::array<glm::dvec3, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint16_t vertex = 0;
      std::memcpy(&vertex, bytes.data() + number(52) + 12 * t + 2 * k, 2);
      const auto* at = reinterpret_cast<const std::uint8_t*>(data + 40 + 4 * std::size_t{vertex});
      const glm::dvec3 p(at[0] * scale[0] + offset[0], at[1] * scale[1] + offset[1],
                         at[2] * scale[2] + offset[2]);
      triangle[k] = {p.x, p.z, -p.y};
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

// How far the corners of a triangle are from those of another, which may begin with another corner and run the other way.
double distance(const std::array<glm::dvec3, 3>& a, const std::array<glm::dvec3, 3>& b) {
  constexpr std::size_t kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  double least = 1e30;
  for (const auto& order : kOrders) {
    double most = 0;
    for (std::size_t k = 0; k < 3; ++k) most = std::max(most, glm::length(a[k] - b[order[k]]));
    least = std::min(least, most);
  }
  return least;
}

// Row 43: all key frames, and what lies between them.
TEST(MovingScenes, VerticesOfAnMd2AreThoseOfAReferenceDecoder) {
  if (model().empty()) GTEST_SKIP() << "no sydney.md2";
  std::ifstream stream(model(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  Scene scene = load_scene({model()}).value();
  ASSERT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(scene.meshes[0].primitives[0].targets.size(), 197U) << "198 frames";
  double all = 0;
  std::string names;
  for (const Clip& clip : scene.clips) {
    all += duration(clip);
    names += clip.name + " ";
  }
  EXPECT_NEAR(all, 19.8, 1e-9) << "ten frames a second, and from the last one back to the first";
  EXPECT_EQ(names.substr(0, 29), "stand run attack pain jump fl");
  const TaskPool pool(1);
  ASSERT_TRUE(choose_clip(scene, "run"));  // frames 40 to 45
  const ScenePose poses(scene);
  for (const double frames : {0.0, 1.0, 2.5, 5.0, 5.25}) {
    poses.apply(scene, frames / 10);
    const reference::OwnedFrame owned = reference::make_frame(scene);
    const auto first = static_cast<std::size_t>(frames);
    const auto from = decode_frame(bytes, 40 + first), to = decode_frame(bytes, 40 + (first + 1) % 6);
    const double part = frames - static_cast<double>(first);
    std::vector<bool> is_found(from.size(), false);
    std::size_t triangles = 0;
    double worst = 0;
    for (std::uint32_t c = 0; c < owned.frame.clusters.size(); ++c) {
      for (std::uint32_t t = 0; t < owned.frame.clusters[c].triangle_count; ++t, ++triangles) {
        const TriangleId id = c << kTriangleBits | t;
        const std::array<glm::dvec3, 3> found = {owned.frame.corner_ws(id, 0), owned.frame.corner_ws(id, 1),
                                                 owned.frame.corner_ws(id, 2)};
        double nearest = 1e30;
        for (std::size_t i = 0; i < from.size() && nearest > 1e-4; ++i) {
          std::array<glm::dvec3, 3> expected;
          for (std::size_t k = 0; k < 3; ++k) expected[k] = glm::mix(from[i][k], to[i][k], part);
          const double apart = distance(found, expected);
          if (apart < nearest && !is_found[i]) {
            nearest = apart;
            if (apart <= 1e-4) is_found[i] = true;
          }
        }
        worst = std::max(worst, nearest);
      }
    }
    EXPECT_EQ(triangles, from.size());
    EXPECT_LT(worst, 1e-5) << "at frame " << frames << ", of coordinates up to 40";
  }
}

// Row 43: the shadow is that of the pose. Rays see the posed triangles too.
TEST(MovingScenes, TheShadowFollowsThePose) {
  if (model().empty()) GTEST_SKIP() << "no sydney.md2";
  LoadOptions options;
  options.metres_per_unit = 0.04;
  Scene scene = load_scene({model()}, options).value();
  ASSERT_TRUE(choose_clip(scene, "jump"));
  reference::add_object(scene, "floor", reference::floor(4, -0.98F));
  Light sun;
  sun.name = "sun";
  sun.type = LightType::directional;
  reference::add_light(scene, sun, {2, 5, 1}, {0, 0, 0});
  scene.ambient_is_set = true;
  RenderSettings settings = reference::test_settings(160, 120);
  settings.layers = {Layer::visibility, Layer::object};
  Renderer renderer = reference::make_renderer(scene);
  const View camera = reference::look({1, 6, 4}, {-0.5, -1, 0}, 35, 4.0 / 3);
  std::vector<float> before;
  for (const double time : {0.0, 0.25}) {
    ASSERT_TRUE(renderer.set_time(time));
    settings.shadows = ShadowTechnique::exact;
    const LayeredImage found = reference::render(renderer, camera, settings);
    settings.shadows = ShadowTechnique::raytraced;
    const LayeredImage truth = reference::render(renderer, camera, settings);
    int dark = 0, differ = 0, changed = 0;
    const std::vector<float>& alpha = found.find("visibility.sun")->values;
    for (std::size_t i = 0; i < alpha.size(); ++i) {
      if (found.find("id.object")->values[i] != 1) continue;  // the floor
      dark += alpha[i] == 0 ? 1 : 0;
      differ += alpha[i] != truth.find("visibility.sun")->values[i] ? 1 : 0;
      changed += !before.empty() && alpha[i] != before[i] ? 1 : 0;
    }
    EXPECT_GT(dark, 60);
    EXPECT_LE(differ, dark / 50);
    EXPECT_TRUE(before.empty() || changed > 20) << "it moves";
    before = alpha;
  }
}

// Row 45: a receiver slides under a shadow, which stays where it is in the world; and so does the slide of a projector. Row 77: what
// casts no shadow may move without a map being drawn again.
TEST(MovingScenes, ShadowsAndSlidesStayPutOnAMovingReceiver) {
  Scene scene;
  const int carpet = reference::add_object(scene, "carpet", reference::floor(5));
  reference::add_object(scene, "box", reference::box({0, 1, 0}, {0.5F, 0.2F, 0.5F}));
  Node& node = scene.nodes[static_cast<std::size_t>(carpet)];
  node.casts_shadow = false;
  node.transform = Transform{};
  Light lantern;
  lantern.name = "lantern";
  lantern.type = LightType::projector;
  lantern.intensity = 100;
  lantern.slide =
      reference::add_picture(scene, 16, 16, [](int x, int y) { return glm::u8vec3(x * 16, y * 16, 128); });
  reference::add_light(scene, lantern, {1, 5, 1}, {0, 0, 0});
  Clip& clip = scene.clips.emplace_back();
  clip.keys.push_back({KeyInterpolation::linear, {0, 1}, {0, 0, 0, 0.7, 0, -0.4}});
  ClipChannel channel;
  channel.target = carpet;
  channel.keys = 0;
  clip.channels.push_back(channel);
  Renderer renderer = reference::make_renderer(scene);
  RenderSettings settings = reference::test_settings(120, 90);
  settings.layers = {Layer::visibility, Layer::uv, Layer::position};
  const View camera = reference::look({0, 6, 4}, {0, 0, 0}, 30, 4.0 / 3);  // the carpet fills the picture
  const LayeredImage still = reference::render(renderer, camera, settings);
  for (const double time : {0.3, 0.9}) {
    ASSERT_TRUE(renderer.set_time(time));
    RenderStatistics statistics;
    const LayeredImage moved = renderer.render(camera, settings, {}, &statistics).value();
    EXPECT_EQ(statistics.maps_drawn, 0);
    EXPECT_EQ(renderer.bounds().high_ws.x, static_cast<double>(static_cast<float>(5 + 0.7 * time)));
    int shaded = 0;
    for (std::size_t i = 0; i < still.find("R")->values.size(); ++i) {
      const float alpha = still.find("visibility.lantern")->values[i];
      shaded += alpha == 0 ? 1 : 0;
      EXPECT_EQ(moved.find("visibility.lantern")->values[i], alpha);
      for (const char* name : {"uv.lantern.u", "uv.lantern.v"}) {
        const float at = still.find(name)->values[i];
        EXPECT_FALSE(std::abs(moved.find(name)->values[i] - at) > 1e-5F) << "NaN where no slide is";
      }
    }
    EXPECT_GT(shaded, 200);
  }
}

}  // namespace
}  // namespace laterna
