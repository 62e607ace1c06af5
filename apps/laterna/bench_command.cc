// laterna bench: milliseconds per stage.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "frame_costs.h"
#include "outcome.h"
#include "silhouette_culling.h"
#include "subject.h"
#include "technique_names.h"
#include "technique_report.h"
#include "unserved_lights.h"

namespace laterna::app {
namespace {

using Json = nlohmann::json;

struct Options {
  SubjectOptions subject;
  std::string picture, shadows = "map", techniques;
  FrameSeries series;
  bool keep_maps = false, json = false;
};

struct Phase {
  const char* name;
  double RenderStatistics::*member;
};
constexpr Phase kPhases[] = {{"plan", &RenderStatistics::plan_ms},
                             {"casters", &RenderStatistics::shadow_ms},
                             {"bins", &RenderStatistics::bin_ms},
                             {"tiles", &RenderStatistics::shade_ms}};

Json stages_json(const StageTimes& stages) {
  Json json;
  for (std::size_t i = 0; i < kStageCount; ++i) json[name_of(static_cast<Stage>(i))] = stages.ms[i];
  return json;
}

Json results_json(const FrameCosts& costs, const Subject& subject) {
  const Timing frame = costs.frame();
  const StageTimes maps = costs.stages(&RenderStatistics::map_stages);
  const StageTimes picture = costs.stages(&RenderStatistics::picture_stages);
  StageTimes both = maps;
  both += picture;
  Json stages = stages_json(both);
  stages["pose"] = costs.pose().median;
  Json phases;
  for (const Phase& phase : kPhases) phases[phase.name] = costs.phase(phase.member).median;
  Json memory = Json::array();
  for (const auto& light : costs.last().shadow_memory) {
    memory.push_back({{"light", light.light}, {"maps", light.maps}, {"bytes", light.bytes}});
  }
  return {{"frame_ms", {{"median", frame.median}, {"min", frame.min}, {"max", frame.max}}},
          {"stages_ms", stages},
          {"map_stages_ms", stages_json(maps)},
          {"picture_stages_ms", stages_json(picture)},
          {"phases_ms", phases},
          {"peak_mb", peak_megabytes()},
          {"frames", costs.count()},
          {"threads", subject.renderer.threads()},
          {"instruction_set", name_of(subject.renderer.instruction_set())},
          {"size", {subject.settings.width, subject.settings.height}},
          {"triangles", costs.last().triangles},
          {"triangles_drawn", costs.last().triangles_drawn},
          {"maps_drawn", costs.last().maps_drawn},
          {"shadow_memory", memory}};
}

void print_stages(const FrameCosts& costs) {
  const StageTimes maps = costs.stages(&RenderStatistics::map_stages);
  const StageTimes picture = costs.stages(&RenderStatistics::picture_stages);
  fmt::print("{:<12} {:>12} {:>9}   ms, all threads together\n", "stage", "shadow maps", "picture");
  for (std::size_t i = 0; i < kStageCount; ++i) {
    fmt::print("{:<12} {:>12.2f} {:>9.2f}\n", name_of(static_cast<Stage>(i)), maps.ms[i], picture.ms[i]);
  }
  fmt::print("{:<12} {:>12.2f} {:>9.2f}\n\n", "all", maps.total(), picture.total());
}

void print_phases(const FrameCosts& costs) {
  const auto line = [](const char* name, const Timing& t) {
    fmt::print("{:<12} {:>12.2f} {:>9.2f} {:>9.2f}\n", name, t.median, t.min, t.max);
  };
  fmt::print("{:<12} {:>12} {:>9} {:>9}   by the clock\n", "phase", "median ms", "min", "max");
  if (costs.pose().max > 0) line("pose", costs.pose());
  for (const Phase& phase : kPhases) line(phase.name, costs.phase(phase.member));
  line("frame", costs.frame());
}

void print_table(const FrameCosts& costs, const Subject& subject) {
  const RenderStatistics& last = costs.last();
  fmt::print("{}x{}, {} threads, {}, median of {} frames\n", subject.settings.width, subject.settings.height,
             subject.renderer.threads(), name_of(subject.renderer.instruction_set()), costs.count());
  print_stages(costs);
  print_phases(costs);
  fmt::print("triangles {} considered, {} drawn; shadow maps {} drawn, {} kept; peak memory {:.0f} MB\n",
             last.triangles, last.triangles_drawn, last.maps_drawn, last.maps_kept, peak_megabytes());
}

std::string fault_of(const Options& options) {
  if (std::string fault = options.subject.find_fault("bench"); !fault.empty()) return fault;
  if (!options.techniques.empty() &&
      (options.keep_maps || options.series.poses_anew || !options.picture.empty())) {
    return "--techniques excludes --cached, --pose and --png";
  }
  if (options.series.warm_up < 0) return "--warm-up must be at least 0";
  if (options.picture == "-") return "bench prints to standard output: give --png a file";
  if (options.series.frames < 1) return "--frames must be at least 1";
  return {};
}

// Techniques beside each other, and projecting beside texturing.
int compare(const Options& options, const Subject& subject, const std::vector<ShadowTechnique>& techniques) {
  if (!subject.depth_light.empty()) {
    return report(bad_option("--techniques: the workload draws a depth map alone, which has no shadows"));
  }
  const Result<TechniqueComparison> comparison = compare_techniques(subject, options.series, techniques);
  if (!comparison) return report(comparison.error());
  const Result<ProjectionCost> projection = measure_projection(subject, options.series);
  if (!projection) return report(projection.error());
  if (options.json) {
    fmt::print("{}\n", json_of(*comparison, *projection).dump(2));
  } else {
    print_table(*comparison, *projection);
  }
  return kOk;
}

int run_bench(const Options& options) {
  if (const std::string fault = fault_of(options); !fault.empty()) return report(bad_option(fault));
  Result<std::vector<ShadowTechnique>> techniques;
  if (!options.techniques.empty()) techniques = parse_techniques(options.techniques);
  if (!techniques) return report(techniques.error());
  Result<Subject> subject = options.subject.prepare();
  if (!subject) return report(subject.error());
  if (!techniques->empty()) return compare(options, *subject, *techniques);
  subject->settings.keep_shadow_maps = options.keep_maps;
  for (const TechniqueDescription& t : list_techniques()) {
    if (t.name == options.shadows) subject->settings.shadows = t.technique;
  }
  tell_unserved_lights(subject->renderer.scene(), subject->settings.shadows);
  const Result<FrameCosts> costs = draw_series(*subject, options.series, options.picture);
  if (!costs) return report(costs.error());
  const Result<std::optional<CullingComparison>> culling = compare_culling(*subject, options.series, *costs);
  if (!culling) return report(culling.error());
  if (options.json) {
    Json json = results_json(*costs, *subject);
    if (*culling) json["silhouettes"] = json_of(**culling);
    fmt::print("{}\n", json.dump(2));
  } else {
    print_table(*costs, *subject);
    if (*culling) print_table(**culling);
  }
  return kOk;
}

}  // namespace

void declare_bench(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("bench", "milliseconds per stage, median of several frames");
  options->subject.declare(*command);
  command
      ->add_option(
          "--shadows", options->shadows,
          "technique for lights that name none; with silhouettes, what culling saves is measured too")
      ->check(CLI::IsMember(technique_names()))
      ->capture_default_str();
  command->add_option("--frames", options->series.frames, "frames that count")->capture_default_str();
  command->add_option("--warm-up", options->series.warm_up, "frames before them")->capture_default_str();
  command->add_flag("--cached", options->keep_maps, "keep shadow maps from frame to frame");
  command->add_flag("--pose", options->series.poses_anew,
                    "carry geometry to world space before each frame, as when something moves");
  command->add_option(
      "--techniques", options->techniques,
      "all, or names with commas between: what each costs beside how right it is, which to take, "
      "and what projecting costs beside texturing");
  command->add_option("--png", options->picture, "write the last frame");
  options->subject.scene.declare_machine(*command);
  command->add_flag("--json", options->json, "as JSON");
  command->footer(
      "\nExample:\n  laterna bench scene.glb --size 1920x1080 --frames 15 --threads 2\n"
      "  laterna bench scene.glb --techniques all\n");
  command->callback([options, &run] { run = [options] { return run_bench(*options); }; });
}

}  // namespace laterna::app
