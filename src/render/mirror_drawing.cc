#include "render/mirror_drawing.h"

#include <utility>

namespace laterna::render {

MirrorDrawing::MirrorDrawing(const frame::Frame& frame, const light::MirrorPlan& plan, int width,
                             double seconds, DrawPart draw_part)
    : plan_(plan),
      width_(width),
      seconds_(seconds),
      draw_part_(std::move(draw_part)),
      mirror_of_cluster_(frame.clusters.size(), -1) {
  for (std::size_t m = 0; m < plan.mirrors.size(); ++m) {
    for (const std::uint32_t cluster : plan.mirrors[m].clusters)
      mirror_of_cluster_[cluster] = static_cast<int>(m);
  }
}

shade::MirrorJob MirrorDrawing::draw_seen_by(int parent) const {
  shade::MirrorJob job;
  for (std::size_t i = 0; i < plan_.views.size(); ++i) {
    if (plan_.views[i].parent != parent) continue;
    job.pictures.resize(plan_.mirrors.size());
    job.pictures[static_cast<std::size_t>(plan_.views[i].mirror)] = draw_picture(static_cast<int>(i));
  }
  if (!job.pictures.empty()) job.mirror_of_cluster = mirror_of_cluster_;
  return job;
}

// First what is seen in it, so that few pictures are held at a time.
std::unique_ptr<const shade::MirrorPicture> MirrorDrawing::draw_picture(int index) const {
  const light::MirrorView& seen = plan_.views[static_cast<std::size_t>(index)];
  const Mirror& mirror = *plan_.mirrors[static_cast<std::size_t>(seen.mirror)].mirror;
  auto picture = std::make_unique<shade::MirrorPicture>(seen, mirror, width_, seconds_);
  shade::MirrorJob within = draw_seen_by(index);
  const raster::CuttingPlane cut = {seen.normal_ws, seen.offset, seen.tolerance};
  PicturePart part;
  part.pixels = {seen.box.x_begin, seen.box.y_begin, seen.box.x_end, seen.box.y_end};
  part.cut = &cut;
  part.write = [&](int tile_x, int tile_y, const shade::TileResult& tile) {
    picture->write(tile_x, tile_y, tile);
  };
  part.wants_depth = picture->needs_depth();
  part.is_mirrored = true;
  part.is_turned = seen.depth % 2 == 1;
  draw_part_(seen.view, part, std::move(within));
  picture->finish();
  return picture;
}

}  // namespace laterna::render
