// How two pictures differ. The numbers and the verdict are idiff's (OpenImageIO).
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/elementary.h"
#include "image/layers.h"

namespace laterna::image {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDecibelsPerDoubling = 6.02059991327962390427;  // 20 · log10(2)

tl::unexpected<Error> incomparable(std::string message) {
  return tl::unexpected(Error(Failure::bad_input, Diagnostic{{}, {}, std::move(message)}));
}

using ChannelPair = std::pair<const Channel*, const Channel*>;

Result<void> check_sizes(const LayeredImage& a, const LayeredImage& b) {
  for (const LayeredImage* image : {&a, &b}) {
    if (std::string fault = find_picture_fault(*image); !fault.empty()) return incomparable(std::move(fault));
  }
  if (a.width == b.width && a.height == b.height) return {};
  return incomparable("the pictures differ in size: " + std::to_string(a.width) + " x " +
                      std::to_string(a.height) + " and " + std::to_string(b.width) + " x " +
                      std::to_string(b.height));
}

Result<std::vector<ChannelPair>> pair_channels(const LayeredImage& a, const LayeredImage& b) {
  std::vector<ChannelPair> pairs;
  pairs.reserve(a.channels.size());
  for (const Channel& channel : a.channels) pairs.emplace_back(&channel, b.find(channel.name));
  const bool all_found =
      std::all_of(pairs.begin(), pairs.end(), [](const ChannelPair& p) { return p.second != nullptr; });
  if (pairs.empty() || !all_found || a.channels.size() != b.channels.size()) {
    return incomparable("the pictures differ in their channels: " + channel_names(a) + " and " +
                        channel_names(b));
  }
  return pairs;
}

// Equal infinities do not differ, as the depth of the background; nor do two NaN. One NaN differs from
// everything.
double difference(float a, float b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double size = std::abs(static_cast<double>(a) - static_cast<double>(b));
  return std::isnan(size) ? kInfinity : size;
}

double signal_to_noise_db(double largest_value, double rms_error) {
  if (rms_error == 0) return kInfinity;
  if (rms_error == kInfinity) return -kInfinity;
  return kDecibelsPerDoubling * logarithm2(largest_value / rms_error);
}

void note_maximum(Difference& found, double error, std::size_t pixel, int width, const ChannelPair& pair) {
  if (error <= found.max_error) return;
  found.max_error = error;
  found.max_x = static_cast<int>(pixel % static_cast<std::size_t>(width));
  found.max_y = static_cast<int>(pixel / static_cast<std::size_t>(width));
  found.max_channel = pair.first->name;
  found.max_value_a = pair.first->values[pixel];
  found.max_value_b = pair.second->values[pixel];
}

Difference measure(const std::vector<ChannelPair>& pairs, int width, int height,
                   const DifferenceLimits& limits) {
  Difference found;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  double sum = 0, sum_of_squares = 0, largest_value = 1;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    double largest_error = 0;
    for (const ChannelPair& pair : pairs) {
      const float a = pair.first->values[pixel], b = pair.second->values[pixel];
      const double error = difference(a, b);
      sum += error;
      sum_of_squares += error * error;
      if (std::isfinite(a)) largest_value = std::max(largest_value, static_cast<double>(a));
      if (std::isfinite(b)) largest_value = std::max(largest_value, static_cast<double>(b));
      largest_error = std::max(largest_error, error);
      note_maximum(found, error, pixel, width, pair);
    }
    found.pixels_over_warn += largest_error > limits.warn ? 1 : 0;
    found.pixels_over_fail += largest_error > limits.fail ? 1 : 0;
  }
  const double values = static_cast<double>(pixels) * static_cast<double>(pairs.size());
  found.pixels = static_cast<std::int64_t>(pixels);
  found.mean_error = sum / values;
  found.rms_error = std::sqrt(sum_of_squares / values);
  found.psnr_db = signal_to_noise_db(largest_value, found.rms_error);
  return found;
}

Verdict judge(const Difference& found, const DifferenceLimits& limits) {
  const auto pixels = static_cast<double>(found.pixels);
  const auto is_beyond = [&](std::int64_t count, double percent, double hard_limit) {
    return static_cast<double>(count) > percent / 100 * pixels || found.max_error > hard_limit;
  };
  if (is_beyond(found.pixels_over_fail, limits.fail_percent, limits.hard_fail)) return Verdict::failure;
  if (is_beyond(found.pixels_over_warn, limits.warn_percent, limits.hard_warn)) return Verdict::warning;
  return Verdict::pass;
}

}  // namespace

}  // namespace laterna::image

namespace laterna {

Result<Comparison> compare_images(const LayeredImage& a, const LayeredImage& b,
                                  const DifferenceLimits& limits) {
  if (auto sizes = image::check_sizes(a, b); !sizes) return tl::unexpected(sizes.error());
  const Result<std::vector<image::ChannelPair>> pairs = image::pair_channels(a, b);
  if (!pairs) return tl::unexpected(pairs.error());
  Comparison comparison;
  comparison.difference = image::measure(*pairs, a.width, a.height, limits);
  comparison.verdict = image::judge(comparison.difference, limits);
  return comparison;
}

Result<LayeredImage> difference_picture(const LayeredImage& a, const LayeredImage& b, float scale) {
  if (auto sizes = image::check_sizes(a, b); !sizes) return tl::unexpected(sizes.error());
  LayeredImage picture{a.width, a.height, {}, {}};
  const bool has_colour =
      image::find_colour_channels(a).count == 3 && image::find_colour_channels(b).count == 3;
  for (const Channel& channel : a.channels) {
    const Channel* const other = b.find(channel.name);
    const bool is_wanted = has_colour ? channel.name == "R" || channel.name == "G" || channel.name == "B"
                                      : picture.channels.empty();
    if (other == nullptr || !is_wanted) continue;
    Channel made{has_colour ? channel.name : "Y", std::vector<float>(channel.values.size())};
    for (std::size_t i = 0; i < made.values.size(); ++i) {
      made.values[i] = static_cast<float>(image::difference(channel.values[i], other->values[i])) * scale;
    }
    picture.channels.push_back(std::move(made));
  }
  if (picture.channels.empty()) return image::incomparable("the pictures have no channel in common");
  return picture;
}

}  // namespace laterna
