#include "render/silhouette_painter.h"

#include <algorithm>

#include "base/aligned_vector.h"
#include "raster/tile_raster.h"
#include "shade/surface_cut.h"

namespace laterna::render {
namespace {

// Bins that no light's maps use.
constexpr std::size_t kBinsOwner = std::size_t{1} << 40U;

// A part of the frame counts its triangles from its own first cluster.
class CutOfPart final : public raster::AlphaCut {
 public:
  CutOfPart(const raster::AlphaCut& of_frame, std::uint32_t first_cluster)
      : of_frame_(of_frame), first_(first_cluster << kTriangleBits) {}
  void keep(TriangleId id, raster::CutSamples& samples, std::uint16_t* kept) const override {
    of_frame_.keep(first_ + id, samples, kept);
  }

 private:
  const raster::AlphaCut& of_frame_;
  TriangleId first_;
};

// What is nearer than the far plane in a tile, as darkness in the picture.
void darken(const AlignedVector<float>& depth, float reversed_far, int tile_x, int tile_y,
            shadow::ArrivingLight& picture) {
  const int x_end = std::min(raster::kTileSide, picture.width - tile_x * raster::kTileSide);
  const int y_end = std::min(raster::kTileSide, picture.height - tile_y * raster::kTileSide);
  for (int y = 0; y < y_end; ++y) {
    const auto row =
        static_cast<std::size_t>(tile_y * raster::kTileSide + y) * static_cast<std::size_t>(picture.width) +
        static_cast<std::size_t>(tile_x * raster::kTileSide);
    for (int x = 0; x < x_end; ++x) {
      if (depth[static_cast<std::size_t>(raster::index_in_tile(x, y))] != reversed_far)
        picture.values[row + static_cast<std::size_t>(x)] = 0;
    }
  }
}

}  // namespace

SilhouettePainter::SilhouettePainter(const frame::Frame& frame, BinsPool& bins, InstructionSet set,
                                     CasterFaces faces)
    : frame_(frame), bins_(bins), set_(set), faces_(faces) {
  // The clusters of an object are neighbours, and objects follow one another; some have none.
  for (std::uint32_t c = 0; c < frame.clusters.size(); ++c) {
    while (first_cluster_.size() <= frame.clusters[c].object) first_cluster_.push_back(c);
  }
  first_cluster_.resize(frame.object_names.size() + 1, static_cast<std::uint32_t>(frame.clusters.size()));
}

void SilhouettePainter::paint(std::uint32_t object, const raster::RasterView& view,
                              shadow::ArrivingLight& picture) const {
  const std::uint32_t first = first_cluster_[object];
  TriangleClusters part = frame_.geometry();
  part.corners += static_cast<std::size_t>(first) << kTriangleBits;
  part.clusters = part.clusters.subspan(first, first_cluster_[object + 1] - first);
  raster::BinOptions options;
  options.cull = faces_ == CasterFaces::back_only ? raster::CullFaces::front : raster::CullFaces::none;
  options.required_flags = kCastsShadow;
  options.excluded_flags = kPaneFlags;  // see shadow/panes.h
  options.pixels = {0, 0, view.width, view.height};
  options.instruction_set = set_;
  const BinsPool::Lease bins = bins_.take(kBinsOwner);
  bins->fill(view, part, options, TaskPool(1));
  const shade::SurfaceCut cut({&frame_, &view, Interpolation::perspective, 1}, true, set_);
  const CutOfPart cut_of_part(cut, first);
  AlignedVector<float> depth(raster::kTilePixels);
  for (int y = 0; y * raster::kTileSide < view.height; ++y) {
    for (int x = 0; x * raster::kTileSide < view.width; ++x) {
      std::fill(depth.begin(), depth.end(), view.reversed_far);
      const raster::TileTask task = {&view, bins->batches(), x, y, 0, 0, &cut_of_part};
      raster::rasterise_depth_for(set_)(task, depth.data());
      darken(depth, view.reversed_far, x, y, picture);
    }
  }
}

}  // namespace laterna::render
