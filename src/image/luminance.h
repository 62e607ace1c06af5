// How bright a colour is.
#pragma once

namespace laterna::image {

/// Rec. 709 luminance of linear light (ITU-R BT.709, item 3.2).
template <class Number>
constexpr Number luminance(Number r, Number g, Number b) {
  return static_cast<Number>(0.2126) * r + static_cast<Number>(0.7152) * g + static_cast<Number>(0.0722) * b;
}

}  // namespace laterna::image
