// What a mirror shows to a view: a picture of the mirrored view, turned so that its pixels are the view's.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "laterna/mirrors.h"
#include "light/mirror_plan.h"
#include "shade/tile_layers.h"

namespace laterna::shade {

class MirrorPicture {
 public:
  /// `seen`: drawn into a picture that is `width` pixels wide. `mirror` must outlive it.
  MirrorPicture(const light::MirrorView& seen, const Mirror& mirror, int width, double seconds);

  [[nodiscard]] const Mirror& mirror() const { return *mirror_; }
  [[nodiscard]] const glm::dvec3& normal_ws() const { return normal_ws_; }
  [[nodiscard]] double seconds() const { return seconds_; }
  /// Whether depths are looked at: WantedLayers::geometry must be set.
  [[nodiscard]] bool needs_depth() const { return mirror_->roughness > 0 || !mirror_->waves.empty(); }

  /// A tile of the mirrored picture. Calls for different tiles may come from several threads at once.
  void write(int tile_x, int tile_y, const TileResult& tile);
  /// Once all tiles are there.
  void finish();

  /// Radiance, and 1 / metres along the axis (0: infinitely far), at a pixel of the view, held to what was drawn.
  [[nodiscard]] const glm::vec4& at(int x, int y) const;
  /// The same between pixels' centres, x and y from the picture's corner, of means over 2^level × 2^level pixels.
  [[nodiscard]] glm::vec4 interpolated(float x, float y, int level) const;
  /// The level whose pixels are at most `side` of the finest wide.
  [[nodiscard]] int level_of(float side) const;

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<glm::vec4> pixels;
    [[nodiscard]] const glm::vec4& at(int x, int y) const;
  };

  const Mirror* mirror_;
  glm::dvec3 normal_ws_;
  double seconds_;
  int picture_width_;
  light::PixelBox drawn_, box_;  // of the mirrored picture, and the same of the view's
  std::vector<Level> levels_;
};

}  // namespace laterna::shade
