// Shadow volumes of the benchmark's workloads against rays: Sponza with its sun and its slide projector, and bunnies.
#include <gtest/gtest.h>

#include <filesystem>

#include "reference/shadow_ties.h"
#include "workload.h"

namespace laterna {
namespace {

using namespace reference;

const std::filesystem::path kBench = std::filesystem::path(LATERNA_SHARED_DIR) / "bench";

struct VolumeCase {
  const char* name;
  const char* workload;
  const char* light;
};

class ShadowVolumeOfWorkload : public testing::TestWithParam<VolumeCase> {};

// Row 52.
TEST_P(ShadowVolumeOfWorkload, EveryMismatchIsATie) {
  const std::filesystem::path workloads = kBench / "workloads.json";
  if (!std::filesystem::exists(workloads) || !std::filesystem::exists(kBench / "scenes/sponza/Sponza.gltf")) {
    GTEST_SKIP() << "no Sponza in " << kBench;
  }
  Result<app::Workload> workload = app::load_workload(workloads, GetParam().workload);
  ASSERT_TRUE(workload) << to_string(workload.error());
  for (Light& light : workload->scene.lights) light.enabled = light.name == GetParam().light;
  RenderSettings settings = workload->settings;
  settings.width /= 2;
  settings.height /= 2;
  const ShadowMismatches found = compare_techniques(workload->scene, workload->view, settings,
                                                    ShadowTechnique::volume, ShadowTechnique::raytraced);
  SCOPED_TRACE(to_string(found));
  RecordProperty("mismatches", to_string(found));
  EXPECT_TRUE(found.mistakes.empty());
  EXPECT_LE(found.pixels.size(), found.seen / 100000 + 1);
  EXPECT_GT(found.dark, 20000U);
}

INSTANTIATE_TEST_SUITE_P(Workloads, ShadowVolumeOfWorkload,
                         testing::Values(VolumeCase{"SponzaSun", "W1", "light 0"},
                                         VolumeCase{"SponzaProjector", "W1", "light 1"},
                                         VolumeCase{"Bunnies", "W2", "light 0"}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace laterna
