// Layers and reliefs that a rig gives to surfaces of the scene, once all files are there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "laterna/relief.h"
#include "laterna/scene.h"

namespace laterna {

/// Layers and a relief for the surfaces of one material, of the meshes of one node and of everything below it, or of the whole scene.
struct SurfaceOverride {
  struct Layer {
    SurfaceLayer layer;                ///< its projector is set where the same rig has it
    std::optional<std::string> slide;  ///< name of the projector whose slide it shows
    std::string slide_place, texture_place;
  };
  std::optional<std::string> material, node;
  std::vector<Layer> layers;
  std::optional<Relief> relief;  ///< in place of what relief there is
  std::string relief_place;
  std::shared_ptr<const Mirror> mirror;  ///< in place of what there is; null: none
  std::string file, place;               ///< where it is written
};

/// Lays them over what layers there are. A mesh or material that others use too is copied for a node. Faults: no such
/// material, node or projector; more layers than kMaxSurfaceLayers; texture coordinates that a mesh does not have; a
/// relief on what blends.
void apply(const SurfaceOverride& change, Scene& scene, std::vector<Diagnostic>& faults);

}  // namespace laterna
