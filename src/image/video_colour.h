// Decoded video frames as pictures, in integers: the same on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "image/video_interface.h"
#include "laterna/image.h"

namespace laterna::image {

/// Turns frames into R, G, B: sRGB-encoded, 8 bits where all components have at most 8, else 16; or grey, each with alpha
/// where there is one. With E'Y, E'Cb and E'Cr the components brought to [0, 1] and [−½, ½] by their range,
///   R = E'Y + 2 (1 − K_R) E'Cr,   B = E'Y + 2 (1 − K_B) E'Cb,   K_R R + K_G G + K_B B = E'Y
/// (ITU-R BT.601-7, BT.709-6, BT.2020-2 table 4, SMPTE 240M), rounded once, to the nearest, and clamped. Every pixel takes
/// the chroma sample of its block as it is. The encoded values are read as sRGB, as screens show them.
class VideoColour {
 public:
  /// Bits of a component: 1…16.
  Image convert(const LaternaVideoPicture& picture);

 private:
  // What each code of a component adds to a channel, in 2⁻³² steps of the result.
  using Terms = std::vector<std::int64_t>;
  struct Key {
    LaternaVideoMatrix matrix{};
    int is_full_range = -1, depth = 0, largest = 0;
    bool operator==(const Key&) const = default;
  };
  void make_terms(const Key& key);
  template <class Value>
  void convert_chroma(const LaternaVideoPicture& picture, Image& image);

  Key key_;
  Terms luma_, red_from_cr_, green_from_cr_, green_from_cb_, blue_from_cb_;
};

}  // namespace laterna::image
