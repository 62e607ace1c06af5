#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <string>

#include "base/json_text.h"
#include "base/output_file.h"
#include "base/refuse.h"
#include "laterna/probes.h"

namespace laterna {
namespace {

using Text = fmt::memory_buffer;

template <class... Values>
void add(Text& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

// Without the sign that a zero may have: an axis turned by half a turn has it.
glm::dvec3 plain(const glm::dvec3& v) { return v + glm::dvec3(0.0); }

// A field of a CSV file.
std::string csv_field(const std::string& value) {
  if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

Text csv_of(const std::vector<Probe>& probes, const ProbeReport& report) {
  Text text;
  add(text, "x,y,z,nx,ny,nz,area_m2,lux");
  for (const std::string& light : report.lights) add(text, ",{}", csv_field("lux." + light));
  for (const std::string& light : report.lights) add(text, ",{}", csv_field("visibility." + light));
  add(text, "\r\n");
  for (std::size_t i = 0; i < std::min(probes.size(), report.readings.size()); ++i) {
    const glm::dvec3 at = plain(probes[i].position_ws), normal = plain(probes[i].normal_ws);
    const ProbeReading& reading = report.readings[i];
    add(text, "{},{},{},{},{},{},{},{}", at.x, at.y, at.z, normal.x, normal.y, normal.z, probes[i].area,
        reading.lux);
    for (const ProbeReading::FromLight& light : reading.lights) add(text, ",{}", light.lux);
    for (const ProbeReading::FromLight& light : reading.lights) add(text, ",{}", light.visibility);
    add(text, "\r\n");
  }
  return text;
}

Text json_of(const std::vector<Probe>& probes, const ProbeReport& report) {
  Text text;
  const ProbeSummary s = summarise(probes, report);
  add(text, "{{\n  \"lights\": [");
  for (std::size_t i = 0; i < report.lights.size(); ++i)
    add(text, "{}{}", i == 0 ? "" : ", ", json_string(report.lights[i]));
  add(text,
      "],\n  \"summary\": {{\"probes\": {}, \"least_lux\": {}, \"greatest_lux\": {}, \"mean_lux\": {}, "
      "\"uniformity\": {}, \"lumens\": {}}},\n  \"probes\": [",
      probes.size(), s.least, s.greatest, s.mean, s.uniformity, s.lumens);
  for (std::size_t i = 0; i < std::min(probes.size(), report.readings.size()); ++i) {
    const glm::dvec3 at = plain(probes[i].position_ws), normal = plain(probes[i].normal_ws);
    const ProbeReading& reading = report.readings[i];
    add(text,
        "{}\n    {{\"position\": [{}, {}, {}], \"normal\": [{}, {}, {}], \"area_m2\": {}, \"lux\": {}, "
        "\"lights\": {{",
        i == 0 ? "" : ",", at.x, at.y, at.z, normal.x, normal.y, normal.z, probes[i].area, reading.lux);
    for (std::size_t light = 0; light < reading.lights.size(); ++light) {
      add(text, "{}{}: {{\"lux\": {}, \"visibility\": {}}}", light == 0 ? "" : ", ",
          json_string(report.lights[light]), reading.lights[light].lux, reading.lights[light].visibility);
    }
    add(text, "}}}}");
  }
  add(text, "\n  ]\n}}\n");
  return text;
}

bool is_csv(const std::filesystem::path& file) { return file.extension() == ".csv"; }

}  // namespace

Result<void> check_probe_output(const std::filesystem::path& file) {
  if (file == "-" || is_csv(file) || file.extension() == ".json") return {};
  return refuse(
      fmt::format("readings of probes are written to .csv or .json files, got \"{}\"", file.string()));
}

Result<void> write_probes(const std::vector<Probe>& probes, const ProbeReport& report,
                          const std::filesystem::path& file) {
  if (Result<void> known = check_probe_output(file); !known) return known;
  const Text text = is_csv(file) ? csv_of(probes, report) : json_of(probes, report);
  return write_file(file, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace laterna
