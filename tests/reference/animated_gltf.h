// Where glTF files' vertices are at an instant: plain loops in double precision, straight from the file, sharing nothing with the
// library's reader, sampler or poser.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

namespace laterna::reference {

/// Corners of all triangles of a node's mesh in the world, primitive by primitive in the order of their indices.
struct AnimatedNode {
  int node = -1;  // of the file
  std::vector<std::vector<glm::dvec3>> corners;
};

/// Nodes with meshes, parents first, at `time` of animation `clip`, looped. For files of plain triangles whose
/// accessors are float, or unsigned integers.
std::vector<AnimatedNode> pose_gltf(const std::filesystem::path& file, std::size_t clip, double time);

/// Lengths in seconds of a file's animations.
std::vector<double> clip_lengths(const std::filesystem::path& file);

}  // namespace laterna::reference
