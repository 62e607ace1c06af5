// Between pictures of interleaved pixels and pictures of named channels.
#pragma once

#include <array>
#include <string>

#include "laterna/image.h"

namespace laterna::image {

/// The channels R, G, B or Y, and A. Linear light, colours multiplied by alpha; or the stored values from 0
/// to 1.
LayeredImage layers_from_image(const Image& image, ChannelValues values);

/// The channels of a LayeredImage that make a picture: R, G, B or Y, and A.
struct ColourChannels {
  std::array<const float*, 3> colour = {};  ///< one or three are set
  int count = 0;                            ///< 1 or 3; 0 where there is no colour
  const float* alpha = nullptr;             ///< or none
};
ColourChannels find_colour_channels(const LayeredImage& image);

/// Row y of colour channel `channel`, divided by alpha: what a format stores whose colours are not multiplied
/// by it.
void unmultiplied_row(const ColourChannels& channels, int channel, int width, int y, std::span<float> row);

/// "R G B Z": for messages.
std::string channel_names(const LayeredImage& image);

/// What is wrong with a picture that a caller has put together: its size, its channels' names and lengths; empty if
/// nothing is.
std::string find_picture_fault(const LayeredImage& image);

}  // namespace laterna::image
