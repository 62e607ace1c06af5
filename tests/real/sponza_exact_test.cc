// Exact shadows of the benchmark's first workload against rays, at full size. Where they differ, it is because the way to
// the light grazes an edge, or the rim of a cut-out, to within what rays in single precision can tell.
#include <gtest/gtest.h>

#include <filesystem>
#include <glm/geometric.hpp>

#include "reference/shadow_judge.h"
#include "reference/shadow_truth.h"
#include "reference/shapes.h"
#include "workload.h"

namespace laterna {
namespace {

using namespace reference;

const std::filesystem::path kBench = std::filesystem::path(LATERNA_SHARED_DIR) / "bench";

class SponzaExact : public testing::TestWithParam<const char*> {};

struct Pixels {
  std::span<const float> arrival, object, p[3], n[3];

  Pixels(const LayeredImage& image, const std::string& light)
      : arrival(image.find("visibility." + light)->values), object(image.find("id.object")->values) {
    const char* axes[3] = {"X", "Y", "Z"};
    for (int k = 0; k < 3; ++k) {
      p[k] = image.find(std::string("P.") + axes[k])->values;
      n[k] = image.find(std::string("N.") + axes[k])->values;
    }
  }
};

glm::dvec3 at(const std::span<const float>* v, std::size_t i) { return {v[0][i], v[1][i], v[2][i]}; }

TEST_P(SponzaExact, DiffersFromRaysOnlyInTies) {
  const std::filesystem::path workloads = kBench / "workloads.json";
  if (!std::filesystem::exists(workloads) || !std::filesystem::exists(kBench / "scenes/sponza/Sponza.gltf")) {
    GTEST_SKIP() << "no Sponza in " << kBench;
  }
  Result<app::Workload> workload = app::load_workload(workloads, "W1");
  ASSERT_TRUE(workload) << to_string(workload.error());
  const std::string light_name = GetParam();
  for (Light& light : workload->scene.lights) light.enabled = light.name == light_name;
  const Scene scene = with_flat_normals(std::move(workload->scene));
  const Renderer renderer = make_renderer(scene);
  RenderSettings settings = workload->settings;
  settings.layers = {Layer::visibility, Layer::object, Layer::position, Layer::normal};
  settings.shadows = ShadowTechnique::exact;
  const LayeredImage exact = render(renderer, workload->view, settings);
  settings.shadows = ShadowTechnique::raytraced;
  const LayeredImage traced = render(renderer, workload->view, settings);

  const OwnedFrame owned = make_frame(scene);
  const frame::PlacedLight* placed = nullptr;
  for (const frame::PlacedLight& light : owned.frame.lights) {
    if (light.light->name == light_name) placed = &light;
  }
  ASSERT_NE(placed, nullptr);
  const ShadowJudge judge(owned.frame, *placed);
  const Pixels ours(exact, light_name), theirs(traced, light_name);
  int facing = 0, dark = 0, differ = 0;
  for (std::size_t i = 0; i < ours.arrival.size(); ++i) {
    if (ours.object[i] < 0) continue;
    const glm::dvec3 p = at(ours.p, i);
    const glm::dvec3 to_light = placed->light->type == LightType::directional ? -placed->pose.forward_ws()
                                                                              : placed->pose.position_ws - p;
    if (glm::dot(at(ours.n, i), to_light) <= 0) continue;
    ++facing;
    dark += ours.arrival[i] == 0 ? 1 : 0;
    if (ours.arrival[i] == theirs.arrival[i]) continue;
    ++differ;
    // Rays start and go in single precision: ten roundings of the room's 30 m. Alpha: those, on a picture of 1024 texels.
    constexpr double kTolerance = 2e-5, kAlphaTolerance = 0.01;
    EXPECT_EQ(judge.judge(p, judge.triangle_at(p), 5e-5, kTolerance, kAlphaTolerance), Judgement::tie)
        << "at " << p.x << ", " << p.y << ", " << p.z << ": " << ours.arrival[i];
  }
  RecordProperty("differ", differ);
  RecordProperty("facing", facing);
  EXPECT_GT(facing, 500000);
  EXPECT_GT(dark, 100000);
  EXPECT_LT(differ, 1e-5 * facing);
}

INSTANTIATE_TEST_SUITE_P(W1, SponzaExact, testing::Values("light 0", "light 1"),
                         [](const auto& instance) { return instance.index == 0 ? "Sun" : "Projector"; });

}  // namespace
}  // namespace laterna
