// Lamp files, written by tests.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "laterna/lamps.h"

namespace laterna::testing_lamps {

using Candela = std::function<double(double vertical_deg, double horizontal_deg)>;

/// From `first` to `last` in equal steps.
inline std::vector<double> angles(double first, double last, int count) {
  std::vector<double> all;
  all.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    all.push_back(count == 1 ? first : first + (last - first) * i / (count - 1));
  return all;
}

inline std::string numbers(const std::vector<double>& values, const char* between = " ") {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : between) + std::to_string(value);
  return text + "\n";
}

/// IES LM-63. The parts that a test does not care for are ordinary.
struct IesText {
  std::string first_line = "IESNA:LM-63-2002";
  std::string tilt = "TILT=NONE\n";
  std::string lamps_and_lumens = "1 -1", multiplier = "1";
  int type = 1;
  std::string unit_and_opening = "2 0.1 0.2 0.3", factors = "1 1 10";
  std::vector<double> vertical = angles(0, 90, 19), horizontal = {0};
  Candela candela = [](double, double) { return 100.0; };

  [[nodiscard]] std::string text() const {
    std::string all = first_line + "\n[TEST] none\n[MANUFAC] Nobody\n[LUMINAIRE] Lamp\n" + tilt +
                      lamps_and_lumens + " " + multiplier + " " + std::to_string(vertical.size()) + " " +
                      std::to_string(horizontal.size()) + " " + std::to_string(type) + " " +
                      unit_and_opening + "\n" + factors + "\n" + numbers(vertical) + numbers(horizontal);
    for (const double h : horizontal) {
      std::vector<double> column;
      column.reserve(vertical.size());
      for (const double v : vertical) column.push_back(candela(v, h));
      all += numbers(column);
    }
    return all;
  }
};

/// EULUMDAT with `planes` C-planes in all, of which the symmetry lists some.
struct LdtText {
  int symmetry = 0, planes = 24;
  std::vector<double> vertical = angles(0, 180, 37);
  std::string lamps = "1", lumens = "2000", factor = "1";
  const char* end_of_line = "\r\n";
  Candela value = [](double, double) { return 100.0; };

  [[nodiscard]] std::string text() const {
    std::vector<std::string> lines = {"Nobody",
                                      "3",
                                      std::to_string(symmetry),
                                      std::to_string(planes),
                                      std::to_string(360.0 / planes),
                                      std::to_string(vertical.size()),
                                      "5",
                                      "report",
                                      "Lamp",
                                      "1",
                                      "lamp.ldt",
                                      "today",
                                      "300",
                                      "200",
                                      "100",
                                      "250",
                                      "150",
                                      "0",
                                      "0",
                                      "0",
                                      "0",
                                      "100",
                                      "80",
                                      factor,
                                      "0",
                                      "1",
                                      lamps,
                                      "LED",
                                      lumens,
                                      "3000",
                                      "80",
                                      "15,5"};
    for (int i = 0; i < 10; ++i) lines.emplace_back("0");
    const std::vector<double> c = angles(0, 360, planes + 1);
    for (int i = 0; i < planes; ++i) lines.push_back(std::to_string(c[static_cast<std::size_t>(i)]));
    for (const double v : vertical) lines.push_back(std::to_string(v));
    const int first = symmetry == 3 ? 3 * planes / 4 : 0;
    const int counts[5] = {planes, 1, planes / 2 + 1, planes / 2 + 1, planes / 4 + 1};
    for (int i = 0; i < counts[symmetry]; ++i) {
      for (const double v : vertical)
        lines.push_back(std::to_string(value(v, c[static_cast<std::size_t>((first + i) % planes)])));
    }
    std::string all;
    for (const std::string& line : lines) all += line + end_of_line;
    return all;
  }
};

inline Result<LightDistribution> parse(std::string_view text, const std::string& name = "lamp.ies",
                                       const std::filesystem::path& folder = "/nonexistent") {
  return read_lamp(std::as_bytes(std::span(text)), name, folder);
}

inline LightDistribution parse_or_fail(std::string_view text, const std::string& name = "lamp.ies",
                                       const std::filesystem::path& folder = "/nonexistent") {
  Result<LightDistribution> lamp = parse(text, name, folder);
  if (lamp) return std::move(*lamp);
  ADD_FAILURE() << to_string(lamp.error());
  return {};
}

}  // namespace laterna::testing_lamps
