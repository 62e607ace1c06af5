#include "image/layers.h"

#include <cstddef>
#include <set>
#include <string_view>

#include "base/elementary.h"
#include "image/colour.h"

namespace laterna::image {
namespace {

constexpr std::array<const char*, 4> kRgba = {"R", "G", "B", "A"};
constexpr std::array<const char*, 2> kGrey = {"Y", "A"};

float decoded_value(const Image& image, std::size_t index) {
  switch (image.type()) {
    case PixelType::u8:
      return linear_from_srgb8()[image.values<std::uint8_t>()[index]];
    case PixelType::u16:
      return linear_from_srgb16()[image.values<std::uint16_t>()[index]];
    case PixelType::f32:
      return static_cast<float>(linear_from_srgb(image.values<float>()[index]));
  }
  return 0;
}

// As Image::value, by position in storage.
float stored_value(const Image& image, std::size_t index) {
  switch (image.type()) {
    case PixelType::u8:
      return static_cast<float>(image.values<std::uint8_t>()[index]) / 255.0F;
    case PixelType::u16:
      return static_cast<float>(image.values<std::uint16_t>()[index]) / 65535.0F;
    case PixelType::f32:
      return image.values<float>()[index];
  }
  return 0;
}

void multiply_by_alpha(LayeredImage& layers) {
  const std::vector<float>& alpha = layers.channels.back().values;
  for (std::size_t c = 0; c + 1 < layers.channels.size(); ++c) {
    std::vector<float>& values = layers.channels[c].values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] *= alpha[i];
  }
}

}  // namespace

LayeredImage layers_from_image(const Image& image, ChannelValues values) {
  LayeredImage layers;
  layers.width = image.width();
  layers.height = image.height();
  const auto channels = static_cast<std::size_t>(image.channels());
  const std::size_t pixels =
      static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  for (std::size_t c = 0; c < channels; ++c) {
    Channel channel{channels >= 3 ? kRgba[c] : kGrey[c], std::vector<float>(pixels)};
    const bool is_alpha = image.has_alpha() && c + 1 == channels;
    const bool has_curve = values == ChannelValues::linear && image.transfer() == Transfer::srgb && !is_alpha;
    for (std::size_t i = 0; i < pixels; ++i) {
      const std::size_t index = i * channels + c;
      channel.values[i] = has_curve ? decoded_value(image, index) : stored_value(image, index);
    }
    layers.channels.push_back(std::move(channel));
  }
  if (values == ChannelValues::linear && image.has_alpha()) multiply_by_alpha(layers);
  return layers;
}

ColourChannels find_colour_channels(const LayeredImage& image) {
  ColourChannels found;
  const auto data = [&](const char* name) -> const float* {
    const Channel* channel = image.find(name);
    return channel == nullptr ? nullptr : channel->values.data();
  };
  found.colour = {data("R"), data("G"), data("B")};
  found.count = 3;
  if (found.colour[0] == nullptr || found.colour[1] == nullptr || found.colour[2] == nullptr) {
    found.colour = {data("Y"), nullptr, nullptr};
    found.count = found.colour[0] == nullptr ? 0 : 1;
  }
  found.alpha = data("A");
  return found;
}

void unmultiplied_row(const ColourChannels& channels, int channel, int width, int y, std::span<float> row) {
  const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  const float* const colour = channels.colour[static_cast<std::size_t>(channel)] + first;
  for (std::size_t x = 0; x < row.size(); ++x) {
    const float alpha = channels.alpha == nullptr ? 1 : channels.alpha[first + x];
    row[x] = alpha > 0 && alpha < 1 ? colour[x] / alpha : colour[x];
  }
}

std::string channel_names(const LayeredImage& image) {
  std::string names;
  for (const Channel& channel : image.channels) names += (names.empty() ? "" : " ") + channel.name;
  return names.empty() ? "none" : names;
}

std::string find_picture_fault(const LayeredImage& image) {
  const auto is_side = [](int side) { return side >= 1 && side <= kMaxImageSide; };
  if (!is_side(image.width) || !is_side(image.height)) {
    return "the picture is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
           " pixels; each side must be from 1 to " + std::to_string(kMaxImageSide);
  }
  if (image.channels.empty()) return "the picture has no channels";
  std::set<std::string_view> names;
  for (const Channel& channel : image.channels) {
    if (channel.name.empty()) return "a channel has no name";
    if (!names.insert(channel.name).second) return "two channels are named \"" + channel.name + "\"";
    if (channel.values.size() !=
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
      return "channel \"" + channel.name + "\" has " + std::to_string(channel.values.size()) +
             " values; the picture is " + std::to_string(image.width) + " x " + std::to_string(image.height);
    }
  }
  return {};
}

}  // namespace laterna::image
