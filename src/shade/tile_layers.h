// What a tile gives beside beauty: the layers of its surfaces and of each light.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "frame/frame.h"
#include "raster/tile_raster.h"
#include "shade/illumination.h"
#include "shade/photograph_painter.h"
#include "shade/pixel_density.h"
#include "shade/tile_planes.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// What is wanted besides beauty.
struct WantedLayers {
  bool lights = false;      // ambient, one per light, the environment
  bool visibility = false;  // per light
  bool slide_uv = false;    // per projector
  bool lux = false;
  bool pixel_density = false;  // per projector
  bool geometry = false;       // depth, position, normal, object
  bool albedo = false;
  bool photographs = false;
  bool passes = false;   // Passes::multi: the frame buffer after each pass
  bool samples = false;  // beauty of each sample of a pixel, where there are several
};

/// What came out. Planes of layers that were not wanted are empty or unspecified.
struct TileResult {
  TileColor beauty;
  std::vector<TileColor> samples;  // wanted.samples: beauty of each
  TilePlane alpha;
  std::vector<TileColor>
      radiance;  // wanted.lights: ambient, one per light, the environment where there is one
  std::vector<TilePlane> visibility;  // wanted.visibility: per light
  std::vector<TilePlane> slide_s, slide_t;
  std::vector<TileColor> pass_colors;  // wanted.passes: after ambient, then after each light
  /// wanted.passes in the papers' model: c_p of the slide algorithm, ambient + Σ slide · α so far, not yet times c.
  std::vector<TileColor> pass_illumination;
  TilePlane lux;
  std::vector<TilePlane> pixel_density;  // wanted.pixel_density: per light
  TilePlane depth;                       // metres along the axis, +infinity where nothing is
  TileColor position, normal, albedo;
  TilePlane photographs_seen;               // how many see the sample, −1 where nothing is
  std::vector<TilePlane> photograph_share;  // per photograph: of the sample's colour
  std::vector<TileColor> photograph_color;  // before gain, NaN where the photograph does not see the sample
  std::array<std::uint32_t, raster::kTilePixels>
      object;  // index of the frame's object, kNoObject where nothing is
};
inline constexpr std::uint32_t kNoObject = 0xFFFFFFFFU;

/// Fills in the layers of a tile that are not radiance, batch by batch. Visibility and lux add up over the samples of a
/// pixel; all others are of the first sample, the one nearest to the pixel's centre.
class TileLayers {
 public:
  TileLayers(const frame::Frame& frame, const raster::RasterView& view, const WantedLayers& wanted,
             TileResult& result);

  /// Nothing is there yet.
  void start_tile();
  /// Depth, position, normal, object, albedo.
  void store_geometry(const shadow::SurfaceSamples& samples, const SurfacePoints& points);
  void store_photographs(const shadow::SurfaceSamples& samples, const PhotographPainter& painter);
  void add_visibility(std::size_t light, const shadow::SurfaceSamples& samples,
                      const shadow::Arrival& arrival);
  void store_slide_coordinates(std::size_t light, const shadow::SurfaceSamples& samples,
                               const Irradiance& irradiance);
  /// Illuminance: Rec. 709 luminance of what falls on the surface, by the normal of its triangle.
  void add_lux(const shadow::SurfaceSamples& samples, const Irradiance& irradiance,
               const shadow::Arrival& arrival);
  void store_pixel_density(std::size_t light, const shadow::SurfaceSamples& samples);
  /// Pass 2 of the slide algorithm, c_p ← c_p + c_τ where light arrives: onto `sum`.
  static void add_illumination(const shadow::SurfaceSamples& samples, const Irradiance& irradiance,
                               const shadow::Arrival& arrival, TileColor& sum);

 private:
  const frame::Frame& frame_;
  const raster::RasterView& view_;
  const WantedLayers& wanted_;
  TileResult& result_;
  std::vector<std::optional<PixelDensity>> pixel_densities_;  // of the lights that are projectors with pixels
};

}  // namespace laterna::shade
