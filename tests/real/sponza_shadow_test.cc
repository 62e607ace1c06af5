// Shadow masks of the benchmark's first workload against rays: Sponza, its sun and its slide projector, at full size.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "reference/shadow_truth.h"
#include "reference/shapes.h"
#include "workload.h"

namespace laterna {
namespace {

using namespace reference;

const std::filesystem::path kBench = std::filesystem::path(LATERNA_SHARED_DIR) / "bench";

struct Promise {
  const char* light;
  double wrong_share;  // of the pixels on which the light falls
};

class SponzaShadow : public testing::TestWithParam<Promise> {};

TEST_P(SponzaShadow, MaskAgreesWithRays) {
  const std::filesystem::path workloads = kBench / "workloads.json";
  if (!std::filesystem::exists(workloads) || !std::filesystem::exists(kBench / "scenes/sponza/Sponza.gltf")) {
    GTEST_SKIP() << "no Sponza in " << kBench;
  }
  Result<app::Workload> workload = app::load_workload(workloads, "W1");
  ASSERT_TRUE(workload) << to_string(workload.error());
  // One light at a time: half the rays.
  for (Light& light : workload->scene.lights) light.enabled = light.name == GetParam().light;
  const Renderer renderer = make_renderer(std::move(workload->scene));
  const ShadowErrors errors = find_shadow_errors(
      draw_shadow_masks(renderer, workload->view, workload->settings, GetParam().light, 1));
  SCOPED_TRACE(to_string(errors));
  RecordProperty("errors", to_string(errors));
  EXPECT_LT(errors.wrong_share(), GetParam().wrong_share);
  EXPECT_EQ(errors.far_false_dark, 0) << "false shadows";
  EXPECT_GE(errors.edge_share(), 0.995);
  EXPECT_GT(errors.pixels, 100000);
}

INSTANTIATE_TEST_SUITE_P(W1, SponzaShadow,
                         testing::Values(Promise{"light 0", 0.005}, Promise{"light 1", 0.002}),
                         [](const auto& instance) { return instance.index == 0 ? "Sun" : "Projector"; });

}  // namespace
}  // namespace laterna
