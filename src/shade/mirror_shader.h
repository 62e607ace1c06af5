// Samples on mirrors and water: what they show, and how much of it.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "raster/raster_view.h"
#include "shade/mirror_picture.h"

namespace laterna::shade {

/// What one mirror shows to a view; null: it does not.
struct MirrorPictures {
  std::unique_ptr<const MirrorPicture> mirrored, refracted;
};

/// The mirrors that a picture shows.
struct MirrorJob {
  /// At a cluster: the mirror that it belongs to, an index into `shown`, or −1. Empty: there are none.
  std::vector<int> mirror_of_cluster;
  std::vector<MirrorPictures> shown;
};

/// A sample of a picture.
struct MirrorSample {
  int pixel_x, pixel_y;  ///< of the picture
  float x, y, q;         ///< its place from the view's origin, and its reversed depth
  std::size_t number;    ///< among the samples of its pixel
};

/// Radiance of what is mirrored, and the share of it that is seen; the rest is the surface's own.
struct Mirroring {
  glm::vec3 radiance, share;
};

/// Docs: mirrors.md, "How it is found".
class MirrorShader {
 public:
  /// `sampled_at`: where in its pixels the pictures' one sample lies, from their centres.
  MirrorShader(const MirrorJob& job, const raster::RasterView& view, glm::vec2 sampled_at)
      : job_(job), view_(view), sampled_at_(sampled_at) {}

  /// What the triangle's mirror shows; null: it is on none, or that is not shown.
  [[nodiscard]] const MirrorPicture* picture_of(TriangleId id) const {
    const MirrorPictures* shown = shown_by(id);
    return shown == nullptr ? nullptr : shown->mirrored.get();
  }
  /// What is seen through it, likewise.
  [[nodiscard]] const MirrorPicture* refracted_by(TriangleId id) const {
    const MirrorPictures* shown = shown_by(id);
    return shown == nullptr ? nullptr : shown->refracted.get();
  }
  [[nodiscard]] Mirroring reflect(const MirrorPicture& picture, const MirrorSample& sample) const;
  /// Radiance of what lies behind, of which the surface shows what it neither mirrors nor covers.
  [[nodiscard]] glm::vec3 refract(const MirrorPicture& picture, const MirrorSample& sample) const;

 private:
  // A look at a place of a mirror.
  struct Sight {
    glm::dvec3 along_ws;  // unit, from the eye
    glm::dvec3 place_ws;  // on the mirror
    double distance;      // metres along the axis
    double footprint;     // of a pixel, metres along the mirror
  };

  [[nodiscard]] const MirrorPictures* shown_by(TriangleId id) const {
    const int mirror = job_.mirror_of_cluster[cluster_of(id)];
    return mirror < 0 ? nullptr : &job_.shown[static_cast<std::size_t>(mirror)];
  }
  [[nodiscard]] glm::dvec3 ray_of(const MirrorSample& sample) const;
  [[nodiscard]] Sight sight_of(const MirrorPicture& picture, const MirrorSample& sample) const;
  [[nodiscard]] glm::vec2 displaced(const MirrorPicture& picture, const Sight& sight,
                                    const glm::dvec3& normal_ws) const;
  [[nodiscard]] glm::vec3 rough(const MirrorPicture& picture, const MirrorSample& sample, float x,
                                float y) const;

  const MirrorJob& job_;
  const raster::RasterView& view_;
  glm::vec2 sampled_at_;
};

}  // namespace laterna::shade
