// One tile from triangles to radiance: visibility, then every visible sample shaded once with every light, while the
// tile is in cache; blended surfaces as a second, sorted list over the first.
#pragma once

#include <memory>

#include "laterna/stages.h"
#include "shade/shader_job.h"

namespace laterna::shade {

/// Buffers of one worker, reused from tile to tile.
class TileShader {
 public:
  explicit TileShader(const ShaderJob& job);
  ~TileShader();
  TileShader(const TileShader&) = delete;
  TileShader& operator=(const TileShader&) = delete;

  /// The result is valid until the next call.
  const TileResult& shade(int tile_x, int tile_y);

  /// Where time went, of all tiles so far. Stages of shading are apportioned by what they took in some of the tiles.
  [[nodiscard]] StageTimes times() const;
  /// Apart from these: what drawing tiles of shadow maps took, when they were first asked for.
  [[nodiscard]] double map_ms() const;

 private:
  class Worker;
  std::unique_ptr<Worker> worker_;
};

}  // namespace laterna::shade
