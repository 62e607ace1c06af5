// laterna ies: what a lamp file says of its lamp.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "laterna/lamps.h"
#include "laterna/polar_plot.h"
#include "outcome.h"

namespace laterna::app {
namespace {

using Json = nlohmann::json;

struct Options {
  std::string file, polar;
  bool json = false;
};

constexpr const char* kSections[2] = {"C0-C180", "C90-C270"};

const char* type_name(PhotometricType type) {
  switch (type) {
    case PhotometricType::type_a:
      return "A";
    case PhotometricType::type_b:
      return "B";
    case PhotometricType::type_c:
      break;
  }
  return "C";
}

// Text of an unknown encoding, as JSON and terminals take it.
std::string plain(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7E) c = '?';
  }
  return text;
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json describe(const LightDistribution& lamp, const LampSummary& summary) {
  Json j = {{"file", lamp.name},
            {"format", plain(lamp.format)},
            {"luminaire", plain(lamp.luminaire)},
            {"photometric_type", type_name(lamp.type)},
            {"vertical_angles", lamp.vertical_deg.size()},
            {"horizontal_angles", lamp.horizontal_deg.size()},
            {"rated_lm", or_null(lamp.rated_lumens)},
            {"watts", lamp.watts},
            {"opening_m", {lamp.opening_m.x, lamp.opening_m.y, lamp.opening_m.z}},
            {"has_tilt", !lamp.tilt.empty()},
            {"flux_lm", summary.flux_lm},
            {"peak_cd", summary.peak_cd},
            {"peak_vertical_deg", summary.peak_vertical_deg},
            {"peak_horizontal_deg", summary.peak_horizontal_deg},
            {"beam_angle_deg", or_null(summary.sections[0].beam_angle_deg)},
            {"field_angle_deg", or_null(summary.sections[0].field_angle_deg)},
            {"beam_angle_c90_deg", or_null(summary.sections[1].beam_angle_deg)},
            {"field_angle_c90_deg", or_null(summary.sections[1].field_angle_deg)},
            {"sections", Json::array()}};
  for (const std::size_t i : {0U, 1U}) {
    const LampSection& section = summary.sections[i];
    j["sections"].push_back({{"name", kSections[i]},
                             {"peak_cd", section.peak_cd},
                             {"beam_angle_deg", or_null(section.beam_angle_deg)},
                             {"field_angle_deg", or_null(section.field_angle_deg)}});
  }
  return j;
}

std::string degrees(const std::optional<double>& angle) {
  return angle ? fmt::format("{:.1f}°", *angle) : "-";
}

void print_table(const LightDistribution& lamp, const LampSummary& s) {
  if (!lamp.luminaire.empty()) fmt::print("{:<14} {}\n", "lamp", plain(lamp.luminaire));
  fmt::print("{:<14} {}, type {}, {} vertical x {} horizontal angles\n", "file", plain(lamp.format),
             type_name(lamp.type), lamp.vertical_deg.size(), lamp.horizontal_deg.size());
  fmt::print(
      "{:<14} {}\n", "photometry",
      lamp.rated_lumens ? fmt::format("relative, lamps rated {:.6g} lm", *lamp.rated_lumens) : "absolute");
  fmt::print("{:<14} {:.1f} lm\n", "flux", s.flux_lm);
  fmt::print("{:<14} {:.1f} cd at vertical {:g}°, horizontal {:g}°\n", "peak", s.peak_cd, s.peak_vertical_deg,
             s.peak_horizontal_deg);
  fmt::print("{:<14} {:>10} {:>10}\n", "", kSections[0], kSections[1]);
  fmt::print("{:<14} {:>11} {:>11}\n", "beam (50 %)", degrees(s.sections[0].beam_angle_deg),
             degrees(s.sections[1].beam_angle_deg));
  fmt::print("{:<14} {:>11} {:>11}\n", "field (10 %)", degrees(s.sections[0].field_angle_deg),
             degrees(s.sections[1].field_angle_deg));
  if (!lamp.tilt.empty()) fmt::print("{:<14} {} factors, not applied\n", "tilt", lamp.tilt.size());
}

int run_ies(const Options& options) {
  const Result<LightDistribution> lamp = read_lamp_file(options.file);
  if (!lamp) return report(lamp.error());
  if (!options.polar.empty()) {
    if (const Result<void> written = write_polar_plot(*lamp, options.polar); !written)
      return report(written.error());
  }
  const LampSummary summary = summarise(*lamp);
  if (options.json) {
    fmt::print("{}\n", describe(*lamp, summary).dump(2));
  } else {
    print_table(*lamp, summary);
  }
  return kOk;
}

}  // namespace

void declare_ies(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("ies", "flux, peak, beam and field angles of a lamp file: IES LM-63 or EULUMDAT");
  command->add_option("FILE", options->file, ".ies or .ldt")->required();
  command->add_option("--polar", options->polar, "polar intensity diagram to write, an SVG");
  command->add_flag("--json", options->json, "as JSON, with all there is");
  command->footer(
      "\nBeam and field are the full angles within which a section through the lamp has 50 % and 10 % of its "
      "peak.\n"
      "\nExample:\n  laterna ies downlight.ies --polar downlight.svg\n");
  command->callback([options, &run] { run = [options] { return run_ies(*options); }; });
}

}  // namespace laterna::app
