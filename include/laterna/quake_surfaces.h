// How Quake (1996) showed baked light: textures times light maps of one byte, in a cache of combined surfaces. After MIT's
// lecture 20 (rows 71 and 72), and Abrash 1997, Graphics Programming Black Book, chapter 68. docs/bake.md
#pragma once

#include <cstddef>
#include <memory>

#include "laterna/image.h"
#include "laterna/render.h"

namespace laterna {

/// Texels of a combined surface along a luxel's side, at full size; halved at each of the smaller sizes.
inline constexpr int kQuakeTexelsPerLuxel = 16;
inline constexpr int kQuakeSizes = 4;

struct QuakeSettings {
  int width = 320, height = 200;  ///< of pictures, 1…16384
  /// Combined surfaces take at most so much memory, those of one picture apart; 0: none is kept from one to the next.
  std::size_t cache_bytes = std::size_t{16} << 20U;
  double white_lux = 0;  ///< irradiance of the intensity 255; 0: the greatest luminance in the light maps
  RendererOptions options = {};
};

enum class QuakePicture {
  texture,    ///< base colours alone
  light_map,  ///< intensity alone, as it is kept: a byte for each luxel, bilinear between
  product,    ///< both: the cached surfaces
};

struct QuakeStatistics {
  std::size_t pictures = 0;               ///< of QuakePicture::product
  std::size_t asked = 0;                  ///< surfaces that they asked for, each once for a picture
  std::size_t found = 0;                  ///< of these, in the cache
  std::size_t dropped = 0;                ///< from the cache, because it was full: those unused for longest
  std::size_t bytes = 0, most_bytes = 0;  ///< in the cache now, and at most so far
  [[nodiscard]] double hit_rate() const {
    return asked == 0 ? 0 : static_cast<double>(found) / static_cast<double>(asked);
  }
};

/// A walk through a baked scene. Every chart of its light maps is a surface; a picture shows each at one of four sizes, by the
/// distance of its nearest pixel, and reads it without a filter, as Quake did. What is invisible to shadows is not shown, nor
/// is what has no light map: it is black.
class QuakeWalk {
 public:
  /// Errors: a faulty scene, none of whose materials has a light map; a faulty setting.
  static Result<QuakeWalk> create(Scene baked, const QuakeSettings& settings = {});
  ~QuakeWalk();
  QuakeWalk(const QuakeWalk&) = delete;
  QuakeWalk& operator=(const QuakeWalk&) = delete;
  QuakeWalk(QuakeWalk&&) noexcept;
  QuakeWalk& operator=(QuakeWalk&&) noexcept;

  /// RGB of 8 bits, sRGB. Does not depend on what the cache holds.
  Image draw(const View& view, QuakePicture picture = QuakePicture::product);
  [[nodiscard]] const QuakeStatistics& statistics() const;

 private:
  struct Implementation;
  explicit QuakeWalk(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace laterna
