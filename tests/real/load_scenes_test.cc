// Every scene of the shared collection loads with the number of triangles that its list states, or is refused
// for a good reason.
#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>
#include <set>

#include "laterna/scene.h"
#include "scene/normals.h"
#include "scene/tangents.h"

namespace laterna {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(LATERNA_SHARED_DIR) / "scenes";

struct Expected {
  const char* file;
  std::size_t triangles;
  const char* warnings = "";  // a word of each, in order, separated by spaces
};

std::size_t triangles_in(const Scene& scene) {
  std::size_t count = 0;
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& primitive : mesh.primitives) count += triangle_count(primitive);
  }
  return count;
}

std::string all_warnings(const Scene& scene) {
  std::string text;
  for (const Diagnostic& warning : scene.warnings) text += to_string(warning) + "\n";
  return text;
}

std::string name_of(const testing::TestParamInfo<Expected>& info) {
  std::string name = info.param.file;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

class LoadScenes : public testing::TestWithParam<Expected> {};

TEST_P(LoadScenes, WithTheirTriangles) {
  const std::filesystem::path file = kScenes / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  const Result<Scene> scene = load_scene({file});
  ASSERT_TRUE(scene.has_value()) << to_string(scene.error());
  EXPECT_EQ(triangles_in(*scene), GetParam().triangles);
  if (GetParam().warnings[0] == '\0') {
    EXPECT_EQ(all_warnings(*scene), "");
  } else {
    EXPECT_NE(all_warnings(*scene).find(GetParam().warnings), std::string::npos) << all_warnings(*scene);
  }
  for (const Mesh& mesh : scene->meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      // Flat ones of what moves are those of its triangles as they lie.
      if (primitive.normals.empty() && primitive.influences > 0) continue;
      ASSERT_EQ(primitive.normals.size(), primitive.positions.size());
      for (const glm::vec3& normal : primitive.normals) ASSERT_NEAR(glm::length(normal), 1, 1e-5);
    }
  }
}

const Expected kExpected[] = {
    {"sponza/sponza_dabrovic.gltf", 76154},
    {"sponza/sponza_dabrovic.obj", 76154, "sponza.mtl"},
    {"sponza/Sponza_LowPoly.gltf", 63084},
    {"flighthelmet/FlightHelmet.gltf", 94722},
    {"ww2-cityscene/scene.gltf", 146842},
    {"architecture/dream-apartment.glb", 177934},
    {"architecture/dream-apartment_meshopt.glb", 177934},
    {"architecture/house.glb", 10497},
    {"architecture/vr-gallery.glb", 1930},
    {"architecture/VolumetricFogExample.glb", 360},
    {"architecture/japanese-bridge-garden.glb", 21883, "KHR_materials_pbrSpecularGlossiness"},
    {"trees/PalmTree/PalmTree.gltf", 10124},
    {"trees/oaktree.gltf", 5302},
    {"trees/low-poly-tree.glb", 1126},
    {"glb/DamagedHelmet.glb", 15452},
    {"glb/statue.glb", 16259},
    {"features/lights_dir_point_spot.glb", 12},
    {"features/geometry-camera-light.glb", 14},
    {"features/cameras/Cameras.gltf", 2},
    {"features/CesiumMan/CesiumMan.gltf", 4672},
    {"features/Fox.glb", 576},
    {"features/MorphStressTest.glb", 2412},
    {"features/AnimatedMorphCube/AnimatedMorphCube.gltf", 12},
    {"features/SimpleSparseAccessor/SimpleSparseAccessor.gltf", 12},
    {"features/SparseMorphTargets.glb", 12},
    {"features/draco_heart.glb", 180},
    {"features/draco_BoxMeta/BoxMetaDraco.gltf", 12},
    {"features/draco_2CylinderEngine/2CylinderEngine.gltf", 65311},
    {"features/meshopt_Box/BoxMeshopt.gltf", 12},
    {"features/meshopt_Box/BoxMeshopt.glb", 12},
    {"features/meshopt_pirate.glb", 5010},
    {"features/TextureTransformTest/TextureTransformTest.gltf", 18},
    {"features/texture_transform_blender/09_texture_transform.gltf", 2},
    {"features/TextureSettingsTest/TextureSettingsTest.gltf", 72},
    {"features/MultiUVTest/MultiUVTest.gltf", 12},
    {"features/VertexColorTest/VertexColorTest.gltf", 36},
    {"features/UnlitTest/UnlitTest.gltf", 88},
    {"features/NormalTangentTest.glb", 7774},
    {"features/InterpolationTest/InterpolationTest.gltf", 110},
    {"features/all_animations/03_all_animations.gltf", 976},
    {"features/alpha_mask/01_alpha_mask.gltf", 2},
    {"features/alpha_blend/01_alpha_blend.gltf", 14},
    {"features/vertex_count_32bit/01_vertex_count_32bit.gltf", 130380},
    {"features/CubeImageUriSpaces/CubeImageUriSpaces.gltf", 12},
    {"features/CubeImageUriSpaces/CubeImageUriMultipleSpaces.gltf", 12},
    {"features/BoxTextured_embedded/BoxTextured.gltf", 12},
    {"features/PrimitiveMode/Mesh_PrimitiveMode_00.gltf", 0, "points"},
    {"features/PrimitiveMode/Mesh_PrimitiveMode_01.gltf", 0, "lines"},
    {"features/PrimitiveMode/Mesh_PrimitiveMode_04.gltf", 2},
    {"features/PrimitiveMode/Mesh_PrimitiveMode_05.gltf", 2},
    {"features/PrimitiveMode/Mesh_PrimitiveMode_06.gltf", 2},
    {"features/PrimitiveMode/Mesh_PrimitiveMode_13.gltf", 2},
    {"features/PrimitiveMode/Mesh_PrimitiveMode_15.gltf", 2},
    {"md2/sydney.md2", 679},
    {"md2/faerie.md2", 654},
    {"meshes/dragon_vrip_res2.ply", 202520},
    {"meshes/stanford-bunny.obj", 69451},
    {"meshes/nefertiti.obj", 99938},
    {"meshes/teapot.obj", 6320},
    {"meshes/suzanne.obj", 968},
    {"meshes/spot.obj", 5856},
    {"meshes/spot_quadrangulated.obj", 5856},
    {"photogrammetry/sceaux_castle/scene_mesh.ply", 14709},
    {"photogrammetry/sceaux_castle/scene_mesh_refine.ply", 174899},
};

INSTANTIATE_TEST_SUITE_P(Files, LoadScenes, testing::ValuesIn(kExpected), name_of);

Result<Scene> load_or_skip(const char* file) {
  const std::filesystem::path path = kScenes / file;
  if (!std::filesystem::exists(path)) return Scene{};
  return load_scene({path});
}

TEST(LoadScene, NodesThatShareAChildAreRefused) {
  if (!std::filesystem::exists(kScenes)) GTEST_SKIP();
  const Result<Scene> scene = load_or_skip("features/CubeScaledInstances/cube_att.gltf");
  ASSERT_FALSE(scene.has_value());
  EXPECT_EQ(scene.error().diagnostics.size(), 3U);
  EXPECT_EQ(scene.error().diagnostics[0].message, "is a child of both nodes[1] and nodes[2]");
}

TEST(LoadScene, PointCloudsAreRefused) {
  if (!std::filesystem::exists(kScenes)) GTEST_SKIP();
  const Result<Scene> scene = load_or_skip("photogrammetry/sceaux_castle/sparse.ply");
  ASSERT_FALSE(scene.has_value());
  EXPECT_EQ(scene.error().diagnostics[0].message, "holds no triangles, only 12683 points and lines");
}

TEST(LoadScene, LightsAndCamerasOfAFile) {
  if (!std::filesystem::exists(kScenes)) GTEST_SKIP();
  const Result<Scene> scene = load_or_skip("features/lights_dir_point_spot.glb");
  ASSERT_TRUE(scene.has_value());
  EXPECT_EQ(scene->cameras.size(), 1U);
  std::multiset<LightType> types;
  for (const Light& light : scene->lights) types.insert(light.type);
  EXPECT_GE(types.count(LightType::directional), 1U);
  EXPECT_GE(types.count(LightType::point), 1U);
  EXPECT_GE(types.count(LightType::spot), 1U);
}

TEST(LoadScene, PlainAndCompressedApartmentAgree) {
  if (!std::filesystem::exists(kScenes)) GTEST_SKIP();
  const Result<Scene> plain = load_or_skip("architecture/dream-apartment.glb");
  const Result<Scene> compressed = load_or_skip("architecture/dream-apartment_meshopt.glb");
  ASSERT_TRUE(plain && compressed);
  ASSERT_EQ(plain->meshes.size(), compressed->meshes.size());
  for (std::size_t m = 0; m < plain->meshes.size(); ++m) {
    ASSERT_EQ(plain->meshes[m].primitives.size(), compressed->meshes[m].primitives.size());
    for (std::size_t p = 0; p < plain->meshes[m].primitives.size(); ++p) {
      const Primitive &a = plain->meshes[m].primitives[p], &b = compressed->meshes[m].primitives[p];
      EXPECT_EQ(a.positions.size(), b.positions.size());
      EXPECT_EQ(a.indices, b.indices);
      for (std::size_t i = 0; i < a.positions.size(); ++i)
        ASSERT_LT(glm::distance(a.positions[i], b.positions[i]), 1e-6F);
    }
  }
}

// The helmet comes with tangents made by the reference implementation; ours must be much the same.
TEST(LoadScene, ComputedTangentsAgreeWithStoredOnes) {
  if (!std::filesystem::exists(kScenes)) GTEST_SKIP();
  const Result<Scene> scene = load_or_skip("flighthelmet/FlightHelmet.gltf");
  ASSERT_TRUE(scene.has_value());
  std::size_t vertices = 0, close = 0, same_hand = 0;
  for (const Mesh& mesh : scene->meshes) {
    for (const Primitive& stored : mesh.primitives) {
      Primitive computed = stored;
      computed.tangents.clear();
      compute_tangents(computed, 0);
      for (std::size_t i = 0; i < stored.positions.size(); ++i) {
        ++vertices;
        same_hand += stored.tangents[i].w == computed.tangents[i].w ? 1 : 0;
        close += glm::dot(glm::vec3(stored.tangents[i]), glm::vec3(computed.tangents[i])) > 0.99F ? 1 : 0;
      }
    }
  }
  EXPECT_GT(static_cast<double>(same_hand), 0.99 * static_cast<double>(vertices));
  EXPECT_GT(static_cast<double>(close), 0.97 * static_cast<double>(vertices));
}

}  // namespace
}  // namespace laterna
