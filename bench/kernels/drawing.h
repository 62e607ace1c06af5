// What kernels are measured on: a picture whose triangles are sorted into tiles, and samples of it.
#pragma once

#include <memory>

#include "raster/tile_raster.h"
#include "reference/shapes.h"
#include "shade/surface_points.h"

namespace laterna {

/// Sides of the picture.
inline constexpr int kDrawingSide = 512;

/// Tori of about 6 and about 100 pixels per triangle, and a floor whose two triangles fill the picture. Each is built
/// once.
const frame::Frame& small_triangles();
const frame::Frame& wide_triangles();
const frame::Frame& floor_triangles();
View torus_view();
View floor_view();

/// A textured floor, lit from above by a light of each kind that kernels tell apart, in the order of FloorLight; a ball
/// stands on it.
enum class FloorLight : std::uint8_t { point, slide };
const frame::Frame& lit_floor();

/// A frame's triangles sorted into tiles.
class Drawing {
 public:
  Drawing(const frame::Frame& frame, const View& view, InstructionSet set);

  [[nodiscard]] const frame::Frame& frame() const { return frame_; }
  [[nodiscard]] const raster::RasterView& view() const { return view_; }
  [[nodiscard]] const raster::BinOptions& options() const { return options_; }
  [[nodiscard]] std::size_t triangles_binned() const { return bins_.statistics().triangles_binned; }

  void sort_into_tiles();
  void draw_depth();
  void draw_visibility();
  /// Pixels of the picture that show something.
  std::size_t count_covered();

  /// 256 neighbouring samples, the first of them at pixel (x, y), a multiple of 16. All must lie on the floor.
  void take_samples(int x, int y, shadow::SurfaceSamples& samples);

 private:
  template <class Draw>
  void for_each_tile(Draw draw);

  TaskPool pool_{1};
  const frame::Frame& frame_;
  raster::RasterView view_;
  InstructionSet set_;
  raster::BinOptions options_;
  raster::TriangleBins bins_;
  alignas(64) float depth_[raster::kTilePixels] = {};
  alignas(64) TriangleId ids_[raster::kTilePixels] = {};
};

/// Samples of the lit floor with what shading knows of them.
struct FloorSamples {
  /// `x`, `y`: see Drawing::take_samples.
  FloorSamples(int x, int y, InstructionSet set, int anisotropy);
  [[nodiscard]] const frame::Surface& surface() const;

  Drawing drawing;
  shade::PointSource source;
  std::unique_ptr<shadow::SurfaceSamples> samples = std::make_unique<shadow::SurfaceSamples>();
  std::unique_ptr<shade::SurfacePoints> points = std::make_unique<shade::SurfacePoints>();
};

}  // namespace laterna
