// Light meters: the shading's light and rays' shadows, at points that no camera need see.
#pragma once

#include <memory>
#include <span>

#include "base/task_pool.h"
#include "frame/frame.h"
#include "laterna/instruction_set.h"
#include "laterna/probes.h"
#include "render/progress_report.h"
#include "trace/ray_scene.h"

namespace laterna::render {

struct ProbeContext {
  const frame::Frame& frame;
  const TaskPool& pool;
  InstructionSet instruction_set;
  std::shared_ptr<const trace::RayScene> rays;
  ProgressReport& progress;  // a step for each batch
};

Result<void> check_probes(std::span<const Probe> probes, const ProbeSettings& settings);
/// Steps of progress.
std::size_t probe_steps(std::span<const Probe> probes, const ProbeSettings& settings);
/// The probes have been checked.
ProbeReport measure_probes(const ProbeContext& context, std::span<const Probe> probes,
                           const ProbeSettings& settings);

}  // namespace laterna::render
