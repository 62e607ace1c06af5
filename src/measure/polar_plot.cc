#include "laterna/polar_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/elementary.h"
#include "base/output_file.h"
#include "base/refuse.h"

namespace laterna {
namespace {

constexpr double kWidth = 640, kHeight = 720, kRadius = 270;
constexpr double kMiddleX = kWidth / 2, kMiddleY = 370;
constexpr int kSpokeStep = 30, kStepsPerDegree = 2;
constexpr const char* kColors[2] = {"#b3261e", "#1a56a8"};

std::string escaped(std::string_view text) {
  std::string xml;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '&') {
      xml += "&amp;";
    } else if (c == '<') {
      xml += "&lt;";
    } else {
      // Lamp files are of any old encoding: what is no ASCII would not be UTF-8.
      xml += code < 0x20 || code > 0x7E ? '?' : c;
    }
  }
  return xml;
}

// The least of 1, 2, 5, 10, … at which at most five rings reach `most`.
double ring_step(double most) {
  double step = 1e-6;
  for (int i = 0; step * 5 < most; ++i) step *= i % 3 == 1 ? 2.5 : 2;
  return step;
}

// 0° is downward, C0 and C90 are to the right.
std::string point(double angle_deg, double radius) {
  const double angle = angle_deg * kPi / 180;
  return fmt::format("{:.2f},{:.2f}", kMiddleX + radius * sine(angle), kMiddleY + radius * cosine(angle));
}

std::string grid(double step, double outermost) {
  std::string svg = "<g fill=\"none\" stroke=\"#c8c8c8\">\n";
  std::string labels = "<g fill=\"#555\" font-size=\"12\">\n";
  for (int ring = 1; ring * step <= outermost * 1.0001; ++ring) {
    const double radius = kRadius * ring * step / outermost;
    svg += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{:.2f}\"/>\n", kMiddleX, kMiddleY, radius);
    labels += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{:.6g} cd</text>\n", kMiddleX + 4,
                          kMiddleY + radius - 3, ring * step);
  }
  labels += "<g text-anchor=\"middle\">\n";
  for (int angle = -180 + kSpokeStep; angle <= 180; angle += kSpokeStep) {
    svg += fmt::format("<path d=\"M{},{} L{}\"/>\n", kMiddleX, kMiddleY, point(angle, kRadius));
    const double radians = angle * kPi / 180;
    labels +=
        fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\">{}°</text>\n", kMiddleX + (kRadius + 18) * sine(radians),
                    kMiddleY + (kRadius + 18) * cosine(radians) + 4, std::abs(angle));
  }
  return svg + "</g>\n" + labels + "</g>\n</g>\n";
}

std::string curve(const LightDistribution& lamp, int section, double outermost) {
  std::string path;
  for (int i = -180 * kStepsPerDegree; i <= 180 * kStepsPerDegree; ++i) {
    const double angle = static_cast<double>(i) / kStepsPerDegree;
    const double candela =
        candela_toward(lamp, lamp_direction(PhotometricType::type_c, angle, 90.0 * section));
    path += (path.empty() ? "M" : " L") + point(angle, kRadius * candela / outermost);
  }
  return fmt::format("<path d=\"{} Z\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{}/>\n", path,
                     kColors[section], section == 1 ? " stroke-dasharray=\"7 4\"" : "");
}

std::string legend(const LightDistribution& lamp, const LampSummary& summary) {
  std::string svg = fmt::format("<text x=\"20\" y=\"28\" font-size=\"16\">{}</text>\n",
                                escaped(std::string_view(lamp.luminaire).substr(0, 70)));
  svg += fmt::format("<text x=\"20\" y=\"50\" font-size=\"13\">{:.5g} lm, peak {:.5g} cd</text>\n",
                     summary.flux_lm, summary.peak_cd);
  constexpr const char* kNames[2] = {"C0–C180", "C90–C270"};
  for (const int section : {0, 1}) {
    const double y = kHeight - 36 + 20 * section;
    svg += fmt::format("<path d=\"M20,{:.0f} h40\" stroke=\"{}\" stroke-width=\"2\"{}/>\n", y - 4,
                       kColors[section], section == 1 ? " stroke-dasharray=\"7 4\"" : "");
    const std::optional<double>& beam = summary.sections[static_cast<std::size_t>(section)].beam_angle_deg;
    svg += fmt::format("<text x=\"70\" y=\"{:.0f}\" font-size=\"13\">{}{}</text>\n", y, kNames[section],
                       beam ? fmt::format(", beam angle {:.1f}°", *beam) : "");
  }
  return svg;
}

}  // namespace

std::string polar_plot_svg(const LightDistribution& distribution) {
  const LampSummary summary = summarise(distribution);
  const double most = std::max({summary.sections[0].peak_cd, summary.sections[1].peak_cd, 1e-6});
  const double step = ring_step(most);
  const double outermost = step * std::ceil(most / step);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
             "font-family=\"sans-serif\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
             kWidth, kHeight) +
         grid(step, outermost) + curve(distribution, 0, outermost) + curve(distribution, 1, outermost) +
         legend(distribution, summary) + "</svg>\n";
}

Result<void> write_polar_plot(const LightDistribution& distribution, const std::filesystem::path& file) {
  if (file.extension() != ".svg")
    return refuse("polar diagram " + file.string() + ": expected a name that ends in .svg");
  const std::string svg = polar_plot_svg(distribution);
  return write_file(file, std::as_bytes(std::span(svg)));
}

}  // namespace laterna
