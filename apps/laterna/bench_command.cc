// laterna bench: milliseconds per stage.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include "outcome.h"
#include "scene_options.h"
#include "workload.h"

namespace laterna::app {
namespace {

using Json = nlohmann::json;

struct Options {
  SceneOptions scene;
  ViewOptions view;
  std::string workload, name = "W1", scenes, picture;
  int frames = 15, warm_up = 3;
  bool keep_maps = false, json = false;
};

struct Timing {
  double median, min, max;
};

Timing timing_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const double median = n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
  return {median, values.front(), values.back()};
}

struct Stage {
  const char* name;
  double RenderStatistics::*member;
};
constexpr Stage kStages[] = {{"plan", &RenderStatistics::plan_ms},
                             {"shadow", &RenderStatistics::shadow_ms},
                             {"bin", &RenderStatistics::bin_ms},
                             {"shade", &RenderStatistics::shade_ms}};

Timing timing_of(const std::vector<RenderStatistics>& frames, double RenderStatistics::*member) {
  std::vector<double> values;
  for (const RenderStatistics& f : frames) values.push_back(f.*member);
  return timing_of(std::move(values));
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

struct Prepared {
  Renderer renderer;
  View view;
  RenderSettings settings;
};

Result<Prepared> prepare_workload(const Options& options) {
  const Result<RendererOptions> machine = options.scene.renderer_options();
  if (!machine) return tl::unexpected(machine.error());
  Result<Workload> workload = load_workload(options.workload, options.name, options.scenes);
  if (!workload) return tl::unexpected(workload.error());
  Result<Renderer> renderer = Renderer::create(std::move(workload->scene), *machine);
  if (!renderer) return tl::unexpected(renderer.error());
  return Prepared{std::move(*renderer), workload->view, workload->settings};
}

Result<Prepared> prepare_scene(const Options& options) {
  const Result<ViewOptions::Size> size = options.view.parse_size();
  if (!size) return tl::unexpected(size.error());
  Result<Renderer> renderer = options.scene.make_renderer();
  if (!renderer) return tl::unexpected(renderer.error());
  const Result<View> view = options.view.find(*renderer, *size);
  if (!view) return tl::unexpected(view.error());
  RenderSettings settings;
  settings.width = size->width;
  settings.height = size->height;
  return Prepared{std::move(*renderer), *view, settings};
}

Json results_json(const std::vector<RenderStatistics>& frames, const Prepared& prepared) {
  const Timing total = timing_of(frames, &RenderStatistics::total_ms);
  Json stages;
  for (const Stage& stage : kStages) stages[stage.name] = timing_of(frames, stage.member).median;
  Json memory = Json::array();
  for (const auto& light : frames.back().shadow_memory) {
    memory.push_back({{"light", light.light}, {"maps", light.maps}, {"bytes", light.bytes}});
  }
  return {{"frame_ms", {{"median", total.median}, {"min", total.min}, {"max", total.max}}},
          {"stages_ms", stages},
          {"peak_mb", peak_megabytes()},
          {"frames", frames.size()},
          {"threads", prepared.renderer.threads()},
          {"instruction_set", name_of(prepared.renderer.instruction_set())},
          {"size", {prepared.settings.width, prepared.settings.height}},
          {"triangles", frames.back().triangles},
          {"triangles_drawn", frames.back().triangles_drawn},
          {"maps_drawn", frames.back().maps_drawn},
          {"shadow_memory", memory}};
}

void print_table(const std::vector<RenderStatistics>& frames, const Prepared& prepared) {
  fmt::print("{}x{}, {} threads, {}, median of {} frames\n", prepared.settings.width,
             prepared.settings.height, prepared.renderer.threads(),
             name_of(prepared.renderer.instruction_set()), frames.size());
  fmt::print("{:<8} {:>9} {:>9} {:>9}\n", "stage", "median ms", "min", "max");
  for (const Stage& stage : kStages) {
    const Timing t = timing_of(frames, stage.member);
    fmt::print("{:<8} {:>9.2f} {:>9.2f} {:>9.2f}\n", stage.name, t.median, t.min, t.max);
  }
  const Timing t = timing_of(frames, &RenderStatistics::total_ms);
  fmt::print("{:<8} {:>9.2f} {:>9.2f} {:>9.2f}\n", "frame", t.median, t.min, t.max);
  fmt::print("triangles {} considered, {} drawn; shadow maps {} drawn, {} kept; peak memory {:.0f} MB\n",
             frames.back().triangles, frames.back().triangles_drawn, frames.back().maps_drawn,
             frames.back().maps_kept, peak_megabytes());
}

int run_bench(const Options& options) {
  if (options.workload.empty() && options.scene.files.empty()) {
    return report(bad_option("bench needs a SCENE or --workload"));
  }
  if (options.warm_up < 0) return report(bad_option("--warm-up must be at least 0"));
  if (options.picture == "-") return report(bad_option("bench prints to standard output: give --png a file"));
  if (options.frames < 1) return report(bad_option("--frames must be at least 1"));
  Result<Prepared> prepared = options.workload.empty() ? prepare_scene(options) : prepare_workload(options);
  if (!prepared) return report(prepared.error());
  RenderSettings& settings = prepared->settings;
  settings.keep_shadow_maps = options.keep_maps;
  Image image(settings.width, settings.height, 3, PixelType::u8, Transfer::srgb);
  RenderTarget target;
  target.color8 =
      ColorTarget8{image.values<std::uint8_t>().data(), 3, static_cast<std::size_t>(settings.width) * 3, 1};
  std::vector<RenderStatistics> frames;
  for (int i = -options.warm_up; i < options.frames; ++i) {
    const Result<RenderStatistics> done = prepared->renderer.render_into(prepared->view, settings, target);
    if (!done) return report(done.error());
    if (i >= 0) frames.push_back(*done);
  }
  if (!options.picture.empty()) {
    if (Result<void> written = write_image(image, options.picture); !written) return report(written.error());
  }
  if (options.json) {
    fmt::print("{}\n", results_json(frames, *prepared).dump(2));
  } else {
    print_table(frames, *prepared);
  }
  return kOk;
}

}  // namespace

void declare_bench(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("bench", "milliseconds per stage, median of several frames");
  options->scene.declare_scene(*command);
  command->get_option("SCENE")->required(false);
  options->view.declare(*command);
  command->add_option("--workload", options->workload, "JSON file of named workloads instead of a SCENE");
  command->add_option("--name", options->name, "which workload")->capture_default_str();
  command->add_option("--scenes", options->scenes,
                      "folder of the workload's models; default: scenes beside the file");
  command->add_option("--frames", options->frames, "frames that count")->capture_default_str();
  command->add_option("--warm-up", options->warm_up, "frames before them")->capture_default_str();
  command->add_flag("--cached", options->keep_maps, "keep shadow maps from frame to frame");
  command->add_option("--png", options->picture, "write the last frame");
  options->scene.declare_machine(*command);
  command->add_flag("--json", options->json, "as JSON");
  command->footer("\nExample:\n  laterna bench scene.glb --size 1920x1080 --frames 15 --threads 2\n");
  command->callback([options, &run] { run = [options] { return run_bench(*options); }; });
}

}  // namespace laterna::app
