#include "laterna/false_color.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/elementary.h"
#include "base/refuse.h"
#include "image/luminance.h"
#include "image/text_drawing.h"

namespace laterna {
namespace {

using Rgb = std::array<float, 3>;

// sRGB codes at equal steps of the scale.
struct Code {
  int r, g, b;
};
constexpr std::array<Code, 8> kRamp = {{{24, 16, 70},
                                        {44, 54, 170},
                                        {24, 130, 200},
                                        {24, 170, 130},
                                        {110, 195, 50},
                                        {225, 205, 45},
                                        {240, 130, 25},
                                        {205, 25, 30}}};
// Of a scale: its numbers are written in few digits.
constexpr double kLeastMaximum = 1e-12, kMostMaximum = 1e15;

constexpr Code kAbove = {255, 170, 205}, kNothing = {52, 52, 52};

Rgb linear(const Code& code) {
  const auto channel = [](int value) { return static_cast<float>(linear_from_srgb(value / 255.0)); };
  return {channel(code.r), channel(code.g), channel(code.b)};
}

Rgb color_at(double share) {
  if (share > 1) return linear(kAbove);
  const double place = std::max(share, 0.0) * (kRamp.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kRamp.size() - 2);
  const auto rest = static_cast<float>(place - static_cast<double>(below));
  const Rgb a = linear(kRamp[below]);
  const Rgb b = linear(kRamp[below + 1]);
  return {a[0] + rest * (b[0] - a[0]), a[1] + rest * (b[1] - a[1]), a[2] + rest * (b[2] - a[2])};
}

// The largest power of ten that is not above a value > 0.
double power_of_ten(double value) {
  double power = 1;
  while (power * 10 <= value) power *= 10;
  while (power > value) power /= 10;
  return power;
}

// The least round number that is not below a value > 0.
double round_up(double value) {
  const double ten = power_of_ten(value);
  for (const double step : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (step * ten >= value) return step * ten;
  }
  return 10 * ten;
}

// Between two numbers of the scale: 1, 2 or 5 times a power of ten, so that there are at most `most` steps.
double scale_step(double maximum, int most) {
  const double least = maximum / most;
  const double ten = power_of_ten(least);
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * ten >= least * (1 - 1e-9)) return step * ten;
  }
  return 10 * ten;
}

// What is shown: amounts by coverage; NaN where nothing is.
std::vector<double> covered_values(const LayeredImage& image, const Channel& channel) {
  const Channel* coverage = image.find("A");
  std::vector<double> values(channel.values.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(channel.values[i])) continue;
    const double share = coverage == nullptr ? 1.0 : coverage->values[i];
    if (share > 0) values[i] = channel.values[i] / share;
  }
  return values;
}

double find_maximum(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return 1;
  const auto nearly_all =
      values.begin() + static_cast<std::ptrdiff_t>(0.998 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nearly_all, values.end());
  return *nearly_all > 0
             ? std::clamp(round_up(std::max(*nearly_all, kLeastMaximum)), kLeastMaximum, kMostMaximum)
             : 1;
}

class FalseColorDrawing {
 public:
  FalseColorDrawing(const LayeredImage& image, std::vector<double> values, const FalseColorSettings& settings)
      : width_(image.width),
        height_(image.height),
        values_(std::move(values)),
        settings_(settings),
        maximum_(settings.maximum > 0 ? settings.maximum : find_maximum(values_)),
        // Letters of a picture for a screen are seen in one for print, too.
        scale_(std::max(1, image.height / 400)) {
    const int most_steps = std::clamp((height_ - 4 * line_height()) / line_height(), 1, 10);
    step_ = scale_step(maximum_, most_steps);
    for (int i = 0; i * step_ < maximum_ - 0.5 * step_; ++i) numbers_.push_back(i * step_);
    numbers_.push_back(maximum_);
    int widest = image::text_width(settings.unit, scale_);
    for (const double number : numbers_)
      widest = std::max(widest, image::text_width(fmt::format("{:g}", number), scale_));
    picture_.width = width_ + bar_left() + bar_width() + 3 * kMargin * scale_ + widest;
    picture_.height = height_;
    const std::size_t count = static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(height_);
    for (const char* name : {"R", "G", "B"}) picture_.channels.push_back({name, std::vector<float>(count)});
    picture_.metadata["laterna.scale_maximum"] = fmt::format("{}", maximum_);
  }

  LayeredImage draw() {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) set(x, y, color_of(x, y));
    }
    draw_scale();
    return std::move(picture_);
  }

 private:
  static constexpr int kMargin = 3;
  [[nodiscard]] int line_height() const { return (image::kGlyphHeight + 5) * scale_; }
  [[nodiscard]] int bar_left() const { return 2 * kMargin * scale_; }
  [[nodiscard]] int bar_width() const { return 14 * scale_; }

  [[nodiscard]] double value(int x, int y) const {
    return values_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }

  void set(int x, int y, const Rgb& color) {
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) + static_cast<std::size_t>(x);
    for (std::size_t c = 0; c < 3; ++c) picture_.channels[c].values[i] = color[c];
  }

  // How many numbers of the scale a value has passed.
  [[nodiscard]] int passed(double v) const {
    return static_cast<int>(std::upper_bound(numbers_.begin(), numbers_.end(), v) - numbers_.begin());
  }

  // Toward the right or downward neighbour.
  [[nodiscard]] bool is_on_iso_line(int x, int y) const {
    const double here = value(x, y);
    const auto parts = [&](int nx, int ny) {
      if (nx >= width_ || ny >= height_) return false;
      const double there = value(nx, ny);
      return std::isfinite(there) && passed(there) != passed(here);
    };
    return parts(x + 1, y) || parts(x, y + 1);
  }

  [[nodiscard]] Rgb color_of(int x, int y) const {
    const double v = value(x, y);
    if (!std::isfinite(v)) return linear(kNothing);
    const Rgb color = color_at(v / maximum_);
    if (!settings_.iso_lines || !is_on_iso_line(x, y)) return color;
    const bool is_dark = image::luminance(color[0], color[1], color[2]) < 0.12F;
    return is_dark ? Rgb{0.6F, 0.6F, 0.6F} : Rgb{0, 0, 0};
  }

  void draw_scale() {
    const Rgb paper = {1, 1, 1};
    const Rgb ink = {0, 0, 0};
    for (int y = 0; y < height_; ++y) {
      for (int x = width_; x < picture_.width; ++x) set(x, y, paper);
    }
    const int left = width_ + bar_left();
    const int top = 2 * line_height();
    const int bottom = std::max(height_ - line_height(), top + 1);
    const int text_left = left + bar_width() + 2 * kMargin * scale_;
    image::draw_text(picture_, left, kMargin * scale_, settings_.unit, ink, scale_);
    for (int y = std::max(0, top - line_height() / 2); y < std::min(bottom, height_); ++y) {
      // Above the scale's end, the colour of what is above.
      const double share =
          y < top ? 2.0 : static_cast<double>(bottom - 1 - y) / std::max(bottom - 1 - top, 1);
      for (int x = left; x < left + bar_width(); ++x) set(x, y, color_at(share));
    }
    for (const double number : numbers_) {
      const int y = bottom - 1 - static_cast<int>(std::lround(number / maximum_ * (bottom - 1 - top)));
      if (y < 0 || y >= height_) continue;
      for (int x = left; x < text_left - kMargin * scale_; ++x) set(x, y, ink);
      image::draw_text(picture_, text_left, y - image::kGlyphHeight * scale_ / 2, fmt::format("{:g}", number),
                       ink, scale_);
    }
  }

  int width_, height_;
  std::vector<double> values_;
  const FalseColorSettings& settings_;
  double maximum_;
  int scale_;
  double step_ = 1;
  std::vector<double> numbers_;  // of the scale, from 0
  LayeredImage picture_;
};

}  // namespace

Result<LayeredImage> false_color_picture(const LayeredImage& image, const std::string& channel,
                                         const FalseColorSettings& settings) {
  const Channel* found = image.find(channel);
  if (found == nullptr) {
    std::string names;
    for (const Channel& c : image.channels) names += (names.empty() ? "" : ", ") + c.name;
    return refuse(fmt::format("the picture has no channel \"{}\"; it has {}", channel, names));
  }
  if (found->values.empty()) return refuse("the picture has no pixels");
  const bool is_usable =
      settings.maximum == 0 || (settings.maximum >= kLeastMaximum && settings.maximum <= kMostMaximum);
  if (!is_usable) {
    return refuse(fmt::format("the scale's maximum must be a number from {:g} to {:g}, got {:g}",
                              kLeastMaximum, kMostMaximum, settings.maximum));
  }
  return FalseColorDrawing(image, covered_values(image, *found), settings).draw();
}

}  // namespace laterna
