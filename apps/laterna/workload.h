// Benchmark workloads: a JSON file of named scenes, cameras and lights with exact numbers, so that different programs
// can be timed on the same work. The form is described in docs/performance.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "laterna/render.h"

namespace laterna::app {

struct Workload {
  Scene scene;
  View view;
  RenderSettings settings;
  std::string depth_light;  ///< unless empty, only the depth map of this light is drawn
};

/// `name`: of a member of "workloads", or of an entry of another list of the file, such as "W4.1": the depth map of one
/// light of a workload, at a size of its own.
/// `scenes`: the folder that holds the workload's models; empty: "scenes" beside the file.
Result<Workload> load_workload(const std::filesystem::path& file, const std::string& name,
                               const std::filesystem::path& scenes = {});

/// Every name that load_workload() knows in the file; none where it cannot be read.
std::vector<std::string> workload_names(const std::filesystem::path& file);

}  // namespace laterna::app
