// Layers that a rig lays on surfaces of the scene, once all files are there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "laterna/scene.h"

namespace laterna {

/// Layers for the surfaces of one material, of the meshes of one node and of everything below it, or of the whole scene.
struct SurfaceOverride {
  struct Layer {
    SurfaceLayer layer;                ///< its projector is set where the same rig has it
    std::optional<std::string> slide;  ///< name of the projector whose slide it shows
    std::string slide_place, texture_place;
  };
  std::optional<std::string> material, node;
  std::vector<Layer> layers;
  std::shared_ptr<const Mirror> mirror;  ///< in place of what there is; null: none
  std::string file, place;               ///< where it is written
};

/// Lays them over what layers there are. A mesh or material that others use too is copied for a node. Faults: no such
/// material, node or projector; more layers than kMaxSurfaceLayers; texture coordinates that a mesh does not have.
void apply(const SurfaceOverride& change, Scene& scene, std::vector<Diagnostic>& faults);

}  // namespace laterna
