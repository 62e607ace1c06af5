#include "image/image_rows.h"

#include <algorithm>

namespace laterna::image {
namespace {

std::size_t bytes_per_row(const Image& image) {
  return image.bytes().size() / static_cast<std::size_t>(image.height());
}

}  // namespace

std::span<std::byte> row_bytes(Image& image, int y) {
  const std::size_t length = bytes_per_row(image);
  return image.bytes().subspan(static_cast<std::size_t>(y) * length, length);
}

std::span<const std::byte> row_bytes(const Image& image, int y) {
  const std::size_t length = bytes_per_row(image);
  return image.bytes().subspan(static_cast<std::size_t>(y) * length, length);
}

void flip_rows(Image& image) {
  for (int y = 0; y < image.height() / 2; ++y) {
    const std::span<std::byte> upper = row_bytes(image, y);
    const std::span<std::byte> lower = row_bytes(image, image.height() - 1 - y);
    std::swap_ranges(upper.begin(), upper.end(), lower.begin());
  }
}

void mirror_rows(Image& image) {
  const std::size_t pixel = bytes_per_row(image) / static_cast<std::size_t>(image.width());
  for (int y = 0; y < image.height(); ++y) {
    const std::span<std::byte> row = row_bytes(image, y);
    std::reverse(row.begin(),
                 row.end());  // reverses the bytes of each pixel too; the next line puts them right
    for (std::size_t i = 0; i < row.size(); i += pixel) std::reverse(row.data() + i, row.data() + i + pixel);
  }
}

}  // namespace laterna::image
