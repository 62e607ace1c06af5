// Key frames of Quake II's models (MD2): what Assimp, which reads one frame at a time, does not tell of them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "laterna/scene.h"

namespace laterna {

/// Frames follow one another so fast in the game.
inline constexpr double kMd2FramesPerSecond = 10;

/// Names of all frames, in order: "stand01", "stand02", … Error: the bytes begin as an MD2 does, but end inside what its
/// header speaks of. Bytes of anything else have no frames.
Result<std::vector<std::string>> read_md2_frame_names(std::span<const std::byte> bytes,
                                                      const std::string& file);

/// A run of frames that make one movement.
struct FrameRun {
  std::string name;
  std::size_t first = 0, count = 0;
};

/// Movements by the frames' names: letters, and a number that goes up by one. Several of the same letters keep the front of
/// their numbers ("pain101 … pain104, pain201 …": pain1, pain2), or else are counted.
std::vector<FrameRun> find_frame_runs(std::span<const std::string> names);

/// Positions and normals of one frame's vertices.
struct VertexFrame {
  std::vector<glm::vec3> positions, normals;
};

/// Turns frames into morph targets of the primitive, which shows the first of them, and gives the scene a clip for each
/// movement: it goes from its last frame back to its first. All frames must have as many vertices as the primitive.
void add_vertex_frames(Scene& scene, int mesh, std::span<const VertexFrame> frames,
                       std::span<const FrameRun> runs);

}  // namespace laterna
