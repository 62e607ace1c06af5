// Heights from pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "laterna/terrain.h"

namespace laterna {
namespace {

tl::unexpected<Error> fault(const std::filesystem::path& file, std::string place, std::string message) {
  return tl::unexpected(
      Error(Failure::bad_input, Diagnostic{file.string(), std::move(place), std::move(message)}));
}

std::string find_size_fault(int columns, int rows) {
  if (columns < 2 || rows < 2)
    return fmt::format("a height map has at least 2 x 2 samples, this one has {} x {}", columns, rows);
  if (static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) > kMaxHeightSamples) {
    return fmt::format("a height map has at most {} samples (8192 x 8192), this one has {} x {}",
                       kMaxHeightSamples, columns, rows);
  }
  return {};
}

template <class T>
void copy_first_channel(const Image& image, double factor, std::vector<float>& heights) {
  const std::span<const T> values = image.values<T>();
  const auto step = static_cast<std::size_t>(image.channels());
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<float>(values[i * step] * factor);
}

}  // namespace

Result<HeightMap> read_height_map(const std::filesystem::path& file, double height) {
  // A picture that is too large is not even decoded.
  const Result<ImageHeader> header = read_image_header(file);
  if (!header) return tl::unexpected(header.error());
  if (std::string text = find_size_fault(header->width, header->height); !text.empty())
    return fault(file, {}, std::move(text));
  const Result<Image> image = read_image(file);
  if (!image) return tl::unexpected(image.error());
  HeightMap map = {image->width(), image->height(), {}};
  map.heights.resize(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
  switch (image->type()) {
    case PixelType::u8:
      copy_first_channel<std::uint8_t>(*image, height / 255, map.heights);
      break;
    case PixelType::u16:
      copy_first_channel<std::uint16_t>(*image, height / 65535, map.heights);
      break;
    case PixelType::f32:
      copy_first_channel<float>(*image, height, map.heights);
      break;
  }
  const auto bad = std::find_if(map.heights.begin(), map.heights.end(),
                                [](float h) { return !(std::abs(h) <= static_cast<float>(kMaxCoordinate)); });
  if (bad == map.heights.end()) return map;
  const auto at = static_cast<int>(bad - map.heights.begin());
  return fault(file, fmt::format("column {}, row {}", at % map.columns, at / map.columns),
               fmt::format("expected a height within {:g} m, got {:g}", kMaxCoordinate, *bad));
}

}  // namespace laterna
