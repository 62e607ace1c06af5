// Pictures of what mirrors and water show, the deepest first, each drawn from those that it depends on.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "light/mirror_plan.h"
#include "raster/triangle_bins.h"
#include "shade/mirror_shader.h"

namespace laterna::render {

/// A part of a picture, and where its tiles go.
struct PicturePart {
  raster::Rect pixels;
  const raster::CuttingPlane* cut = nullptr;    ///< null: nothing is cut
  const std::vector<bool>* left_out = nullptr;  ///< by cluster, what is not drawn; null: all is
  /// Called from several threads at once, with tiles that `pixels` touch.
  std::function<void(int tile_x, int tile_y, const shade::TileResult&)> write;
  bool wants_samples = false;  ///< WantedLayers::samples
  bool wants_depth = false;    ///< WantedLayers::geometry; the picture's other layers are its own affair
  std::uint32_t excluded_flags = 0;         ///< no clusters with any of these
  const light::MirrorView* seen = nullptr;  ///< what it is of; null: the picture's own view
};

class MirrorDrawing {
 public:
  /// Draws a part of a view's picture with those mirrors in it.
  using DrawPart = std::function<void(const View& view, const PicturePart& part, shade::MirrorJob mirrors)>;

  /// All must outlive it. Width and height: of the picture, in pixels, each of so many samples;
  /// `seconds`: scene time, which moves waves; `of_mean`: which picture of a mean it is.
  MirrorDrawing(const frame::Frame& frame, const light::MirrorPlan& plan, int width, int height, int samples,
                double seconds, SampleIndex of_mean, DrawPart draw_part);

  /// The mirrors in the picture's own view.
  [[nodiscard]] shade::MirrorJob draw() const { return draw_seen_by(-1); }

 private:
  [[nodiscard]] shade::MirrorJob draw_seen_by(int parent) const;
  [[nodiscard]] std::unique_ptr<const shade::MirrorPicture> draw_picture(int index) const;
  void leave_out_plane_of(int mirror, std::vector<bool>& clusters) const;
  [[nodiscard]] std::vector<bool> left_out_of(const light::MirrorView& seen) const;

  const light::MirrorPlan& plan_;
  int width_, height_, samples_;
  double seconds_;
  SampleIndex of_mean_;
  DrawPart draw_part_;
  std::vector<int> mirror_of_cluster_;
};

}  // namespace laterna::render
