// One tile from triangles to radiance: visibility, then every visible sample shaded once with every light, while the
// tile is in cache; blended surfaces as a second, sorted list over the first.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "laterna/stages.h"
#include "raster/tile_raster.h"
#include "shade/environment_light.h"
#include "shade/illumination.h"
#include "shade/layer_painter.h"
#include "shade/light_reach.h"
#include "shade/lobe_shader.h"
#include "shade/mirror_shader.h"
#include "shade/photograph_painter.h"
#include "shade/shadow_tone.h"
#include "shade/tile_layers.h"
#include "shadow/shadow_technique.h"

namespace laterna::shade {

/// A light as the tile shader uses it.
struct ShaderLight {
  BoundLight bound;
  LightReach reach;
  /// Null: nothing stands in its way.
  std::unique_ptr<shadow::ShadowTechnique> shadow;
  ShadowTone tone;
  /// The light with nothing before its lamp, where it does more than add (Light::blend).
  std::optional<BoundLight> open = std::nullopt;
};

/// Sample positions of a pixel, in 1/256 pixel from its centre.
struct SampleOffset {
  int x = 0, y = 0;
};
/// Direct3D's standard patterns; the first is the nearest to the centre. count: 1, 2, 4, 8, 16. All of them are moved by
/// `jitter`, from −128 to 127, and what leaves the pixel on one side comes back on the other.
std::vector<SampleOffset> sample_offsets(int count, SampleOffset jitter);

/// Everything that is the same for all tiles of a picture.
struct ShaderJob {
  const frame::Frame* frame = nullptr;
  const raster::RasterView* view = nullptr;
  std::span<const raster::Batch> batches;
  std::vector<ShaderLight> lights;
  PhotographJob photographs;
  std::vector<ShaderDecal> decals;  // the frame's
  std::optional<EnvironmentLight> environment;
  LobeJob lobes;
  MirrorJob mirrors;
  std::vector<BoundLight> physical_lights;  // for lux where the model is not physical; otherwise empty
  ReflectionSettings reflection;
  Interpolation interpolation = Interpolation::perspective;
  int anisotropy = 1;
  int samples_per_pixel = 1;
  SampleOffset jitter;  // of the samples
  Passes passes = Passes::single;
  const glm::vec3* background = nullptr;  // null: black and transparent
  WantedLayers wanted;
  InstructionSet instruction_set = InstructionSet::scalar;
};

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
