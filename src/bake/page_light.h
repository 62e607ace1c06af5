// The light on a page's luxels.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "bake/luxel_light.h"
#include "bake/luxel_receivers.h"
#include "base/task_pool.h"
#include "render/progress_report.h"

namespace laterna::bake {

/// Rows of tiles that are done, and kept, as one.
inline constexpr int kTileRowsPerStrip = 8;

/// What is found of each luxel, row by row from the top: one plane of numbers after the other.
struct StripValues {
  StripValues(glm::ivec2 luxels, bool with_back, bool with_occlusion);

  glm::ivec2 size;
  std::vector<float> numbers;
  /// Red, green and blue of each luxel; `back` is empty where there is none.
  std::span<float> front, back;
  std::span<float> openness;  ///< 0 … 1; empty where it is not looked for
  std::span<float> is_found;  ///< 1: there is a surface
};

struct PageContext {
  const frame::Frame& frame;
  const trace::RayScene& rays;
  const PageTriangles& triangles;
  const DirectLight& light;
  const OcclusionRays* occlusion;  ///< null: not looked for
  ReceiverSettings receivers;
  const TaskPool& pool;
  render::ProgressReport& progress;  ///< a step for each tile
};

[[nodiscard]] std::size_t strip_count(glm::ivec2 page);
/// Width and height of one strip, in luxels.
[[nodiscard]] glm::ivec2 strip_size(glm::ivec2 page, std::size_t strip);
/// Fills in `values`, unless progress is cancelled.
void light_strip(const PageContext& context, std::size_t strip, StripValues& values);

}  // namespace laterna::bake
