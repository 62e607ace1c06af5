// Real scenes: what is written is what is read.
#include <gtest/gtest.h>

#include "laterna/write_scene.h"
#include "reference/scene_differences.h"
#include "unit/temporary_folder.h"

namespace laterna {
namespace {

namespace fs = std::filesystem;

struct Source {
  const char* file;
  const char* rig = "";
};

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(lines.size(), 8); ++i) text += lines[i] + "\n";
  return text;
}

void write_and_read(const fs::path& file, const LoadOptions& options) {
  const Result<Scene> scene = load_scene({file}, options);
  ASSERT_TRUE(scene) << to_string(scene.error());
  const TemporaryFolder folder;
  for (const char* name : {"written.glb", "written.gltf"}) {
    const fs::path written = folder.path() / name;
    const auto warnings = write_scene(*scene, written);
    ASSERT_TRUE(warnings) << to_string(warnings.error());
    for (const Diagnostic& warning : *warnings) EXPECT_EQ(warning.message, "") << warning.place;
    const Result<Scene> again = load_scene({written});
    ASSERT_TRUE(again) << to_string(again.error());
    const std::vector<std::string> different = reference::differences(*scene, *again);
    EXPECT_TRUE(different.empty()) << name << ": " << different.size() << " members differ:\n"
                                   << text_of(different);
    EXPECT_TRUE(again->warnings.empty()) << to_string(again->warnings.front());
  }
}

class ConvertedFile : public testing::TestWithParam<Source> {};

TEST_P(ConvertedFile, HoldsTheSameScene) {
  const fs::path file = fs::path(LATERNA_SHARED_DIR) / "scenes" / GetParam().file;
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not there";
  write_and_read(file, {});
}

INSTANTIATE_TEST_SUITE_P(
    Shared, ConvertedFile,
    testing::Values(Source{"features/CubeImageUriSpaces/CubeImageUriMultipleSpaces.gltf"},
                    Source{"features/MultiUVTest/MultiUVTest.gltf"}, Source{"features/NormalTangentTest.glb"},
                    Source{"features/TextureSettingsTest/TextureSettingsTest.gltf"},
                    Source{"features/TextureTransformTest/TextureTransformTest.gltf"},
                    Source{"features/UnlitTest/UnlitTest.gltf"},
                    Source{"features/VertexColorTest/VertexColorTest.gltf"},
                    Source{"features/alpha_mask/01_alpha_mask.gltf"}, Source{"features/cameras/Cameras.gltf"},
                    Source{"features/draco_heart.glb"}, Source{"features/geometry-camera-light.glb"},
                    Source{"features/lights_dir_point_spot.glb"}, Source{"features/meshopt_pirate.glb"},
                    Source{"features/texture_transform_blender/09_texture_transform.gltf"},
                    Source{"features/vertex_count_32bit/01_vertex_count_32bit.gltf"},
                    Source{"flighthelmet/FlightHelmet.gltf"}, Source{"sponza/sponza_dabrovic.gltf"},
                    Source{"architecture/house.glb"}));

class ConvertedRig : public testing::TestWithParam<Source> {};

TEST_P(ConvertedRig, HoldsTheSameScene) {
  const fs::path folder = fs::path(LATERNA_SOURCE_DIR) / "examples" / "scenes";
  write_and_read(folder / GetParam().file, {.rigs = {folder / GetParam().rig}});
}

INSTANTIATE_TEST_SUITE_P(Examples, ConvertedRig,
                         testing::Values(Source{"stage.glb", "stage.json"}, Source{"table.glb", "table.json"},
                                         Source{"room.glb", "lamp.json"}, Source{"room.glb", "lamps.json"},
                                         Source{"room.glb", "focus.json"}, Source{"stage.glb", "ground.json"},
                                         Source{"road.glb", "headlights.json"},
                                         Source{"apron.glb", "taxi_light.json"}));

}  // namespace
}  // namespace laterna
