#include <algorithm>
#include <array>

#include "base/refuse.h"
#include "laterna/accuracy.h"

namespace laterna {
namespace {

constexpr int kLargestSide = 8192;

using Rgb = std::array<float, 3>;

// What is wrong stands out from what is not counted, and this from what is right, also where pictures are made smaller.
int weight_of(ShadowVerdict verdict) {
  switch (verdict) {
    case ShadowVerdict::not_counted:
    case ShadowVerdict::lit:
    case ShadowVerdict::dark:
      return 0;
    case ShadowVerdict::false_lit:
      return 1;
    case ShadowVerdict::false_dark:
      return 2;
    case ShadowVerdict::acne:
      return 3;
  }
  return 0;
}

Rgb color_of(ShadowVerdict verdict, float grey) {
  const auto shade = [&](float at_least, float more) {
    const float value = at_least + more * grey;
    return Rgb{value, value, value};
  };
  switch (verdict) {
    case ShadowVerdict::not_counted:
      return shade(0.004F, 0.03F);
    case ShadowVerdict::lit:
      return shade(0.2F, 0.4F);
    case ShadowVerdict::dark:
      return shade(0.04F, 0.1F);
    case ShadowVerdict::false_lit:
      return {1, 0.7F, 0};
    case ShadowVerdict::false_dark:
      return {0.02F, 0.15F, 1};
    case ShadowVerdict::acne:
      return {1, 0, 0.02F};
  }
  return {};
}

// One picture of the sheet.
class Sheet {
 public:
  Sheet(const AccuracyReport& report, int columns, int rows)
      : report_(report), scale_(scale_for(report, columns, rows)) {
    width_ = std::max(report.width / scale_, 1);
    height_ = std::max(report.height / scale_, 1);
    image_.width = width_ * columns;
    image_.height = height_ * rows;
    const auto count = static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height);
    for (const char* name : {"R", "G", "B"}) image_.channels.push_back({name, std::vector<float>(count)});
  }

  void put(const ShadowAccuracy& measured, int column, int row) {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const Rgb color = color_at(measured, x, y);
        const auto i = static_cast<std::size_t>(row * height_ + y) * static_cast<std::size_t>(image_.width) +
                       static_cast<std::size_t>(column * width_ + x);
        for (std::size_t channel = 0; channel < 3; ++channel)
          image_.channels[channel].values[i] = color[channel];
      }
    }
  }

  LayeredImage take() { return std::move(image_); }

 private:
  static int scale_for(const AccuracyReport& report, int columns, int rows) {
    const int side = std::max(report.width * columns, report.height * rows);
    return (side + kLargestSide - 1) / kLargestSide;
  }

  // The worst of the pixels that become one.
  [[nodiscard]] Rgb color_at(const ShadowAccuracy& measured, int x, int y) const {
    std::size_t worst = 0;
    int weight = -1;
    for (int j = 0; j < scale_; ++j) {
      for (int i = 0; i < scale_; ++i) {
        const auto at = static_cast<std::size_t>(std::min(y * scale_ + j, report_.height - 1)) *
                            static_cast<std::size_t>(report_.width) +
                        static_cast<std::size_t>(std::min(x * scale_ + i, report_.width - 1));
        if (weight_of(measured.verdicts[at]) <= weight) continue;
        worst = at;
        weight = weight_of(measured.verdicts[at]);
      }
    }
    return color_of(measured.verdicts[worst], report_.grey[worst]);
  }

  const AccuracyReport& report_;
  int scale_, width_ = 0, height_ = 0;
  LayeredImage image_;
};

// Where it stands in the list, which it joins if it is new.
template <class Value>
int place_of(const Value& value, std::vector<Value>& list) {
  const auto found = std::find(list.begin(), list.end(), value);
  if (found != list.end()) return static_cast<int>(found - list.begin());
  list.push_back(value);
  return static_cast<int>(list.size()) - 1;
}

}  // namespace

Result<LayeredImage> accuracy_picture(const AccuracyReport& report) {
  const auto pixels = static_cast<std::size_t>(report.width) * static_cast<std::size_t>(report.height);
  std::vector<std::string> lights;
  std::vector<ShadowTechnique> techniques;
  for (const ShadowAccuracy& measured : report.measured) {
    if (measured.verdicts.size() != pixels || report.grey.size() != pixels)
      return refuse("the report has no verdicts to make a picture of");
    place_of(measured.light, lights);
    place_of(measured.technique, techniques);
  }
  if (report.measured.empty()) return refuse("the report has no measurements to make a picture of");
  Sheet sheet(report, static_cast<int>(techniques.size()), static_cast<int>(lights.size()));
  for (const ShadowAccuracy& measured : report.measured)
    sheet.put(measured, place_of(measured.technique, techniques), place_of(measured.light, lights));
  return sheet.take();
}

}  // namespace laterna
