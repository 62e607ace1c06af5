#include "scene/eulumdat_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scene/fault_list.h"
#include "scene/lamp_planes.h"
#include "scene/lamp_text.h"
#include "scene/spelling.h"

namespace laterna {
namespace {

constexpr double kMostCandela = 1e12, kMostFactor = 1e9;
constexpr double kMetresPerMillimetre = 0.001;
constexpr int kMostLampSets = 20, kLinesPerLampSet = 6, kDirectRatios = 10;

class EulumdatReader {
 public:
  EulumdatReader(std::string_view text, FaultList& faults) : lines_(split_lines(text)), faults_(faults) {
    while (!lines_.empty() && trimmed(lines_.back()).empty()) lines_.pop_back();
  }

  LightDistribution read() {
    lamp_.format = "EULUMDAT";
    read_header();
    if (!faults_.has_errors()) read_candela();
    return std::move(lamp_);
  }

 private:
  // Line `number`, counted from 1; reports when the file ends before it.
  std::string_view text(std::size_t number, std::string_view what) {
    if (number <= lines_.size()) return trimmed(lines_[number - 1]);
    if (!faults_.has_errors())
      faults_.error(fmt::format("line {}", std::max<std::size_t>(lines_.size(), 1)),
                    fmt::format("the file ends before {} (line {})", what, number));
    return {};
  }

  double number(std::size_t at, std::string_view what, double low, double high) {
    const std::string_view found = text(at, what);
    if (at > lines_.size()) return low;
    const std::optional<double> value = parse_number(found, true);
    if (value && *value >= low && *value <= high) return *value;
    faults_.error(fmt::format("line {}", at), fmt::format("expected {}, a number from {} to {}, got {}", what,
                                                          low, high, in_quotes(found.substr(0, 40))));
    return low;
  }

  std::size_t whole(std::size_t at, std::string_view what, std::size_t low, std::size_t high) {
    const double value = number(at, what, static_cast<double>(low), static_cast<double>(high));
    const auto rounded = static_cast<std::size_t>(value);
    if (static_cast<double>(rounded) != value)
      faults_.error(fmt::format("line {}", at),
                    fmt::format("expected {}, a whole number, got {}", what, value));
    return rounded;
  }

  // Millimetres that nothing here depends on: what is no number is 0.
  double length(std::size_t at) {
    return parse_number(text(at, "the luminaire's sizes"), true).value_or(0) * kMetresPerMillimetre;
  }

  void read_header() {
    const std::string_view company = text(1, "the company"), luminaire = text(9, "the luminaire's name");
    lamp_.luminaire =
        fmt::format("{}{}{}", company, company.empty() || luminaire.empty() ? "" : ", ", luminaire);
    symmetry_ = whole(3, "the symmetry Isym", 0, 4);
    planes_ = whole(4, "the number of C-planes Mc", 1, kMaxLampAngles);
    angles_ = whole(6, "the number of angles Ng in each plane", 2, kMaxLampAngles);
    lamp_.opening_m = {length(16), length(17), 0};
    const double factor = number(24, "the conversion factor of intensities", 1e-9, kMostFactor);
    const std::size_t sets = whole(26, "the number of sets of lamps", 1, kMostLampSets);
    if (faults_.has_errors()) return;
    // Sets are alternatives; the first is the one that is meant.
    const double lumens = number(29, "the luminous flux of the lamps", 1e-9, kMostCandela);
    const double lamps = number(27, "the number of lamps", -1e6, 1e6);
    if (lamps >= 0) lamp_.rated_lumens = lumens;  // a negative number marks absolute photometry
    lamp_.watts = parse_number(text(32, "the watts"), true).value_or(0);
    candela_per_value_ = factor * lumens / 1000;
    first_angle_line_ = 26 + kLinesPerLampSet * sets + kDirectRatios;
    check_symmetry();
  }

  // How many planes are listed, and where in the list of C angles they begin.
  void check_symmetry() {
    static constexpr std::array<std::size_t, 5> kDivisors = {1, 1, 2, 4, 4};
    const std::size_t divisor = kDivisors[symmetry_];
    if (planes_ % divisor != 0)
      faults_.error(
          "line 4",
          fmt::format("expected the number of C-planes to be a multiple of {} with symmetry {}, got {}",
                      divisor, symmetry_, planes_));
    if (planes_ * angles_ > kMaxLampValues)
      faults_.error("line 6", fmt::format("{} times {} intensities are more than {}", planes_, angles_,
                                          kMaxLampValues));
  }

  void read_candela() {
    NumberStream numbers(lines_, first_angle_line_, NumberStream::Comma::is_decimal_point, faults_);
    const auto planes_deg = numbers.next_angles("C-plane", planes_, 0, 360);
    if (!planes_deg) return;
    auto angles = numbers.next_angles("vertical", angles_, 0, 180);
    if (!angles) return;
    lamp_.vertical_deg = std::move(*angles);
    // Isym 0 to 4: all planes; one; C0 to C180; C270 over C0 to C90; C0 to C90.
    const std::array<std::size_t, 5> counts = {planes_, 1, planes_ / 2 + 1, planes_ / 2 + 1, planes_ / 4 + 1};
    const std::size_t count = counts[symmetry_], first = symmetry_ == 3 ? 3 * planes_ / 4 : 0;
    std::vector<double> listed_deg;
    std::vector<std::vector<double>> columns(count);
    for (std::size_t plane = 0; plane < count; ++plane) {
      listed_deg.push_back((*planes_deg)[(first + plane) % planes_]);
      for (std::size_t angle = 0; angle < angles_; ++angle) {
        const auto describe = [&] {
          return fmt::format("intensity {} of {} in plane {} of {}", angle + 1, angles_, plane + 1, count);
        };
        const std::optional<double> value = numbers.next(describe, 0, kMostCandela);
        if (!value) return;
        columns[plane].push_back(*value * candela_per_value_);
      }
    }
    if (!numbers.expect_end([&] { return fmt::format("{} x {} intensities", count, angles_); })) return;
    check_ends(listed_deg);
    static constexpr std::array<LampSymmetry, 5> kSymmetries = {
        LampSymmetry::none, LampSymmetry::full_turn, LampSymmetry::about_c0, LampSymmetry::about_c90,
        LampSymmetry::about_both};
    set_planes(lamp_, kSymmetries[symmetry_], listed_deg, columns);
  }

  // Mirrored planes must end where they are mirrored.
  void check_ends(const std::vector<double>& listed_deg) {
    static constexpr std::array<std::array<double, 2>, 5> kEnds = {
        {{0, 0}, {0, 0}, {0, 180}, {270, 90}, {0, 90}}};
    if (symmetry_ < 2) return;
    const auto [first, last] = kEnds[symmetry_];
    if (std::abs(listed_deg.front() - first) < 0.01 && std::abs(listed_deg.back() - last) < 0.01) return;
    faults_.error(fmt::format("line {}", first_angle_line_ + 1),
                  fmt::format("with symmetry {} the planes listed run from C{} to C{}; the angles of the "
                              "C-planes say C{} to C{}",
                              symmetry_, first, last, listed_deg.front(), listed_deg.back()));
  }

  std::vector<std::string_view> lines_;
  FaultList& faults_;
  LightDistribution lamp_;
  std::size_t symmetry_ = 0, planes_ = 0, angles_ = 0, first_angle_line_ = 0;
  double candela_per_value_ = 0;
};

}  // namespace

Result<LightDistribution> read_eulumdat(std::string_view text, const std::string& file) {
  FaultList faults(file);
  LightDistribution lamp = EulumdatReader(text, faults).read();
  if (faults.has_errors()) return tl::unexpected(Error(Failure::bad_input, faults.errors()));
  return lamp;
}

}  // namespace laterna
