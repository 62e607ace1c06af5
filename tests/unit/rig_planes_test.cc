// Ground planes and silhouettes in rigs, and in scenes that are made in code.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>

#include "reference/shapes.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

std::string rig_of(const std::string& shadow) {
  return R"({"lights": [{"name": "sun", "type": "directional", "position": [0, 5, 1], "target": [0, 0, 0], "shadow": )" +
         shadow + "}]}";
}

ShadowSettings load_shadow(const std::string& shadow) {
  const TemporaryFolder folder;
  const Scene scene = load_or_fail({}, {.rigs = {folder.write("rig.json", rig_of(shadow))}});
  return scene.lights.empty() ? ShadowSettings{} : scene.lights[0].shadow;
}

TEST(RigPlanes, ByDistanceAndByPoint) {
  const ShadowSettings shadow = load_shadow(
      R"({"technique": "ground", "planes": [{"normal": [0, 2, 0], "distance": 0.5}, {"normal": [0, 3, 4], "point": [9, 5, 0]}]})");
  EXPECT_EQ(shadow.technique, ShadowTechnique::ground);
  ASSERT_EQ(shadow.planes.size(), 2U);
  EXPECT_EQ(shadow.planes[0].normal, glm::dvec3(0, 1, 0));
  EXPECT_EQ(shadow.planes[0].distance, 0.5);
  EXPECT_LT(glm::distance(shadow.planes[1].normal, glm::dvec3(0, 0.6, 0.8)), 1e-15);
  EXPECT_NEAR(shadow.planes[1].distance, 3, 1e-15);
}

TEST(RigPlanes, Silhouettes) {
  const ShadowSettings shadow = load_shadow(
      R"({"technique": "silhouette", "smooth": 3, "smooth_kernel": "binomial", "order": "none", "cull": false})");
  EXPECT_EQ(shadow.technique, ShadowTechnique::silhouette);
  EXPECT_EQ(shadow.smooth, 3);
  EXPECT_EQ(shadow.smooth_kernel, SmoothKernel::binomial);
  EXPECT_FALSE(shadow.orders_objects);
  EXPECT_FALSE(shadow.culls_occluders);
  const ShadowSettings plain = load_shadow(R"({"technique": "silhouette"})");
  EXPECT_EQ(plain.smooth, 0);
  EXPECT_EQ(plain.smooth_kernel, SmoothKernel::eight_neighbours);
  EXPECT_TRUE(plain.orders_objects);
  EXPECT_TRUE(plain.culls_occluders);
}

struct Fault {
  const char* shadow;
  const char* message;
};

TEST(RigPlanes, FaultsAreNamedWithTheirPlace) {
  const Fault faults[] = {
      {R"({"planes": []})", "planes: is empty: leave it out for the scene's floor"},
      {R"({"planes": [7]})", "planes[0]: expected an object"},
      {R"({"planes": [{"distance": 1}]})", "normal"},
      {R"({"planes": [{"normal": [0, 0, 0], "distance": 1}]})",
       "planes[0].normal: expected a vector that is not zero"},
      {R"({"planes": [{"normal": [0, 1, 0]}]})",
       "expected exactly one of \"point\" and \"distance\" beside \"normal\""},
      {R"({"planes": [{"normal": [0, 1, 0], "distance": 1, "point": [0, 0, 0]}]})",
       "expected exactly one of \"point\" and \"distance\" beside \"normal\""},
      {R"({"planes": [{"normal": [0, 1, 0], "distance": 1, "height": 2}]})", "height"},
      {R"({"smooth": 65})", "smooth"},
      {R"({"smooth_kernel": "binomial"})", "has an effect only with \"smooth\": 1 or more beside it"},
      {R"({"smooth": 1, "smooth_kernel": "box"})", "smooth_kernel"},
      {R"({"order": "size"})", "order"},
  };
  for (const Fault& fault : faults) {
    const TemporaryFolder folder;
    const Result<Scene> scene = load_scene({}, {.rigs = {folder.write("rig.json", rig_of(fault.shadow))}});
    ASSERT_FALSE(scene.has_value()) << fault.shadow;
    EXPECT_NE(to_string(scene.error()).find(fault.message), std::string::npos)
        << fault.shadow << ": " << to_string(scene.error());
    EXPECT_NE(to_string(scene.error()).find("lights[0].shadow"), std::string::npos)
        << to_string(scene.error());
  }
}

TEST(RigPlanes, ScenesMadeInCodeAreCheckedAsWell) {
  const auto message_of = [](const std::function<void(ShadowSettings&)>& spoil) {
    Scene scene;
    Light light;
    light.name = "lamp";
    spoil(light.shadow);
    reference::add_light(scene, light, {0, 1, 0}, {0, 0, 1});
    const std::vector<Diagnostic> faults = validate(scene);
    return faults.empty() ? std::string() : to_string(faults[0]);
  };
  EXPECT_EQ(message_of([](ShadowSettings&) {}), "");
  EXPECT_NE(message_of([](ShadowSettings& s) {
              s.planes = {{{0, 0, 0}, 1}};
            }).find("planes[0].normal"),
            std::string::npos);
  EXPECT_NE(message_of([](ShadowSettings& s) {
              s.planes = {{}, {{0, 1, 0}, std::numeric_limits<double>::quiet_NaN()}};
            }).find("planes[1].distance"),
            std::string::npos);
  EXPECT_NE(message_of([](ShadowSettings& s) { s.smooth = -1; }).find("shadow.smooth"), std::string::npos);
  EXPECT_NE(message_of([](ShadowSettings& s) {
              s.smooth_kernel = static_cast<SmoothKernel>(9);
            }).find("shadow.smooth_kernel"),
            std::string::npos);
}

}  // namespace
}  // namespace laterna
