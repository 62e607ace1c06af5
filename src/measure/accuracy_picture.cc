#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/refuse.h"
#include "image/text_drawing.h"
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

template <class Value>
void join(const Value& value, std::vector<Value>& list) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

std::string_view name_of(ShadowTechnique technique) {
  for (const TechniqueDescription& known : list_techniques()) {
    if (known.technique == technique) return known.name;
  }
  return {};
}

// As much about it as fits above its picture.
std::string caption_of(const ShadowAccuracy& measured, int width, int scale) {
  const std::string_view name = name_of(measured.technique);
  if (measured.pixels == 0) return image::fitted_text(fmt::format("{}: nothing is lit", name), width, scale);
  std::string whole = fmt::format("{}: false lit {:.3g} %, false dark {:.3g} %, acne {:.3g} %", name,
                                  100 * measured.false_lit, 100 * measured.false_dark, 100 * measured.acne);
  if (image::text_width(whole, scale) <= width) return whole;
  std::string brief =
      fmt::format("{}: {:.3g} % wrong", name, 100 * (measured.false_lit + measured.false_dark));
  if (image::text_width(brief, scale) <= width) return brief;
  return image::fitted_text(name, width, scale);
}

constexpr int kMostColumns = 5;
constexpr int kLettersPerPicture = 24;  // "silhouette: 0.12 % wrong"
constexpr Rgb kHeadingInk = {1, 1, 1};
constexpr Rgb kCaptionInk = {0.6F, 0.6F, 0.6F};

// Where everything is: a block for each light, its name above, its pictures in rows, each under a caption; a legend below.
struct Layout {
  std::vector<std::string> lights;
  std::vector<ShadowTechnique> techniques;
  int columns = 1, rows = 1;     // of each block
  int shrink = 1;                // a pixel stands for so many squared
  int width = 0, height = 0;     // of a picture
  int text_scale = 1, line = 0;  // of text, and pixels that a line of it takes
  int gap = 0;                   // between columns

  explicit Layout(const AccuracyReport& report) {
    for (const ShadowAccuracy& measured : report.measured) {
      join(measured.light, lights);
      join(measured.technique, techniques);
    }
    const auto count = static_cast<int>(techniques.size());
    rows = (count + kMostColumns - 1) / kMostColumns;
    columns = (count + rows - 1) / rows;
    const int side = std::max(report.width * columns, report.height * rows * static_cast<int>(lights.size()));
    shrink = (side + kLargestSide - 1) / kLargestSide;
    width = std::max(report.width / shrink, 1);
    height = std::max(report.height / shrink, 1);
    // A sheet is looked at as a whole: letters are a hundredth of its width, but leave room for a few words over a picture.
    const int of_sheet = columns * width / (100 * image::kGlyphAdvance);
    const int of_picture = width / (kLettersPerPicture * image::kGlyphAdvance);
    text_scale = std::max(1, std::min(of_sheet, of_picture));
    line = (image::kGlyphHeight + 4) * text_scale;
    gap = 4 * text_scale;
  }

  [[nodiscard]] int sheet_width() const { return columns * (width + gap) - gap; }
  [[nodiscard]] int block_height() const { return 2 * line + rows * (line + height); }
  [[nodiscard]] int sheet_height() const {
    return static_cast<int>(lights.size()) * block_height() + 2 * line;
  }
  [[nodiscard]] int top_of(const std::string& light) const {
    const auto place = std::find(lights.begin(), lights.end(), light) - lights.begin();
    return static_cast<int>(place) * block_height();
  }
  [[nodiscard]] int place_of(ShadowTechnique technique) const {
    return static_cast<int>(std::find(techniques.begin(), techniques.end(), technique) - techniques.begin());
  }
};

class Sheet {
 public:
  explicit Sheet(const AccuracyReport& report) : report_(report), layout_(report) {
    image_.width = layout_.sheet_width();
    image_.height = layout_.sheet_height();
    const auto count = static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height);
    for (const char* name : {"R", "G", "B"}) image_.channels.push_back({name, std::vector<float>(count)});
    for (const std::string& light : layout_.lights)
      write(0, layout_.top_of(light) + layout_.line / 2, "light: " + light, image_.width, kHeadingInk);
    write_legend();
  }

  void put(const ShadowAccuracy& measured) {
    const int place = layout_.place_of(measured.technique);
    const int left = place % layout_.columns * (layout_.width + layout_.gap);
    const int top = layout_.top_of(measured.light) + 2 * layout_.line +
                    place / layout_.columns * (layout_.line + layout_.height);
    write(left, top, caption_of(measured, layout_.width, layout_.text_scale), layout_.width, kCaptionInk);
    for (int y = 0; y < layout_.height; ++y) {
      for (int x = 0; x < layout_.width; ++x) set(left + x, top + layout_.line + y, color_at(measured, x, y));
    }
  }

  LayeredImage take() { return std::move(image_); }

 private:
  void set(int x, int y, const Rgb& color) {
    const auto i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x);
    for (std::size_t channel = 0; channel < 3; ++channel) image_.channels[channel].values[i] = color[channel];
  }

  void write(int left, int top, const std::string& text, int width, const Rgb& ink) {
    const int scale = layout_.text_scale;
    image::draw_text(image_, left, top + 2 * scale, image::fitted_text(text, width, scale), ink, scale);
  }

  // What each colour means, a square of it before each word.
  void write_legend() {
    constexpr std::pair<ShadowVerdict, const char*> kEntries[] = {
        {ShadowVerdict::false_lit, "false light"},
        {ShadowVerdict::false_dark, "false shadow"},
        {ShadowVerdict::acne, "acne"},
        {ShadowVerdict::lit, "lit"},
        {ShadowVerdict::dark, "in shadow"},
        {ShadowVerdict::not_counted, "not counted"}};
    const int scale = layout_.text_scale;
    const int side = image::kGlyphHeight * scale;
    const int top = image_.height - layout_.line - layout_.line / 2;
    int left = 0;
    for (const auto& [verdict, text] : kEntries) {
      const int right = left + side + 4 * scale + image::text_width(text, scale);
      if (right > image_.width) return;
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) set(left + x, top + 2 * scale + y, color_of(verdict, 1));
      }
      write(left + side + 4 * scale, top, text, image_.width, kCaptionInk);
      left = right + 12 * scale;
    }
  }

  // The worst of the pixels that become one.
  [[nodiscard]] Rgb color_at(const ShadowAccuracy& measured, int x, int y) const {
    std::size_t worst = 0;
    int weight = -1;
    for (int j = 0; j < layout_.shrink; ++j) {
      for (int i = 0; i < layout_.shrink; ++i) {
        const auto at = static_cast<std::size_t>(std::min(y * layout_.shrink + j, report_.height - 1)) *
                            static_cast<std::size_t>(report_.width) +
                        static_cast<std::size_t>(std::min(x * layout_.shrink + i, report_.width - 1));
        if (weight_of(measured.verdicts[at]) <= weight) continue;
        worst = at;
        weight = weight_of(measured.verdicts[at]);
      }
    }
    return color_of(measured.verdicts[worst], report_.grey[worst]);
  }

  const AccuracyReport& report_;
  Layout layout_;
  LayeredImage image_;
};

}  // namespace

Result<LayeredImage> accuracy_picture(const AccuracyReport& report) {
  const auto pixels = static_cast<std::size_t>(report.width) * static_cast<std::size_t>(report.height);
  for (const ShadowAccuracy& measured : report.measured) {
    if (measured.verdicts.size() != pixels || report.grey.size() != pixels)
      return refuse("the report has no verdicts to make a picture of");
  }
  if (report.measured.empty()) return refuse("the report has no measurements to make a picture of");
  Sheet sheet(report);
  for (const ShadowAccuracy& measured : report.measured) sheet.put(measured);
  return sheet.take();
}

}  // namespace laterna
