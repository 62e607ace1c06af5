#include "laterna/image.h"

#include <algorithm>
#include <type_traits>

namespace laterna {
namespace {

std::size_t bytes_per_value(PixelType type) {
  switch (type) {
    case PixelType::u8:
      return 1;
    case PixelType::u16:
      return 2;
    case PixelType::f32:
      return 4;
  }
  return 0;
}

template <class T>
constexpr PixelType kPixelTypeOf = std::is_same_v<T, std::uint8_t>    ? PixelType::u8
                                   : std::is_same_v<T, std::uint16_t> ? PixelType::u16
                                                                      : PixelType::f32;

}  // namespace

Image::Image(int width, int height, int channels, PixelType type, Transfer transfer) {
  const auto is_side = [](int side) { return side >= 1 && side <= kMaxImageSide; };
  if (!is_side(width) || !is_side(height) || channels < 1 || channels > 4) return;
  width_ = width;
  height_ = height;
  channels_ = channels;
  type_ = type;
  transfer_ = transfer;
  bytes_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                static_cast<std::size_t>(channels) * bytes_per_value(type));
}

template <class T>
std::span<T> Image::values() {
  if (type_ != kPixelTypeOf<T>) return {};
  return {reinterpret_cast<T*>(bytes_.data()), bytes_.size() / sizeof(T)};
}

template <class T>
std::span<const T> Image::values() const {
  if (type_ != kPixelTypeOf<T>) return {};
  return {reinterpret_cast<const T*>(bytes_.data()), bytes_.size() / sizeof(T)};
}

template std::span<std::uint8_t> Image::values();
template std::span<std::uint16_t> Image::values();
template std::span<float> Image::values();
template std::span<const std::uint8_t> Image::values() const;
template std::span<const std::uint16_t> Image::values() const;
template std::span<const float> Image::values() const;

float Image::value(int x, int y, int channel) const {
  const std::size_t pixel =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  const std::size_t index = pixel * static_cast<std::size_t>(channels_) + static_cast<std::size_t>(channel);
  switch (type_) {
    case PixelType::u8:
      return static_cast<float>(values<std::uint8_t>()[index]) / 255.0F;
    case PixelType::u16:
      return static_cast<float>(values<std::uint16_t>()[index]) / 65535.0F;
    case PixelType::f32:
      return values<float>()[index];
  }
  return 0;
}

const Channel* LayeredImage::find(std::string_view name) const {
  const auto found =
      std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

}  // namespace laterna
