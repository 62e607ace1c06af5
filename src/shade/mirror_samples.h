// Samples of a mirrored picture, of those pixels that an edge runs through. Where a pixel's samples are nearly alike their mean
// serves for all of them, and 12 bytes for each need not be kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "light/pixel_box.h"
#include "shade/tile_layers.h"

namespace laterna::shade {

/// Samples are kept where one is farther from the mean, in any channel, than this part of the mean's largest channel. What a
/// mirror shows is off by no more.
inline constexpr float kAlikeSamples = 1.0F / 64;

/// Whether the mean of a pixel's TileResult::samples serves for all of them.
[[nodiscard]] bool are_alike(const TileResult& tile, std::size_t pixel);

class MirrorSamples {
 public:
  /// `box`: of the picture, what is drawn; `samples`: of each pixel.
  MirrorSamples(const light::PixelBox& box, int samples);

  /// TileResult::samples of a tile's pixels within the box, where they differ. Calls for different tiles may come from several
  /// threads at once.
  void write(int tile_x, int tile_y, const TileResult& tile);

  /// Radiance of each sample of a pixel within the box, all of them; null: their mean serves.
  [[nodiscard]] const glm::vec3* at(int x, int y) const;

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Tile {
    std::vector<std::uint16_t>
        places;  // by pixel of the tile, in units of a pixel's samples; empty: there are none
    std::vector<glm::vec3> radiance;
  };
  static constexpr std::uint16_t kNone = 0xFFFF;

  [[nodiscard]] std::size_t tile_number(int tile_x, int tile_y) const;

  light::PixelBox box_;
  std::size_t samples_;
  int left_, top_, tiles_x_;  // of the tiles that the box touches
  std::vector<Tile> tiles_;
};

}  // namespace laterna::shade
