#include "lamps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace laterna::examples {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

double bell(double x, double width) { return std::exp(-x * x / (width * width)); }

std::string formatted(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::vector<double> range(double first, double last, double step) {
  std::vector<double> values;
  for (double value = first; value <= last; value += step) values.push_back(value);
  return values;
}

struct Lamp {
  const char* name;
  std::vector<double> vertical, horizontal;
  std::function<double(double vertical, double horizontal)> candela;
};

std::string row(const char* format, const std::vector<double>& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text += formatted(format, values[i]) + (i + 1 == values.size() || i % 10 == 9 ? "\n" : " ");
  return text;
}

Result<void> write(const Lamp& lamp, const std::filesystem::path& file) {
  std::string text = std::string("IESNA:LM-63-2002\n[TEST] a formula\n[MANUFAC] Laterna\n[LUMINAIRE] ") +
                     lamp.name + "\nTILT=NONE\n1 -1 1 " + std::to_string(lamp.vertical.size()) + " " +
                     std::to_string(lamp.horizontal.size()) + " 1 2 0 0 0\n1 1 12\n";
  text += row("%g", lamp.vertical) + row("%g", lamp.horizontal);
  for (const double h : lamp.horizontal) {
    std::vector<double> column;
    for (const double v : lamp.vertical) column.push_back(lamp.candela(v, h));
    text += row("%.1f", column);
  }
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (stream) return {};
  return tl::unexpected(
      Error(Failure::cannot_write, Diagnostic{file.string(), {}, "cannot write this file"}));
}

}  // namespace

Result<void> write_downlight(const std::filesystem::path& file) {
  const auto candela = [](double v, double) {
    return 520 * bell(v, 14) + 130 * bell(v - 33, 4) + 170 / (1 + std::exp((v - 41) / 1.4)) +
           6 * std::max(0.0, std::cos(v * kDegree));
  };
  return write({"downlight", range(0, 90, 2.5), {0}, candela}, file);
}

Result<void> write_wall_washer(const std::filesystem::path& file) {
  // 38° from straight down, toward the wall.
  constexpr double kAim = 38 * kDegree;
  const auto candela = [](double v, double h) {
    const double toward_aim = std::sin(v * kDegree) * std::sin(h * kDegree) * std::sin(kAim) +
                              std::cos(v * kDegree) * std::cos(kAim);
    const double from_aim = std::acos(std::clamp(toward_aim, -1.0, 1.0)) / kDegree;
    return (60 + 900 * bell(from_aim, 24)) * std::max(0.0, std::cos(v * kDegree));
  };
  return write({"wall washer", range(0, 90, 5), range(90, 270, 15), candela}, file);
}

}  // namespace laterna::examples
