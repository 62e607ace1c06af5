// What a mirror shows to a view, or what is seen through it: a picture whose pixels are the view's. That of a mirrored view is
// turned for it.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "laterna/mirrors.h"
#include "light/mirror_plan.h"
#include "shade/cone_rays.h"
#include "shade/mirror_samples.h"
#include "shade/tile_layers.h"

namespace laterna::shade {

class MirrorPicture {
 public:
  /// `seen`: drawn into a picture of `width` × `height` pixels of so many samples, one of a
  /// mean. `mirror` must outlive this.
  MirrorPicture(const light::MirrorView& seen, const Mirror& mirror, int width, int height, int samples,
                double seconds, SampleIndex of_mean);

  [[nodiscard]] const Mirror& mirror() const { return *mirror_; }
  /// Of the mirror, toward the eye.
  [[nodiscard]] const glm::dvec3& normal_ws() const { return seen_.normal_ws; }
  /// Whether the eye is on the side of the mirror's volume.
  [[nodiscard]] bool sees_back() const { return seen_.sees_back; }
  /// The view of the picture, as it was drawn.
  [[nodiscard]] const raster::RasterView& drawn() const { return drawn_; }
  /// Metres from the mirror's plane, away from the eye.
  [[nodiscard]] double metres_behind(const glm::dvec3& position_ws) const {
    return seen_.offset - glm::dot(seen_.normal_ws, position_ws);
  }
  [[nodiscard]] double seconds() const { return seconds_; }
  /// Of rough mirrors.
  [[nodiscard]] const ConeRays& cone_rays() const { return cone_rays_; }
  /// Whether depths are looked at: WantedLayers::geometry must be set.
  [[nodiscard]] bool needs_depth() const {
    return mirror_->roughness > 0 || !mirror_->waves.empty() || seen_.is_refracted;
  }

  /// Whether WantedLayers::samples must be set. Flat and smooth mirrors look at each sample by itself. Where depths are looked at a pixel
  /// whose samples differ shows the first, whose depth is kept: their mean is the colour of nothing that lies there.
  [[nodiscard]] bool needs_samples() const { return samples_ > 1; }

  /// A tile of the mirrored picture. Calls for different tiles may come from several threads at once.
  void write(int tile_x, int tile_y, const TileResult& tile);
  /// Once all tiles are there.
  void finish();

  /// Radiance, and 1 / metres along the axis (0: infinitely far), at a pixel of the view, held to what was drawn.
  [[nodiscard]] const glm::vec4& at(int x, int y) const;
  /// Radiance of one sample of a pixel, the one that lies where the view's sample of that number does; that of the pixel where
  /// samples are not looked at, or all of them are nearly alike (MirrorSamples).
  [[nodiscard]] glm::vec3 at_sample(int x, int y, std::size_t number) const;
  /// The same between pixels' centres, x and y from the picture's corner, of means over 2^level × 2^level pixels.
  [[nodiscard]] glm::vec4 interpolated(float x, float y, int level) const;
  /// What at() has at the pixel that a place of the picture lies in, wherever that is.
  [[nodiscard]] const glm::vec4& nearest(float x, float y) const;
  /// What at() has at a place of the picture: between pixels on a surface, and of the pixel that the place lies in where surfaces end.
  [[nodiscard]] glm::vec4 on_surface(float x, float y) const;
  [[nodiscard]] float nearness(float x, float y) const { return on_surface(x, y).w; }
  /// Of all that is shown, metres along the axis; 0 where there is nothing.
  [[nodiscard]] float farthest() const { return farthest_; }
  /// The same, from the mirror's plane.
  [[nodiscard]] double deepest() const { return deepest_; }
  /// The level whose pixels are at most `side` of the finest wide.
  [[nodiscard]] int level_of(float side) const;

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<glm::vec4> pixels;
    [[nodiscard]] const glm::vec4& at(int x, int y) const;
  };

  void find_extent();

  const Mirror* mirror_;
  light::MirrorView seen_;
  std::size_t samples_;
  double seconds_;
  ConeRays cone_rays_;
  raster::RasterView drawn_;
  light::PixelBox box_;  // of the view's picture
  float farthest_ = 0;
  double deepest_ = 0;
  std::vector<Level> levels_;
  std::optional<MirrorSamples> kept_samples_;  // where they are needed
};

}  // namespace laterna::shade
