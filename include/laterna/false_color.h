// Amounts as colours, with a scale that says which.
#pragma once

#include <string>

#include "laterna/image.h"

namespace laterna {

struct FalseColorSettings {
  /// Value at the upper end of the scale. 0: a round number that all but 0.2 % of the covered pixels stay below.
  double maximum = 0;
  std::string unit;       ///< over the scale, such as "lx"; ASCII
  bool iso_lines = true;  ///< where the value passes a number of the scale
};

/// A channel of light or data as colours from dark blue (0) over green to red (the maximum), pink above; pixels that show
/// nothing (A is 0, or the value is no finite number) are dark grey. Amounts are divided by A where the picture has one, so
/// that edges of objects keep their value. The scale stands to the right of the picture, which is widened by it. R, G and B,
/// linear, to be shown as they are. Metadata "laterna.scale_maximum" tells the maximum.
/// Error: no such channel, no pixel, or a maximum that is neither 0 nor from 1e-12 to 1e15.
Result<LayeredImage> false_color_picture(const LayeredImage& image, const std::string& channel,
                                         const FalseColorSettings& settings = {});

}  // namespace laterna
