#include "render/mirror_drawing.h"

#include <utility>

namespace laterna::render {

MirrorDrawing::MirrorDrawing(const frame::Frame& frame, const light::MirrorPlan& plan, int width, int height,
                             int samples, double seconds, SampleIndex of_mean, DrawPart draw_part)
    : plan_(plan),
      width_(width),
      height_(height),
      samples_(samples),
      seconds_(seconds),
      of_mean_(of_mean),
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
    const light::MirrorView& seen = plan_.views[i];
    if (seen.parent != parent) continue;
    job.shown.resize(plan_.mirrors.size());
    shade::MirrorPictures& pictures = job.shown[static_cast<std::size_t>(seen.mirror)];
    (seen.is_refracted ? pictures.refracted : pictures.mirrored) = draw_picture(static_cast<int>(i));
  }
  if (!job.shown.empty()) job.mirror_of_cluster = mirror_of_cluster_;
  return job;
}

void MirrorDrawing::leave_out_plane_of(int mirror, std::vector<bool>& clusters) const {
  const int plane = plan_.mirrors[static_cast<std::size_t>(mirror)].plane;
  for (const light::FlatMirror& other : plan_.mirrors) {
    if (other.plane != plane) continue;
    for (const std::uint32_t cluster : other.clusters) clusters[cluster] = true;
  }
}

// Neither the mirror itself nor what lies in one plane with it is in its picture; what is stuck to it is. Nor is the mirror
// that it is seen in, where the picture is taken from the wrong side of that: a ray that came from there does not meet it again.
// Displaced ones (Mirror::waves) would find it at the line where the two mirrors meet.
std::vector<bool> MirrorDrawing::left_out_of(const light::MirrorView& seen) const {
  std::vector<bool> clusters(mirror_of_cluster_.size());
  leave_out_plane_of(seen.mirror, clusters);
  if (seen.parent < 0) return clusters;
  const light::MirrorView& through = plan_.views[static_cast<std::size_t>(seen.parent)];
  const Pose& pose = seen.view.pose;
  const bool is_beyond =
      seen.view.projection.is_orthographic
          ? through.side(pose.position_ws + pose.forward_ws()) > through.side(pose.position_ws)
          : through.side(pose.position_ws) < 0;
  if (is_beyond) leave_out_plane_of(through.mirror, clusters);
  return clusters;
}

// First what is seen in it, so that few pictures are held at a time.
std::unique_ptr<const shade::MirrorPicture> MirrorDrawing::draw_picture(int index) const {
  const light::MirrorView& seen = plan_.views[static_cast<std::size_t>(index)];
  const Mirror& mirror = *plan_.mirrors[static_cast<std::size_t>(seen.mirror)].mirror;
  auto picture =
      std::make_unique<shade::MirrorPicture>(seen, mirror, width_, height_, samples_, seconds_, of_mean_);
  shade::MirrorJob within = draw_seen_by(index);
  const double sign = seen.is_refracted ? -1 : 1;
  const raster::CuttingPlane cut = {sign * seen.normal_ws, sign * seen.offset - seen.margin};
  const std::vector<bool> left_out = left_out_of(seen);
  PicturePart part;
  part.pixels = {seen.box.x_begin, seen.box.y_begin, seen.box.x_end, seen.box.y_end};
  part.cut = &cut;
  part.left_out = &left_out;
  part.write = [&](int tile_x, int tile_y, const shade::TileResult& tile) {
    picture->write(tile_x, tile_y, tile);
  };
  part.wants_depth = picture->needs_depth();
  part.wants_samples = picture->needs_samples();
  part.seen = &seen;
  draw_part_(seen.view, part, std::move(within));
  picture->finish();
  return picture;
}

}  // namespace laterna::render
