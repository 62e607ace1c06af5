// Portable float maps: little-endian, rows from the bottom. There is no alpha: colours stay multiplied by it.
#include <bit>
#include <vector>

#include "image/encoder.h"
#include "image/layers.h"

namespace laterna::image {
namespace {

// R, G, B or Y, or the only channel there is.
std::vector<const float*> find_channels(const LayeredImage& image) {
  const ColourChannels found = find_colour_channels(image);
  if (found.count > 0) return {found.colour.begin(), found.colour.begin() + found.count};
  if (image.channels.size() == 1) return {image.channels[0].values.data()};
  return {};
}

void append_f32(EncodedBytes& bytes, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::byte>(bits >> shift));
}

}  // namespace

Result<EncodedBytes> encode_pfm(const LayeredImage& image, const WriteOptions& options,
                                std::string_view name) {
  using Depth = WriteOptions::Depth;
  if (options.depth != Depth::automatic && options.depth != Depth::single) {
    return cannot_hold(name, "a PFM holds single precision only");
  }
  const std::vector<const float*> channels = find_channels(image);
  if (channels.empty()) {
    return cannot_hold(
        name, "a PFM needs channels R, G, B or Y, or a single one; the picture has " + channel_names(image));
  }
  EncodedBytes bytes;
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  bytes.reserve(width * height * channels.size() * sizeof(float) + 64);
  append(bytes, channels.size() == 3 ? "PF\n" : "Pf\n");
  append(bytes, std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n");
  for (std::size_t y = height; y-- > 0;) {
    for (std::size_t x = 0; x < width; ++x) {
      for (const float* const channel : channels) append_f32(bytes, channel[y * width + x]);
    }
  }
  return bytes;
}

}  // namespace laterna::image
