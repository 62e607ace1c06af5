// side_by_side OUT.png A.png B.png …: pictures of one height next to each other, as the papers print their
// figures.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <span>
#include <vector>

#include "laterna/image.h"

namespace {

using laterna::Image;

/// Code of channel c at (x, y); grey pictures have the same in every channel.
std::uint8_t at(const Image& picture, int x, int y, int c) {
  const std::size_t pixel =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width()) + static_cast<std::size_t>(x);
  const int channel = picture.channels() >= 3 ? c : 0;
  return picture.values<std::uint8_t>()[pixel * static_cast<std::size_t>(picture.channels()) +
                                        static_cast<std::size_t>(channel)];
}

/// Copies the picture, scaled to the height of the sheet by the mean of each pixel's area or its nearest
/// pixel.
void paste(const Image& picture, Image& sheet, int left, int width) {
  const std::span<std::uint8_t> out = sheet.values<std::uint8_t>();
  const int height = sheet.height();
  for (int y = 0; y < height; ++y) {
    const int y0 = y * picture.height() / height;
    const int y1 = std::max(y0 + 1, (y + 1) * picture.height() / height);
    for (int x = 0; x < width; ++x) {
      const int x0 = x * picture.width() / width;
      const int x1 = std::max(x0 + 1, (x + 1) * picture.width() / width);
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int v = y0; v < y1; ++v) {
          for (int u = x0; u < x1; ++u) sum += at(picture, u, v, c);
        }
        const int count = (y1 - y0) * (x1 - x0);
        const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(sheet.width()) +
                                  static_cast<std::size_t>(left + x);
        out[pixel * 3 + static_cast<std::size_t>(c)] = static_cast<std::uint8_t>((sum + count / 2) / count);
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int kHeight = 480;
  constexpr int kGap = 8;
  if (argc < 3) {
    std::fprintf(stderr, "usage: side_by_side OUT.png A.png B.png …\n");
    return 2;
  }
  std::vector<Image> pictures;
  std::vector<int> widths;
  int total = -kGap;
  for (int i = 2; i < argc; ++i) {
    laterna::Result<Image> picture = laterna::read_image(argv[i]);
    if (!picture) {
      std::fprintf(stderr, "side_by_side: %s\n", to_string(picture.error()).c_str());
      return 3;
    }
    if (picture->type() != laterna::PixelType::u8) {
      std::fprintf(stderr, "side_by_side: %s: expected 8 bits per channel\n", argv[i]);
      return 3;
    }
    widths.push_back(std::max(1, picture->width() * kHeight / picture->height()));
    total += widths.back() + kGap;
    pictures.push_back(std::move(*picture));
  }
  Image sheet(total, kHeight, 3, laterna::PixelType::u8, laterna::Transfer::srgb);
  std::ranges::fill(sheet.values<std::uint8_t>(), std::uint8_t{255});
  int left = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    paste(pictures[i], sheet, left, widths[i]);
    left += widths[i] + kGap;
  }
  const laterna::Result<void> written = write_image(sheet, argv[1]);
  if (!written) std::fprintf(stderr, "side_by_side: %s\n", to_string(written.error()).c_str());
  return written ? 0 : 4;
}
