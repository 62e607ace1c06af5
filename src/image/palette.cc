#include "image/palette.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <unordered_map>

namespace laterna::image {
namespace {

constexpr std::size_t kMostColours = 256;
constexpr unsigned kBinBits = 5;     // of each channel, where boxes are cut
constexpr unsigned kLookUpBits = 6;  // of each channel, where pixels find their colour
constexpr int kStrongestDither = 32;

std::optional<PalettePicture> keep_colours(std::span<const std::uint8_t> rgb) {
  PalettePicture picture;
  std::unordered_map<std::uint32_t, std::uint8_t> place_of;
  picture.pixels.reserve(rgb.size() / 3);
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    const std::uint32_t key =
        static_cast<std::uint32_t>(rgb[i]) << 16U | static_cast<std::uint32_t>(rgb[i + 1]) << 8U | rgb[i + 2];
    const auto found = place_of.find(key);
    if (found != place_of.end()) {
      picture.pixels.push_back(found->second);
      continue;
    }
    if (picture.colours.size() == kMostColours) return std::nullopt;
    const auto place = static_cast<std::uint8_t>(picture.colours.size());
    place_of.emplace(key, place);
    picture.colours.push_back({rgb[i], rgb[i + 1], rgb[i + 2]});
    picture.pixels.push_back(place);
  }
  return picture;
}

// Pixels of nearly one colour.
struct Bin {
  double count = 0;
  std::array<double, 3> sum{}, squares{};

  void add(const Bin& other) {
    count += other.count;
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += other.sum[c];
      squares[c] += other.squares[c];
    }
  }
  [[nodiscard]] double mean(std::size_t c) const { return sum[c] / count; }
  // Sum of squared distances from the mean. The sums are whole numbers below 2⁵³, and exact.
  [[nodiscard]] double error(std::size_t c) const { return squares[c] - sum[c] * sum[c] / count; }
};

std::vector<Bin> bins_of(std::span<const std::uint8_t> rgb) {
  std::vector<Bin> bins(std::size_t{1} << (3 * kBinBits));
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    std::size_t at = 0;
    for (std::size_t c = 0; c < 3; ++c) at = at << kBinBits | rgb[i + c] >> (8 - kBinBits);
    Bin& bin = bins[at];
    ++bin.count;
    for (std::size_t c = 0; c < 3; ++c) {
      bin.sum[c] += rgb[i + c];
      bin.squares[c] += static_cast<double>(rgb[i + c]) * rgb[i + c];
    }
  }
  std::erase_if(bins, [](const Bin& bin) { return bin.count == 0; });
  return bins;
}

struct Box {
  std::span<Bin> bins;
  Bin whole;
  std::size_t axis = 0;
  double error = 0;  // along that axis

  explicit Box(std::span<Bin> all) : bins(all) {
    for (const Bin& bin : bins) whole.add(bin);
    if (bins.size() < 2) return;
    for (std::size_t c = 0; c < 3; ++c) {
      if (whole.error(c) > error) error = whole.error(c), axis = c;
    }
  }
};

std::vector<Box> cut(std::vector<Bin>& bins) {
  std::vector<Box> boxes = {Box(bins)};
  while (boxes.size() < kMostColours) {
    const auto worst = std::max_element(boxes.begin(), boxes.end(),
                                        [](const Box& a, const Box& b) { return a.error < b.error; });
    if (!(worst->error > 0)) break;
    const std::span<Bin> all = worst->bins;
    const std::size_t axis = worst->axis;
    const double middle = worst->whole.mean(axis);
    const auto split = std::stable_partition(all.begin(), all.end(),
                                             [&](const Bin& bin) { return bin.mean(axis) <= middle; });
    const auto first = static_cast<std::size_t>(split - all.begin());
    // Bins of one mean, which nothing parts.
    if (first == 0 || first == all.size()) {
      worst->error = 0;
      continue;
    }
    *worst = Box(all.first(first));
    boxes.emplace_back(all.subspan(first));
  }
  return boxes;
}

// Threshold of a pixel, 0…63: each bit of x ^ y and y, from the lowest on, is a higher one of the result.
int bayer(int x, int y) {
  int threshold = 0;
  for (int bit = 0; bit < 3; ++bit) threshold = threshold << 2 | (((x ^ y) >> bit & 1) << 1) | (y >> bit & 1);
  return threshold;
}

class NearestColour {
 public:
  explicit NearestColour(const std::vector<Rgb>& colours)
      : colours_(colours), known_(std::size_t{1} << (3 * kLookUpBits), kUnknown) {}

  std::uint8_t operator()(const std::array<int, 3>& colour) {
    std::size_t at = 0;
    for (const int value : colour) at = at << kLookUpBits | static_cast<unsigned>(value) >> (8 - kLookUpBits);
    if (known_[at] == kUnknown) known_[at] = search(colour);
    return static_cast<std::uint8_t>(known_[at]);
  }

 private:
  static constexpr std::uint16_t kUnknown = 0xFFFF;

  // Of the middle of the cell, so that it does not matter which pixel asks first.
  [[nodiscard]] std::uint16_t search(const std::array<int, 3>& colour) const {
    constexpr int kCell = 1 << (8 - kLookUpBits);
    int least = 1 << 30;
    std::size_t best = 0;
    for (std::size_t i = 0; i < colours_.size(); ++i) {
      int distance = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const int difference = colour[c] / kCell * kCell + kCell / 2 - colours_[i][c];
        distance += difference * difference;
      }
      if (distance < least) least = distance, best = i;
    }
    return static_cast<std::uint16_t>(best);
  }

  const std::vector<Rgb>& colours_;
  std::vector<std::uint16_t> known_;
};

}  // namespace

PalettePicture reduce_colours(const Image& frame) {
  const std::span<const std::uint8_t> rgb = frame.values<std::uint8_t>();
  if (std::optional<PalettePicture> exact = keep_colours(rgb)) return std::move(*exact);
  std::vector<Bin> bins = bins_of(rgb);
  PalettePicture picture;
  double squares = 0;
  for (const Box& box : cut(bins)) {
    Rgb colour{};
    for (std::size_t c = 0; c < 3; ++c) {
      colour[c] = static_cast<std::uint8_t>(std::lround(box.whole.mean(c)));
      squares += box.whole.error(c);
    }
    picture.colours.push_back(colour);
  }
  // Evenly spread errors reach √3 times their root mean square to either side.
  const double pixels = static_cast<double>(rgb.size()) / 3;
  const auto strength =
      static_cast<int>(std::min<double>(kStrongestDither, 2 * std::sqrt(squares / pixels) + 0.5));
  NearestColour nearest(picture.colours);
  picture.pixels.reserve(rgb.size() / 3);
  std::size_t i = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x, i += 3) {
      const int offset = (2 * bayer(x, y) - 63) * strength / 128;
      std::array<int, 3> colour{};
      for (std::size_t c = 0; c < 3; ++c) colour[c] = std::clamp(rgb[i + c] + offset, 0, 255);
      picture.pixels.push_back(nearest(colour));
    }
  }
  return picture;
}

}  // namespace laterna::image
