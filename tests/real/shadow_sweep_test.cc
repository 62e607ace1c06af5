// Shadow maps with default settings on every scene of the shared collection, with lights placed by a rule, against rays.
// By hand, with every scene, larger pictures and a table: LATERNA_FULL_SWEEP=1 real_tests --gtest_filter='*ShadowSweep*'.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "reference/placed_lights.h"
#include "reference/shadow_truth.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using namespace reference;

const std::filesystem::path kScenes = std::filesystem::path(LATERNA_SHARED_DIR) / "scenes";

bool is_full_sweep() { return std::getenv("LATERNA_FULL_SWEEP") != nullptr; }

struct SweptScene {
  const char* file;
  bool is_large = false;  // takes long to read or to trace
};

std::string name_of(const testing::TestParamInfo<SweptScene>& info) {
  std::string name = info.param.file;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

class ShadowSweep : public testing::TestWithParam<SweptScene> {};

TEST_P(ShadowSweep, NoFalseShadowsAndNoGaps) {
  const std::filesystem::path file = kScenes / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  if (GetParam().is_large && !is_full_sweep()) GTEST_SKIP() << "large: only in the full sweep";
  const Result<Scene> loaded = load_scene({file});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const RenderSettings settings = is_full_sweep() ? test_settings(640, 480) : test_settings(160, 120);
  for (const char* light : kPlacedLights) {
    Scene scene = *loaded;
    place_lights(scene, light);
    const Renderer renderer = make_renderer(std::move(scene));
    int number = 0;
    for (const View& view : placed_views(renderer, settings.width, settings.height)) {
      const ShadowErrors errors = find_shadow_errors(draw_shadow_masks(renderer, view, settings, light, 3));
      const char* from = number++ == 0 ? "outside" : "inside";
      const std::string line =
          fmt::format("{} from {}: {}", light, from, errors.pixels == 0 ? "nothing lit" : to_string(errors));
      SCOPED_TRACE(line);
      if (is_full_sweep()) fmt::print("{:45} {}\n", GetParam().file, line);
      EXPECT_EQ(errors.far_false_dark, 0) << "acne";
      EXPECT_LT(errors.contact_gap, 2);
    }
  }
}

const SweptScene kSwept[] = {
    {"sponza/sponza_dabrovic.gltf"},
    {"sponza/Sponza_LowPoly.gltf"},
    {"flighthelmet/FlightHelmet.gltf", true},
    {"ww2-cityscene/scene.gltf", true},
    {"architecture/dream-apartment.glb", true},
    {"architecture/house.glb"},
    {"architecture/vr-gallery.glb"},
    {"architecture/VolumetricFogExample.glb"},
    {"architecture/japanese-bridge-garden.glb"},
    {"trees/PalmTree/PalmTree.gltf"},
    {"trees/oaktree.gltf"},
    {"trees/low-poly-tree.glb"},
    {"glb/DamagedHelmet.glb", true},
    {"glb/statue.glb"},
    {"features/lights_dir_point_spot.glb"},
    {"features/geometry-camera-light.glb"},
    {"features/CesiumMan/CesiumMan.gltf"},
    {"features/Fox.glb"},
    {"features/MorphStressTest.glb"},
    {"features/draco_heart.glb"},
    {"features/draco_2CylinderEngine/2CylinderEngine.gltf"},
    {"features/meshopt_pirate.glb"},
    {"features/NormalTangentTest.glb", true},
    {"features/InterpolationTest/InterpolationTest.gltf"},
    {"features/all_animations/03_all_animations.gltf"},
    {"features/alpha_blend/01_alpha_blend.gltf"},
    {"features/vertex_count_32bit/01_vertex_count_32bit.gltf", true},
    {"features/CubeImageUriSpaces/CubeImageUriSpaces.gltf"},
    {"features/TextureSettingsTest/TextureSettingsTest.gltf"},
    {"features/VertexColorTest/VertexColorTest.gltf"},
    {"features/UnlitTest/UnlitTest.gltf"},
    {"md2/sydney.md2"},
    {"md2/faerie.md2"},
    {"meshes/dragon_vrip_res2.ply", true},
    {"meshes/stanford-bunny.obj"},
    {"meshes/nefertiti.obj", true},
    {"meshes/teapot.obj"},
    {"meshes/suzanne.obj"},
    {"meshes/spot.obj"},
    {"photogrammetry/sceaux_castle/scene_mesh.ply"},
    {"photogrammetry/sceaux_castle/scene_mesh_refine.ply", true},
};

INSTANTIATE_TEST_SUITE_P(Files, ShadowSweep, testing::ValuesIn(kSwept), name_of);

}  // namespace
}  // namespace laterna
