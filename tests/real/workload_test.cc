// The workloads that programs are compared on, by name.
#include "workload.h"

#include <gtest/gtest.h>

#include "reference/shapes.h"

namespace laterna {
namespace {

const std::filesystem::path kWorkloads = std::filesystem::path(LATERNA_SHARED_DIR) / "bench/workloads.json";

class Workloads : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kWorkloads)) GTEST_SKIP() << "no " << kWorkloads;
  }
};

TEST_F(Workloads, ListsAreNamedByTheirEntries) {
  EXPECT_EQ(app::workload_names(kWorkloads), (std::vector<std::string>{"W1", "W2", "W3", "W4.0", "W4.1"}));
}

TEST_F(Workloads, AnEntryOfAListIsTheDepthMapOfOneLightAtItsOwnSize) {
  const Result<app::Workload> workload = app::load_workload(kWorkloads, "W4.0");
  ASSERT_TRUE(workload) << to_string(workload.error());
  const Renderer renderer = reference::make_renderer(workload->scene, 1);
  const Result<LayeredImage> map = renderer.depth_map(workload->depth_light);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->width, 4096);
  EXPECT_EQ(map->height, 4096);
}

TEST_F(Workloads, AnUnknownNameIsAnsweredWithThoseThatAreThere) {
  const Result<app::Workload> workload = app::load_workload(kWorkloads, "W4.2");
  ASSERT_FALSE(workload);
  EXPECT_NE(to_string(workload.error()).find("there is no \"W4.2\"; there are W1, W2, W3, W4.0, W4.1"),
            std::string::npos);
}

}  // namespace
}  // namespace laterna
