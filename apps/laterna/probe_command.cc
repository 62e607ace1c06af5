// laterna probe: light meters anywhere in a scene.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>

#include "laterna/probes.h"
#include "outcome.h"
#include "progress_line.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

struct Options {
  SceneOptions scene;
  std::vector<std::string> points;
  std::string object, rectangle, grid = "10x10", output;
  double spacing = 0;
  int accumulate = 1;
  bool json = false;
};

/// As many numbers as `values` holds, by comma; how many were found, or −1 where something else is written.
int parse_numbers(const std::string& text, std::span<double> values) {
  const char* at = text.c_str();
  for (std::size_t i = 0; i < values.size(); ++i) {
    char* end = nullptr;
    values[i] = std::strtod(at, &end);
    if (end == at) return -1;
    if (*end == 0) return static_cast<int>(i) + 1;
    if (*end != ',') return -1;
    at = end + 1;
  }
  return -1;
}

Result<Probe> parse_probe(const std::string& text) {
  std::array<double, 6> v = {0, 0, 0, 0, 1, 0};
  const int count = parse_numbers(text, v);
  if (count == 3 || count == 6) return Probe{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, 0};
  return tl::unexpected(
      bad_option(fmt::format("--probe: expected x,y,z or x,y,z,nx,ny,nz in metres, got \"{}\"", text)));
}

Result<std::vector<Probe>> parse_rectangle(const Options& options) {
  std::array<double, 9> v{};
  if (parse_numbers(options.rectangle, v) != 9) {
    return tl::unexpected(bad_option(
        fmt::format("--rectangle: expected nine numbers, a corner x,y,z and two edges from it, got \"{}\"",
                    options.rectangle)));
  }
  int across = 0;
  int down = 0;
  char rest = 0;
  if (std::sscanf(options.grid.c_str(), "%dx%d%c", &across, &down, &rest) != 2) {
    return tl::unexpected(
        bad_option(fmt::format("--grid: expected COLUMNSxROWS such as 20x10, got \"{}\"", options.grid)));
  }
  return probes_on_rectangle({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}, across, down);
}

Result<std::vector<Probe>> place_probes(const Options& options, const Renderer& renderer) {
  std::vector<Probe> probes;
  for (const std::string& point : options.points) {
    const Result<Probe> probe = parse_probe(point);
    if (!probe) return tl::unexpected(probe.error());
    probes.push_back(*probe);
  }
  const auto append = [&](Result<std::vector<Probe>> more) -> Result<void> {
    if (!more) return tl::unexpected(std::move(more.error()));
    probes.insert(probes.end(), more->begin(), more->end());
    return {};
  };
  if (!options.rectangle.empty()) {
    if (const Result<void> added = append(parse_rectangle(options)); !added)
      return tl::unexpected(added.error());
  }
  if (!options.object.empty()) {
    if (const Result<void> added = append(renderer.probes_on_object(options.object, options.spacing)); !added)
      return tl::unexpected(added.error());
    if (probes.empty()) {
      return tl::unexpected(bad_option(fmt::format(
          "--spacing: object \"{}\" is too small for a grid of {:g} m", options.object, options.spacing)));
    }
  }
  return probes;
}

std::string find_fault(const Options& options) {
  if (options.points.empty() && options.object.empty() && options.rectangle.empty())
    return "probe: where? Give --probe x,y,z, --rectangle with --grid, or --object with --spacing";
  if (!options.object.empty() && !(options.spacing > 0)) return "--object needs --spacing, in metres";
  if (options.json && options.output == "-") return "--json and -o - would both write to standard output";
  return {};
}

/// Lights that give some light at a probe.
void print_reading(const Probe& probe, const ProbeReport& report, const ProbeReading& reading) {
  const glm::dvec3& p = probe.position_ws;
  fmt::print("{:>12.6g} lx   at {:.6g},{:.6g},{:.6g}\n", reading.lux, p.x, p.y, p.z);
  for (std::size_t i = 0; i < reading.lights.size(); ++i) {
    const ProbeReading::FromLight& light = reading.lights[i];
    const std::string arrives = light.visibility > 0 ? fmt::format("{:.4g}", light.visibility) : "nothing";
    fmt::print("{:>12.6g}      {}, {} of it arrives\n", light.lux, report.lights[i], arrives);
  }
}

void print_report(const std::vector<Probe>& probes, const ProbeReport& report) {
  constexpr std::size_t kMostPrinted = 20;
  for (std::size_t i = 0; i < std::min(probes.size(), kMostPrinted); ++i)
    print_reading(probes[i], report, report.readings[i]);
  if (probes.size() < 2) return;
  if (probes.size() > kMostPrinted)
    fmt::print("… and {} more: -o FILE.csv holds them all\n", probes.size() - kMostPrinted);
  const ProbeSummary s = summarise(probes, report);
  fmt::print("{} probes: {:.6g} to {:.6g} lx, mean {:.6g}, uniformity {:.3g}\n", probes.size(), s.least,
             s.greatest, s.mean, s.uniformity);
  if (s.lumens > 0) fmt::print("{:.6g} lm on the grid\n", s.lumens);
}

int run_probe(const Options& options) {
  if (const std::string fault = find_fault(options); !fault.empty()) return report(bad_option(fault));
  if (!options.output.empty()) {
    if (const Result<void> known = check_probe_output(options.output); !known) return report(known.error());
  }
  const Result<Renderer> renderer = options.scene.make_renderer();
  if (!renderer) return report(renderer.error());
  const Result<std::vector<Probe>> probes = place_probes(options, *renderer);
  if (!probes) return report(probes.error());
  const Result<ProbeReport> measured =
      renderer->measure_probes(*probes, {options.accumulate}, progress_line("measuring"));
  if (!measured) return report(measured.error());
  if (options.json) {
    if (const Result<void> written = write_probes(*probes, *measured, "-"); !written)
      return report(written.error());
  } else if (options.output != "-") {
    print_report(*probes, *measured);
  }
  if (!options.output.empty()) {
    if (const Result<void> written = write_probes(*probes, *measured, options.output); !written)
      return report(written.error());
  }
  return kOk;
}

}  // namespace

void declare_probe(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App* command =
      app.add_subcommand("probe", "illuminance in lux at points, light by light, or over a grid");
  o.scene.declare_scene(*command);
  command
      ->add_option(
          "--probe", o.points,
          "x,y,z[,nx,ny,nz] in metres: a meter there, facing up unless a normal is given; repeatable")
      ->allow_extra_args(false);
  command->add_option("--rectangle", o.rectangle,
                      "x,y,z,rx,ry,rz,ux,uy,uz: a grid of meters from a corner along two edges, facing where "
                      "first × second points");
  command->add_option("--grid", o.grid, "columns x rows of the rectangle")->capture_default_str();
  command->add_option("--object", o.object, "a grid all over this object, facing outward");
  command->add_option("--spacing", o.spacing, "metres between the object's meters");
  command
      ->add_option("--accumulate", o.accumulate,
                   "lamps that have a size: the mean over so many points of them")
      ->check(CLI::Range(1, kMaxAccumulated))
      ->capture_default_str();
  command->add_option("-o,--output", o.output,
                      ".csv or .json with every reading; - is JSON to standard output");
  o.scene.declare_machine(*command);
  command->add_flag("--json", o.json, "as JSON, to standard output");
  command->footer(
      "\nAmbient light is no part of it. Shadows are found by rays, whatever the lights' techniques.\n"
      "\nExamples:\n"
      "  laterna probe room.glb --rig stage.json --probe 0,0.8,0 --probe 1,1.5,-2,0,0,1\n"
      "  laterna probe room.glb --rig stage.json --rectangle -2,0.8,2,4,0,0,0,0,-4 --grid 20x20 -o "
      "desks.csv\n"
      "  laterna probe room.glb --rig stage.json --object floor --spacing 0.25 --json\n");
  command->callback([options, &run] { run = [options] { return run_probe(*options); }; });
}

}  // namespace laterna::app
