#include "frame_range.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>

#include "laterna/film.h"
#include "numbered_name.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

constexpr std::int64_t kMostFrames = 1'000'000;

template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (wrong != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

struct Range {
  std::int64_t first, last;
};

Result<Range> parse_range(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string_view all = text;
  const auto first = parse<std::int64_t>(all.substr(0, colon));
  const auto last = colon == std::string::npos ? first : parse<std::int64_t>(all.substr(colon + 1));
  if (!first || !last || *first < 0 || *last < *first) {
    return tl::unexpected(bad_option(fmt::format(
        "--frames: expected FIRST:LAST, whole numbers from 0 on such as 0:23, got \"{}\"", text)));
  }
  if (*last - *first >= kMostFrames)
    return tl::unexpected(bad_option(fmt::format("--frames: at most {} pictures at a time", kMostFrames)));
  return Range{*first, *last};
}

/// Frames per second, numerator / denominator: rates of television are fractions, such as 30000/1001.
struct FrameRate {
  double numerator, denominator;
};

Result<FrameRate> parse_rate(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::string_view all = text;
  const auto numerator = parse<double>(all.substr(0, slash));
  const auto denominator = slash == std::string::npos ? 1.0 : parse<double>(all.substr(slash + 1));
  if (numerator && denominator && *numerator > 0 && *denominator > 0 &&
      *numerator / *denominator <= kMaxFramesPerSecond && std::isfinite(*denominator)) {
    return FrameRate{*numerator, *denominator};
  }
  return tl::unexpected(bad_option(fmt::format(
      "--fps: expected frames per second greater than 0, such as 25 or 30000/1001, got \"{}\"", text)));
}

}  // namespace

void FrameOptions::declare(CLI::App& command) {
  command
      .add_option(
          "--frames", frames,
          "FIRST:LAST, both included: a picture for each, where -o needs # in place of the number, as in\n"
          "out.####.png; or a frame of the film that -o names")
      ->excludes("--time");
  command.add_option("--fps", fps, "of --frames: frame k is at k/fps seconds; 30000/1001 is understood")
      ->needs("--frames")
      ->capture_default_str();
  command.add_option("--shutter", shutter,
                     "seconds for which the shutter is open, half of them before each picture's time and "
                     "half after, as 0.02\n"
                     "or 1/48: what moves is blurred; needs --accumulate, the number of instants");
}

Result<std::vector<TimedOutput>> FrameOptions::outputs(double time, const std::string& output) const {
  if (!is_series()) return std::vector<TimedOutput>{{time, output}};
  const Result<Range> range = parse_range(frames);
  if (!range) return tl::unexpected(range.error());
  const Result<FrameRate> rate = parse_rate(fps);
  if (!rate) return tl::unexpected(rate.error());
  std::optional<NumberedName> name;
  if (!is_video_output(output)) {
    Result<NumberedName> parsed = NumberedName::parse("--frames", output, true);
    if (!parsed) return tl::unexpected(parsed.error());
    name = std::move(*parsed);
  }
  std::vector<TimedOutput> outputs;
  for (std::int64_t k = range->first; k <= range->last; ++k) {
    const double seconds = static_cast<double>(k) * rate->denominator / rate->numerator;
    if (!(seconds <= kMaxSceneTime)) {
      return tl::unexpected(bad_option(fmt::format(
          "--frames: frame {} would be at {:g} s; scenes last at most {:g} s", k, seconds, kMaxSceneTime)));
    }
    outputs.push_back({seconds, name ? name->with(k) : output});
  }
  return outputs;
}

Result<double> FrameOptions::shutter_seconds() const {
  if (shutter.empty()) return 0.0;
  const std::size_t slash = shutter.find('/');
  const std::string_view all = shutter;
  const auto numerator = parse<double>(all.substr(0, slash));
  const auto denominator = slash == std::string::npos ? 1.0 : parse<double>(all.substr(slash + 1));
  if (numerator && denominator && *denominator > 0 && *numerator / *denominator > 0 &&
      *numerator / *denominator <= kMaxSceneTime) {
    return *numerator / *denominator;
  }
  return tl::unexpected(bad_option(
      fmt::format("--shutter: expected seconds greater than 0, such as 0.02 or 1/48, got \"{}\"", shutter)));
}

Result<VideoRate> FrameOptions::video_rate() const {
  const Result<FrameRate> rate = parse_rate(fps);
  if (!rate) return tl::unexpected(rate.error());
  // What was typed with up to six decimals is a ratio of whole numbers.
  for (double scale = 1; scale <= 1e6; scale *= 10) {
    const double numerator = rate->numerator * scale, denominator = rate->denominator * scale;
    constexpr double kMost = 2147483647;
    if (numerator > kMost || denominator > kMost) break;
    if (std::abs(numerator - std::round(numerator)) > 1e-9 * numerator ||
        std::abs(denominator - std::round(denominator)) > 1e-9 * denominator) {
      continue;
    }
    const auto n = static_cast<int>(std::lround(numerator)), d = static_cast<int>(std::lround(denominator));
    const int common = std::gcd(n, d);
    return VideoRate{n / common, d / common};
  }
  return tl::unexpected(bad_option(
      fmt::format("--fps: a film's rate is a ratio of whole numbers, such as 30000/1001, got \"{}\"", fps)));
}

}  // namespace laterna::app
