// Animated files at many instants: every vertex against a reference in double precision, and pictures against those of renderers made
// at the time.
#include <gtest/gtest.h>

#include <filesystem>

#include "frame/flatten.h"
#include "reference/animated_gltf.h"
#include "reference/everything.h"
#include "reference/shapes.h"
#include "scene/scene_pose.h"

namespace laterna {
namespace {

std::filesystem::path feature(const std::string& name) {
  return std::filesystem::path(LATERNA_SHARED_DIR) / "scenes/features" / name;
}

struct AnimatedFile {
  const char* name;
  const char* file;
  std::size_t clips;
};

std::string file_name(const testing::TestParamInfo<AnimatedFile>& info) { return info.param.name; }

constexpr AnimatedFile kFiles[] = {
    {"CesiumMan", "CesiumMan/CesiumMan.gltf", 1},
    {"Fox", "Fox.glb", 3},
    {"AnimatedMorphCube", "AnimatedMorphCube/AnimatedMorphCube.gltf", 1},
    {"MorphStressTest", "MorphStressTest.glb", 3},
    {"SparseMorphTargets", "SparseMorphTargets.glb", 1},
    {"InterpolationTest", "InterpolationTest/InterpolationTest.gltf", 9},
    {"AllAnimations", "all_animations/03_all_animations.gltf", 3},
};

// A frame whose pose is changed again and again.
class PosedFrame {
 public:
  explicit PosedFrame(Scene scene) : scene_(std::move(scene)), pose_(scene_), pool_(2) {
    meshes_ = frame::build_clusters(scene_, pool_);
    auto textures =
        std::make_shared<const frame::TextureLibrary>(frame::TextureLibrary::load(scene_, pool_).value());
    frame_ = frame::Frame::build(scene_, textures, meshes_, pool_).value();
  }

  void set_time(double time) {
    pose_.apply(scene_, time);
    ASSERT_TRUE(frame_.repose(scene_, pool_));
  }

  [[nodiscard]] const frame::Frame& frame() const { return frame_; }

  // Corners of the part's triangles as the scene lists them.
  static std::vector<glm::dvec3> corners(const frame::PlacedPart& part, const frame::Frame& frame) {
    std::vector<glm::dvec3> vertices(part.primitive->positions.size());
    for (std::size_t i = 0; i < part.clustered->source_vertices.size(); ++i) {
      const std::size_t at = part.first_vertex + i;
      vertices[part.clustered->source_vertices[i]] = frame.positions_ws[at];
    }
    if (part.primitive->indices.empty()) return vertices;
    std::vector<glm::dvec3> corners;
    for (const std::uint32_t index : part.primitive->indices) corners.push_back(vertices[index]);
    return corners;
  }

 private:
  Scene scene_;
  ScenePose pose_;
  TaskPool pool_;
  frame::ClusteredMeshes meshes_;
  frame::Frame frame_;
};

class AnimationFiles : public testing::TestWithParam<AnimatedFile> {};

TEST_P(AnimationFiles, VerticesAreWhereTheReferenceHasThem) {
  const std::filesystem::path file = feature(GetParam().file);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const std::vector<double> lengths = reference::clip_lengths(file);
  ASSERT_EQ(lengths.size(), GetParam().clips);
  for (std::size_t clip = 0; clip < lengths.size(); ++clip) {
    Scene scene = load_scene({file}).value();
    ASSERT_EQ(scene.clips.size(), lengths.size());
    for (std::size_t i = 0; i < scene.clips.size(); ++i) scene.clips[i].plays = i == clip;
    EXPECT_DOUBLE_EQ(duration(scene.clips[clip]), lengths[clip]);
    PosedFrame posed(std::move(scene));
    std::size_t compared = 0;
    double worst = 0, extent = 0;
    for (const double part : {0.0, 0.13, 0.5, 0.77, 0.999, 1.4}) {
      const double time = part * lengths[clip];
      posed.set_time(time);
      std::vector<std::vector<glm::dvec3>> expected;
      for (const reference::AnimatedNode& node : reference::pose_gltf(file, clip, time))
        expected.insert(expected.end(), node.corners.begin(), node.corners.end());
      // Of these the frame keeps apart what the clip moves.
      std::size_t next = 0;
      for (const frame::PlacedPart& part_of_frame : posed.frame().moving_parts) {
        const std::vector<glm::dvec3> found = PosedFrame::corners(part_of_frame, posed.frame());
        const auto distance = [&](const std::vector<glm::dvec3>& other) {
          double most = other.size() == found.size() ? 0 : 1e30;
          for (std::size_t i = 0; i < found.size() && most < 1e30; ++i)
            most = std::max(most, glm::length(found[i] - other[i]));
          return most;
        };
        double nearest = 1e30;
        for (; next < expected.size() && nearest > 1e-3; ++next) nearest = distance(expected[next]);
        worst = std::max(worst, nearest);
        for (const glm::dvec3& p : found) extent = std::max(extent, glm::length(p));
        compared += found.size();
      }
    }
    EXPECT_GE(compared, 72U) << "six times a tetrahedron at least";
    // Single precision, of coordinates as large as these, and of weights of morph targets.
    EXPECT_LT(worst, extent * 2.4e-7) << "clip " << clip;
  }
}

TEST_P(AnimationFiles, EveryFrameIsThatOfARendererMadeThen) {
  const std::filesystem::path file = feature(GetParam().file);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  Scene scene = load_scene({file}).value();
  ASSERT_TRUE(choose_clip(scene, "all"));
  Renderer moving = Renderer::create(scene).value();
  const RenderSettings settings = reference::test_settings(64, 48);
  const View view = moving.overview(64, 48);
  for (const double time : {0.37, 1.61, 0.21}) {
    ASSERT_TRUE(moving.set_time(time));
    RendererOptions options;
    options.time = time;
    const Renderer fresh = Renderer::create(scene, options).value();
    EXPECT_TRUE(reference::same_bits(reference::render(moving, view, settings),
                                     reference::render(fresh, view, settings)));
    EXPECT_EQ(moving.bounds().low_ws, fresh.bounds().low_ws);
    EXPECT_EQ(moving.bounds().high_ws, fresh.bounds().high_ws);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, AnimationFiles, testing::ValuesIn(kFiles), file_name);

}  // namespace
}  // namespace laterna
