// laterna environment: pictures of all directions from chart to chart, and from points of scenes.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/StringTools.hpp>
#include <CLI/Validators.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "laterna/environment.h"
#include "laterna/environment_accuracy.h"
#include "laterna/environment_probe.h"
#include "outcome.h"
#include "progress_line.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

using Json = nlohmann::json;

struct Options {
  std::string input, output, from, to = "latlong";
  int size = 0;
  double exposure = 0;
  bool list_charts = false, split_sum = false, json = false;
  // Of a scene.
  SceneOptions scene;
  std::vector<double> at;
  int samples = 4;
};

constexpr int kMeasuredSize = 256;

int list_charts(const Options& options) {
  const int size = options.size > 0 ? options.size : kMeasuredSize;
  Json charts = Json::array();
  if (!options.json) {
    fmt::print("{:<17} {:>5} {:>13} {:>19} {:>9} {:>14}\n", "chart", "shape", "largest sr /", "anisotropy",
               "unused", "Mtexel where");
    fmt::print("{:<17} {:>5} {:>13} {:>9} {:>9} {:>9} {:>14}\n", "", "", "smallest", "worst", "mean", "area",
               "all <= 0.1 deg");
  }
  for (const EnvironmentChartDescription& known : list_environment_charts()) {
    const ChartDistortion d = measure_distortion(known.chart, size);
    const double ratio = d.largest_solid_angle / d.smallest_solid_angle;
    if (options.json) {
      charts.push_back({{"name", known.name},
                        {"columns", known.columns},
                        {"rows", known.rows},
                        {"meaning", known.meaning},
                        {"measured_size", size},
                        {"solid_angle_ratio", ratio},
                        {"largest_solid_angle_sr", d.largest_solid_angle},
                        {"smallest_solid_angle_sr", d.smallest_solid_angle},
                        {"anisotropy", d.anisotropy},
                        {"mean_anisotropy", d.mean_anisotropy},
                        {"unused_share", d.unused_share},
                        {"coarsest_deg", d.coarsest_deg},
                        {"megatexels_at_tenth_deg", d.megatexels_at_tenth_deg}});
      continue;
    }
    fmt::print("{:<17} {:>5} {:>13.4g} {:>9.4g} {:>9.3g} {:>8.1f}% {:>14.1f}\n", known.name,
               fmt::format("{}:{}", known.columns, known.rows), ratio, d.anisotropy, d.mean_anisotropy,
               100 * d.unused_share, d.megatexels_at_tenth_deg);
  }
  if (options.json) fmt::print("{}\n", charts.dump(2));
  return kOk;
}

// What is to be converted, with its chart.
struct Source {
  LayeredImage picture;
  EnvironmentChart chart;
};

Result<Source> read_source(const Options& options) {
  Result<LayeredImage> picture = read_layered_image(options.input);
  if (!picture) return tl::unexpected(std::move(picture.error()));
  const auto chart = options.from.empty() ? guess_environment_chart(picture->width, picture->height)
                                          : find_environment_chart(options.from);
  if (!chart) {
    return tl::unexpected(bad_option(fmt::format("cannot tell the chart of a picture of {} x {}: say --from",
                                                 picture->width, picture->height)));
  }
  return Source{std::move(*picture), *chart};
}

Result<Source> draw_source(const Options& options) {
  if (options.at.size() != 3) return tl::unexpected(bad_option("--from-scene needs --at x,y,z, in metres"));
  const Result<Renderer> renderer = options.scene.make_renderer();
  if (!renderer) return tl::unexpected(renderer.error());
  EnvironmentProbe probe;
  probe.position_ws = {options.at[0], options.at[1], options.at[2]};
  if (options.size > 0) probe.face_size = options.size;
  RenderSettings settings;
  settings.samples = options.samples;
  Result<LayeredImage> cube = render_environment(*renderer, probe, settings, progress_line("looking around"));
  if (!cube) return tl::unexpected(std::move(cube.error()));
  return Source{std::move(*cube), EnvironmentChart::cube};
}

int report_split_sum(const Options& options) {
  const Result<Source> source = read_source(options);
  if (!source) return report(source.error());
  const auto errors = measure_split_sum(source->picture, source->chart, options.scene.threads);
  if (!errors) return report(errors.error());
  if (options.json) {
    Json rows = Json::array();
    for (const SplitSumError& e : *errors) {
      rows.push_back({{"roughness", e.roughness},
                      {"n_v", e.n_v},
                      {"split_sum_rms", e.split_sum},
                      {"prefilter_rms", e.prefilter}});
    }
    fmt::print("{}\n", rows.dump(2));
    return kOk;
  }
  fmt::print(
      "RMS error over RMS radiance, white metal, against Monte Carlo\n{:>9} {:>10}   split sum at n.v "
      "=\n{:>20} ",
      "roughness", "prefilter", "");
  for (const SplitSumError& e : *errors) {
    if (e.roughness == errors->front().roughness) fmt::print("{:>8.1f}", e.n_v);
  }
  for (const SplitSumError& e : *errors) {
    if (e.n_v == errors->front().n_v) fmt::print("\n{:>9.3f} {:>9.2f}% ", e.roughness, 100 * e.prefilter);
    fmt::print("{:>7.2f}%", 100 * e.split_sum);
  }
  fmt::print("\n");
  return kOk;
}

// What is said of a picture beside what is said of a scene, or of a table: one of them would be left aside without a word.
Result<void> check_use(const CLI::App& command, const Options& options) {
  const auto refuse_with = [&](std::initializer_list<const char*> names,
                               std::string_view why) -> Result<void> {
    for (const char* name : names) {
      if (command.count(name) > 0) return tl::unexpected(bad_option(fmt::format("{} {}", name, why)));
    }
    return {};
  };
  if (options.list_charts)
    return refuse_with({"IN", "OUT", "--chart", "--from", "--from-scene", "--rig", "--at", "--samples",
                        "--split-sum", "--exposure"},
                       "is of no use with --list-charts, which reads and writes no picture");
  if (options.split_sum)
    return refuse_with(
        {"OUT", "--chart", "--size", "--from-scene", "--rig", "--at", "--samples", "--exposure"},
        "is of no use with --split-sum, which reads IN and prints a table");
  if (options.scene.files.empty())
    return refuse_with({"--at", "--rig", "--samples"}, "belongs to --from-scene");
  if (command.count("IN") > 0 && command.count("OUT") > 0)
    return tl::unexpected(bad_option("--from-scene is in place of IN: name only the picture to write"));
  return refuse_with({"--from"}, "belongs to IN: what is drawn of a scene is a cube");
}

int run_environment(const CLI::App& command, const Options& options) {
  if (const Result<void> used = check_use(command, options); !used) return report(used.error());
  if (options.list_charts) return list_charts(options);
  if (options.split_sum) return report_split_sum(options);
  const bool is_of_scene = !options.scene.files.empty();
  std::string output = options.output;
  if (is_of_scene && output.empty()) output = options.input;
  if (output.empty())
    return report(bad_option("expected a picture to read and one to write: laterna environment IN OUT"));
  if (command.count("--exposure") > 0 && !CLI::detail::to_lower(output).ends_with(".png"))
    return report(bad_option("--exposure belongs to .png: other pictures keep the light as it is"));
  if (Result<void> writable = check_image_output(output); !writable) return report(writable.error());
  const Result<Source> source = is_of_scene ? draw_source(options) : read_source(options);
  if (!source) return report(source.error());
  EnvironmentConversion conversion;
  conversion.from = source->chart;
  conversion.to = *find_environment_chart(options.to);
  conversion.size = options.size;
  conversion.threads = options.scene.threads;
  Result<LayeredImage> converted = convert_environment(source->picture, conversion);
  if (!converted) {
    for (Diagnostic& fault : converted.error().diagnostics) fault.file = options.input;
    return report(converted.error());
  }
  WriteOptions how;
  how.exposure = static_cast<float>(std::exp2(options.exposure));
  if (Result<void> written = write_image(*converted, output, how); !written) return report(written.error());
  if (options.json) {
    fmt::print("{}\n",
               Json({{"output", output},
                     {"from", list_environment_charts()[static_cast<std::size_t>(source->chart)].name},
                     {"chart", options.to},
                     {"width", converted->width},
                     {"height", converted->height}})
                   .dump(2));
  }
  return kOk;
}

}  // namespace

void declare_environment(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App* command = app.add_subcommand(
      "environment", "pictures of all directions: from chart to chart, or of what a point of a scene sees");
  std::vector<std::string> charts;
  for (const EnvironmentChartDescription& known : list_environment_charts()) charts.emplace_back(known.name);
  command->add_option("IN", o.input, "picture of all directions");
  command->add_option("-o,--output,OUT", o.output, "picture to write: .hdr, .exr, .pfm or .png");
  command->add_option("--chart", o.to, "of the output")->check(CLI::IsMember(charts))->capture_default_str();
  command->add_option("--from", o.from, "chart of the input; without it, told from its shape")
      ->check(CLI::IsMember(charts));
  command
      ->add_option(
          "--size", o.size,
          "N: latlong is 2N x N, a cube's faces, sphere and octahedral N x N; 0: as fine as the input")
      ->check(CLI::Range(0, kMaxEnvironmentSize))
      ->capture_default_str();
  command->add_option("--exposure", o.exposure, "stops, for .png")
      ->check(CLI::Range(-40.0, 40.0))
      ->capture_default_str();
  command->add_option("--from-scene", o.scene.files, "in place of IN: draw what a point of this scene sees")
      ->allow_extra_args(false);
  command->add_option("--rig", o.scene.rigs, "of the scene")->allow_extra_args(false);
  command->add_option("--at", o.at, "the point, x,y,z in metres")->delimiter(',')->expected(3);
  command->add_option("--samples", o.samples, "per pixel, of the scene: 1, 2, 4, 8 or 16")
      ->capture_default_str();
  o.scene.declare_machine(*command);
  command->add_flag("--list-charts", o.list_charts, "print what each chart does to directions, and end");
  command->add_flag(
      "--split-sum", o.split_sum,
      "print how far the split sum is from the integral in IN, by roughness and angle, and end");
  command->add_flag("--json", o.json, "tell in JSON");
  command->footer(
      "\nExamples:\n  laterna environment sky.hdr cube.exr --chart cube --size 512\n"
      "  laterna environment --list-charts\n"
      "  laterna environment --from-scene room.glb --rig stage.json --at 0,1.5,0 -o room.hdr\n");
  command->callback(
      [options, command, &run] { run = [options, command] { return run_environment(*command, *options); }; });
}

}  // namespace laterna::app
