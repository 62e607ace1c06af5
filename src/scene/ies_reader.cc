#include "scene/ies_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/file_io.h"
#include "scene/fault_list.h"
#include "scene/lamp_planes.h"
#include "scene/lamp_text.h"
#include "scene/spelling.h"
#include "scene/uri.h"

namespace laterna {
namespace {

constexpr std::string_view kTilt = "TILT=";
constexpr double kMetresPerFoot = 0.3048;
constexpr double kMostCandela = 1e12, kMostFactor = 1e9;
constexpr std::size_t kMostTiltAngles = 1000;

bool is_tilt_line(std::string_view line) { return trimmed(line).substr(0, kTilt.size()) == kTilt; }

class IesReader {
 public:
  IesReader(std::string_view text, const std::filesystem::path& folder, FaultList& faults)
      : lines_(split_lines(text)), folder_(folder), faults_(faults) {}

  LightDistribution read() {
    const std::size_t tilt_line = read_header();
    if (faults_.has_errors()) return {};
    NumberStream numbers(lines_, tilt_line + 1, NumberStream::Comma::separates, faults_);
    read_tilt(tilt_line, numbers);
    if (!faults_.has_errors()) read_lamp(numbers);
    return std::move(lamp_);
  }

 private:
  // Lines of free text (1986) or keywords, up to the line of TILT. Returns that line's index.
  std::size_t read_header() {
    const auto tilt = std::find_if(lines_.begin(), lines_.end(), is_tilt_line);
    const std::string_view first = lines_.empty() ? std::string_view() : trimmed(lines_.front());
    const bool has_version = first.substr(0, 3) == "IES";
    if (tilt == lines_.end()) {
      faults_.error(
          fmt::format("line {}", std::max<std::size_t>(lines_.size(), 1)),
          has_version ? "the file ends before a line that begins with TILT="
                      : "no lamp file: expected IES LM-63, with a line that begins with TILT=, or EULUMDAT");
      return 0;
    }
    // The first edition has no line that names it.
    lamp_.format = has_version ? std::string(first) : "LM-63-1986";
    for (auto line = lines_.begin(); line != tilt; ++line) {
      for (const std::string_view keyword : {"[MANUFAC]", "[LUMINAIRE]", "[LUMCAT]"}) {
        const std::string_view text = trimmed(*line);
        if (text.substr(0, keyword.size()) == keyword) add_to_name(trimmed(text.substr(keyword.size())));
      }
    }
    return static_cast<std::size_t>(tilt - lines_.begin());
  }

  void add_to_name(std::string_view part) {
    while (!part.empty() && (part.back() == ',' || part.back() == ' ')) part.remove_suffix(1);
    if (part.empty() || lamp_.luminaire.find(part) != std::string::npos) return;
    if (!lamp_.luminaire.empty()) lamp_.luminaire += ", ";
    lamp_.luminaire += part;
  }

  void read_tilt(std::size_t line, NumberStream& numbers) {
    const std::string_view what = trimmed(trimmed(lines_[line]).substr(kTilt.size()));
    if (what == "NONE") return;
    if (what == "INCLUDE") return read_tilt_numbers(numbers);
    const std::string place = fmt::format("line {}", line + 1);
    const auto path = resolve_file(folder_, what);
    if (!path)
      return faults_.error(place,
                           fmt::format("expected TILT=NONE, TILT=INCLUDE or a file; {}", path.error()));
    const Result<std::vector<std::byte>> bytes = read_file(*path);
    if (!bytes) return faults_.error(place, to_string(bytes.error()));
    FaultList faults(path->string());
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    const std::vector<std::string_view> lines = split_lines(text);
    NumberStream tilt_numbers(lines, 0, NumberStream::Comma::separates, faults);
    read_tilt_numbers(tilt_numbers);
    tilt_numbers.expect_end([] { return std::string("the multiplying factors"); });
    for (const Diagnostic& fault : faults.errors()) faults_.error(place, to_string(fault));
  }

  void read_tilt_numbers(NumberStream& numbers) {
    (void)numbers.next_count("the lamp-to-luminaire geometry", 1, 3);
    const std::optional<std::size_t> count =
        numbers.next_count("the number of tilt angles", 1, kMostTiltAngles);
    if (!count) return;
    const auto angles = numbers.next_angles("tilt", *count, 0, 360);
    if (!angles) return;
    for (std::size_t i = 0; i < *count; ++i) {
      const auto factor = numbers.next(
          [&] { return fmt::format("multiplying factor {} of {}", i + 1, *count); }, 0, kMostFactor);
      if (!factor) return;
      lamp_.tilt.push_back({(*angles)[i], *factor});
    }
  }

  void read_lamp(NumberStream& numbers) {
    const auto number = [&](const char* what, double low, double high) {
      return numbers.next([&] { return std::string(what); }, low, high).value_or(low);
    };
    constexpr double kTiny = 1e-9;
    const double lamps = number("the number of lamps", 0, 1e6);
    const double lumens = number("the lumens per lamp", -kMostCandela, kMostCandela);
    const double multiplier = number("the candela multiplier", kTiny, kMostFactor);
    const std::size_t vertical =
        numbers.next_count("the number of vertical angles", 2, kMaxLampAngles).value_or(0);
    const std::size_t horizontal =
        numbers.next_count("the number of horizontal angles", 1, kMaxLampAngles).value_or(0);
    const std::size_t type = numbers.next_count("the photometric type", 1, 3).value_or(1);
    const std::size_t unit = numbers.next_count("the unit (1 feet, 2 metres)", 1, 2).value_or(2);
    // LM-63 gives width, length and height: along Y, X and Z.
    const double width = number("the width", -kMostFactor, kMostFactor);
    const double length = number("the length", -kMostFactor, kMostFactor);
    const double height = number("the height", -kMostFactor, kMostFactor);
    const double ballast = number("the ballast factor", kTiny, kMostFactor);
    const double second =
        number("the ballast-lamp photometric factor", is_recent() ? -kMostFactor : kTiny, kMostFactor);
    lamp_.watts = std::max(number("the input watts", -kMostFactor, kMostFactor), 0.0);
    if (faults_.has_errors()) return;
    if (vertical * horizontal > kMaxLampValues)
      return numbers.fault(
          fmt::format("{} times {} candela values are more than {}", vertical, horizontal, kMaxLampValues));
    lamp_.opening_m = glm::dvec3(length, width, height) * (unit == 1 ? kMetresPerFoot : 1.0);
    if (lumens >= 0) lamp_.rated_lumens = lamps * lumens;
    lamp_.type = type == 1   ? PhotometricType::type_c
                 : type == 2 ? PhotometricType::type_b
                             : PhotometricType::type_a;
    read_candela(numbers, vertical, horizontal, multiplier * ballast * (is_recent() ? 1 : second));
  }

  // From 2002 on the second factor is kept for the future, and in 2019 it tells how the file was made.
  [[nodiscard]] bool is_recent() const {
    return lamp_.format.find("2002") != std::string::npos || lamp_.format.find("2019") != std::string::npos;
  }

  void read_candela(NumberStream& numbers, std::size_t vertical, std::size_t horizontal, double factor) {
    const bool is_c = lamp_.type == PhotometricType::type_c;
    auto vertical_deg = numbers.next_angles("vertical", vertical, is_c ? 0 : -90, is_c ? 180 : 90);
    if (!vertical_deg) return;
    const auto planes_deg = numbers.next_angles("horizontal", horizontal, is_c ? 0 : -90, is_c ? 360 : 90);
    if (!planes_deg) return;
    const std::optional<LampSymmetry> symmetry = symmetry_of(*planes_deg, numbers);
    if (!symmetry) return;
    lamp_.vertical_deg = std::move(*vertical_deg);
    std::vector<std::vector<double>> columns(horizontal);
    for (std::size_t h = 0; h < horizontal; ++h) {
      columns[h].reserve(vertical);
      for (std::size_t v = 0; v < vertical; ++v) {
        const auto describe = [&] {
          return fmt::format("candela value {} of {} in plane {} of {}", v + 1, vertical, h + 1, horizontal);
        };
        const std::optional<double> candela = numbers.next(describe, 0, kMostCandela);
        if (!candela) return;
        columns[h].push_back(*candela * factor);
      }
    }
    numbers.expect_end([&] { return fmt::format("{} x {} candela values", horizontal, vertical); });
    set_planes(lamp_, *symmetry, *planes_deg, columns);
  }

  // What the range of the planes says of the lamp's symmetry.
  std::optional<LampSymmetry> symmetry_of(const std::vector<double>& planes, NumberStream& numbers) {
    constexpr double kSlack = 1e-3;
    const auto spans = [&](double first, double last) {
      return std::abs(planes.front() - first) <= kSlack && std::abs(planes.back() - last) <= kSlack;
    };
    if (lamp_.type != PhotometricType::type_c) {
      if (planes.size() < 2) {
        numbers.fault("expected at least 2 horizontal angles in photometry of types A and B, got 1");
        return std::nullopt;
      }
      return std::abs(planes.front()) <= kSlack ? LampSymmetry::about_c0 : LampSymmetry::none;
    }
    if (planes.size() == 1) return LampSymmetry::full_turn;
    if (spans(0, 90)) return LampSymmetry::about_both;
    if (spans(0, 180)) return LampSymmetry::about_c0;
    if (spans(90, 270)) return LampSymmetry::about_c90;
    // Many files leave out the plane at 360°, which is that at 0°.
    double widest = 0;
    for (std::size_t i = 1; i < planes.size(); ++i) widest = std::max(widest, planes[i] - planes[i - 1]);
    if (planes.front() + 360 - planes.back() <= widest + kSlack) return LampSymmetry::none;
    numbers.fault(fmt::format(
        "expected planes from 0 to 90, 0 to 180, 90 to 270 or all round, or a single one, got {} to {}",
        planes.front(), planes.back()));
    return std::nullopt;
  }

  std::vector<std::string_view> lines_;
  const std::filesystem::path& folder_;
  FaultList& faults_;
  LightDistribution lamp_;
};

}  // namespace

bool looks_like_ies(std::string_view text) {
  const std::vector<std::string_view> lines = split_lines(text);
  return text.substr(0, 3) == "IES" || std::any_of(lines.begin(), lines.end(), is_tilt_line);
}

Result<LightDistribution> read_ies(std::string_view text, const std::string& file,
                                   const std::filesystem::path& folder) {
  FaultList faults(file);
  LightDistribution lamp = IesReader(text, folder, faults).read();
  if (faults.has_errors()) return tl::unexpected(Error(Failure::bad_input, faults.errors()));
  return lamp;
}

}  // namespace laterna
