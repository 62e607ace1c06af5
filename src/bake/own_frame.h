// A frame with what it refers to.
#pragma once

#include <memory>
#include <optional>

#include "base/task_pool.h"
#include "frame/frame.h"

namespace laterna::bake {

struct OwnFrame {
  frame::ClusteredMeshes meshes;
  frame::Frame frame;  ///< keeps the textures
};

/// The scene must outlive it. Films show their frame of `time`. Errors: a picture that cannot be read; Frame::build()'s.
Result<std::unique_ptr<OwnFrame>> make_frame(const Scene& scene, double time, InstructionSet set,
                                             const TaskPool& pool);

}  // namespace laterna::bake
