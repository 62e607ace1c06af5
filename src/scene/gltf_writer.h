// Scenes as glTF 2.0 in memory.
#pragma once

#include <filesystem>
#include <vector>

#include "laterna/write_scene.h"
#include "scene/gltf_picture_writer.h"

namespace laterna {

struct GltfFiles {
  std::vector<gltf::BesideFile> files;  ///< the scene's own last: it names the others
  std::vector<Diagnostic> warnings;
};

/// What write_scene() writes.
Result<GltfFiles> make_gltf(const Scene& scene, const std::filesystem::path& file,
                            const SceneWriteOptions& options);

}  // namespace laterna
