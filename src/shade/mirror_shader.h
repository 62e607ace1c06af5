// Samples on mirrors: what they show, and how much of it.
#pragma once

#include <memory>
#include <vector>

#include "raster/raster_view.h"
#include "shade/mirror_picture.h"

namespace laterna::shade {

/// The mirrors that a picture shows.
struct MirrorJob {
  /// At a cluster: the mirror that it belongs to, an index into `pictures`, or −1. Empty: there are none.
  std::vector<int> mirror_of_cluster;
  std::vector<std::unique_ptr<const MirrorPicture>> pictures;
};

/// A sample of a picture.
struct MirrorSample {
  int pixel_x, pixel_y;  ///< of the picture
  float x, y, q;         ///< its place from the view's origin, and its reversed depth
};

/// Radiance of what is mirrored, and the share of it that is seen; the rest is the surface's own.
struct Mirroring {
  glm::vec3 radiance, share;
};

/// Docs: mirrors.md, "How it is found".
class MirrorShader {
 public:
  MirrorShader(const MirrorJob& job, const raster::RasterView& view) : job_(job), view_(view) {}

  /// What the triangle's mirror shows; null: it is on none, or that is not shown.
  [[nodiscard]] const MirrorPicture* picture_of(TriangleId id) const {
    const int mirror = job_.mirror_of_cluster[cluster_of(id)];
    return mirror < 0 ? nullptr : job_.pictures[static_cast<std::size_t>(mirror)].get();
  }
  [[nodiscard]] Mirroring reflect(const MirrorPicture& picture, const MirrorSample& sample) const;

 private:
  struct Sight;
  [[nodiscard]] glm::vec3 blurred(const MirrorPicture& picture, const MirrorSample& sample, float x,
                                  float y) const;
  [[nodiscard]] glm::dvec3 normal_on_waves(const MirrorPicture& picture, const Sight& sight) const;
  [[nodiscard]] glm::vec2 displaced(const MirrorPicture& picture, const MirrorSample& sample,
                                    const Sight& sight, const glm::dvec3& normal_ws) const;

  const MirrorJob& job_;
  const raster::RasterView& view_;
};

}  // namespace laterna::shade
