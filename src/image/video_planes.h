// Pixels as video encoders take them, in integers: the same on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "laterna/image.h"

namespace laterna::image {

/// R'G'B' of 8 bits to limited-range Y'CbCr 4:2:0 of BT.709. With E'R, E'G, E'B in [0, 1]
///   E'Y = 0.2126 E'R + 0.7152 E'G + 0.0722 E'B,  E'Cb = (E'B − E'Y) / 1.8556,  E'Cr = (E'R − E'Y) / 1.5748
///   Y = 16 + 219 E'Y,  Cb = 128 + 224 E'Cb,  Cr = 128 + 224 E'Cr
/// (ITU-R BT.709-6, items 3.2 to 3.5), each rounded once to the nearest. A chroma sample is that of its block's mean R'G'B'.
class VideoPlanes {
 public:
  /// An even width and height.
  VideoPlanes(int width, int height);

  /// 8-bit R, G, B of that size.
  void convert(const Image& frame);

  struct Plane {
    int width = 0, height = 0;
    std::vector<std::uint8_t> values;  ///< rows from the top
  };
  [[nodiscard]] const Plane& y() const { return y_; }
  [[nodiscard]] const Plane& cb() const { return cb_; }
  [[nodiscard]] const Plane& cr() const { return cr_; }

 private:
  Plane y_, cb_, cr_;
};

}  // namespace laterna::image
