// One tile from triangles to radiance: visibility, then every visible sample shaded once with every light, while the
// tile is in cache; blended surfaces as a second, sorted list over the first.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "raster/tile_raster.h"
#include "shade/illumination.h"
#include "shade/surface_cut.h"
#include "shadow/shadow_technique.h"

namespace laterna::shade {

/// A light as the tile shader uses it.
struct ShaderLight {
  BoundLight bound;
  /// Null: nothing stands in its way.
  std::unique_ptr<shadow::ShadowTechnique> shadow;
};

/// What is wanted besides beauty.
struct WantedLayers {
  bool lights = false;      // ambient and one per light
  bool visibility = false;  // per light
  bool slide_uv = false;    // per projector
  bool lux = false;
  bool geometry = false;  // depth, position, normal, object
  bool albedo = false;
  bool passes = false;  // Passes::multi: the frame buffer after each pass
};

/// Everything that is the same for all tiles of a picture.
struct ShaderJob {
  const frame::Frame* frame = nullptr;
  const raster::RasterView* view = nullptr;
  std::span<const raster::Batch> batches;
  std::vector<ShaderLight> lights;
  std::vector<BoundLight> physical_lights;  // for lux where the model is not physical; otherwise empty
  ReflectionSettings reflection;
  Interpolation interpolation = Interpolation::perspective;
  int anisotropy = 1;
  int samples_per_pixel = 1;
  Passes passes = Passes::single;
  const glm::vec3* background = nullptr;  // null: black and transparent
  WantedLayers wanted;
  InstructionSet instruction_set = InstructionSet::scalar;
};

/// One channel of a tile, in the tile's storage order (raster::index_in_tile).
struct alignas(64) TilePlane : std::array<float, raster::kTilePixels> {};
struct TileColor {
  TilePlane r, g, b;
};

/// What came out. Planes of layers that were not wanted are empty or unspecified.
struct TileResult {
  TileColor beauty;
  TilePlane alpha;
  std::vector<TileColor> radiance;    // wanted.lights: ambient, then one per light
  std::vector<TilePlane> visibility;  // wanted.visibility: per light
  std::vector<TilePlane> slide_s, slide_t;
  std::vector<TileColor> pass_colors;  // wanted.passes: after ambient, then after each light
  /// wanted.passes in the papers' model: c_p of the slide algorithm, ambient + Σ slide · α so far, not yet times c.
  std::vector<TileColor> pass_illumination;
  TilePlane lux;
  TilePlane depth;  // metres along the axis, +infinity where nothing is
  TileColor position, normal, albedo;
  std::array<std::uint32_t, raster::kTilePixels>
      object;  // index of the frame's object, kNoObject where nothing is
};
inline constexpr std::uint32_t kNoObject = 0xFFFFFFFFU;

/// Buffers of one worker, reused from tile to tile.
class TileShader {
 public:
  explicit TileShader(const ShaderJob& job);
  ~TileShader();

  /// The result is valid until the next call.
  const TileResult& shade(int tile_x, int tile_y);

 private:
  class Worker;
  std::unique_ptr<Worker> worker_;
};

/// Sample positions of a pixel, in 1/256 pixel from its centre; the first is the nearest to it. count: 1, 2, 4, 8, 16.
struct SampleOffset {
  int x, y;
};
std::span<const SampleOffset> sample_offsets(int count);

}  // namespace laterna::shade
