// A scene's environment: its pictures read and made ready to light surfaces.
#pragma once

#include <filesystem>

#include "base/task_pool.h"
#include "image/environment_map.h"
#include "laterna/render.h"

namespace laterna::render {

/// The scene must have passed validate() and have an environment. `cache`: a folder; empty: none.
Result<image::EnvironmentMap> prepare_environment(const Scene& scene, const TaskPool& pool,
                                                  InstructionSet set, const std::filesystem::path& cache,
                                                  const Progress& progress);

}  // namespace laterna::render
