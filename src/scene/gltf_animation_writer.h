// animations[] and skins[] of a glTF file in the making, with KHR_animation_pointer.
#pragma once

#include <vector>

#include "laterna/scene.h"
#include "scene/gltf_document.h"

namespace laterna::gltf {

/// Whether channels move a node's translation, rotation or scale: one for each of the scene's nodes. Such nodes have no matrix in
/// a file.
std::vector<bool> nodes_moved_by_parts(const Scene& scene);

/// A node's parts: its own, or what its matrix, which only turns and shifts, is made of.
Transform parts_of(const Node& node);

/// In the scene's order.
void write_skins(const Scene& scene, Document& document);

/// Every clip. `light_indices`: where the file lists each light; −1: where no channel reaches. Nodes, cameras and materials have
/// the scene's numbers. Numbers are in single precision. A path that leads a gaze is written twice: exactly, in LATERNA_lighting, and for other
/// programs as translations and rotations at so many places that straight lines between them follow it.
void write_animations(const Scene& scene, const std::vector<int>& light_indices, Document& document);

}  // namespace laterna::gltf
