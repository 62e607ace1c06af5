// How the cost of a frame grows: with triangles, pixels, lights, texels of shadow maps, threads, from instruction set to
// instruction set, and of a crowd with its models and lights. Prints Markdown.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <thread>

#include "crowd.h"
#include "growth_table.h"
#include "landscape.h"
#include "workload.h"

namespace laterna::growth {
namespace {

struct Size {
  int width = 1920, height = 1080;
  [[nodiscard]] double pixels() const { return static_cast<double>(width) * height; }
};

// One thread unless threads are what grows: stages then add up to the frame.
struct Machine {
  int threads = 1;
  std::optional<InstructionSet> set;
};

std::function<Result<app::Subject>()> subject_of(Landscape landscape, Size size = {}, Machine machine = {}) {
  return [=]() -> Result<app::Subject> {
    Result<Renderer> renderer = Renderer::create(make_scene(landscape), {machine.threads, machine.set});
    if (!renderer) return tl::unexpected(renderer.error());
    RenderSettings settings;
    settings.width = size.width;
    settings.height = size.height;
    settings.shading = ShadingModel::phong;
    settings.anisotropy = 1;
    return app::Subject{
        std::move(*renderer), make_view(static_cast<double>(size.width) / size.height), settings, {}};
  };
}

std::string thousands(int count) {
  return count < 1'000'000 ? fmt::format("{} k", count / 1000) : fmt::format("{} M", count / 1'000'000);
}

Table triangles_table(bool quick) {
  Table table = {
      "triangles",
      "1920 × 1080, one projector with a map of 1024², one thread. The hills always fill the picture.",
      "triangle"};
  for (const int count : {10'000, 30'000, 100'000, 300'000, 1'000'000, 3'000'000, 10'000'000}) {
    if (quick && count > 1'000'000) break;
    table.rows.push_back({thousands(count), static_cast<double>(count), subject_of({count, 1, 1024})});
  }
  return table;
}

Table pixels_table(bool quick) {
  Table table = {"pixels", "300 k triangles, one projector with a map of 1024², one thread.", "pixel"};
  for (const Size size :
       {Size{640, 400}, Size{1280, 800}, Size{1920, 1080}, Size{3840, 2160}, Size{7680, 4320}}) {
    if (quick && size.width > 3840) break;
    table.rows.push_back(
        {fmt::format("{} × {}", size.width, size.height), size.pixels(), subject_of({}, size)});
  }
  return table;
}

Table lights_table(bool quick) {
  Table table = {
      "lights",
      "960 × 540, 300 k triangles, one thread. Each projector lights all of the hills and has a map of 512².",
      "pixel and light"};
  constexpr Size kSize = {960, 540};
  for (const int count : {1, 4, 16, 64}) {
    if (quick && count > 16) break;
    table.rows.push_back(
        {std::to_string(count), count * kSize.pixels(), subject_of({300'000, count, 512}, kSize)});
  }
  return table;
}

Table maps_table(bool quick) {
  Table table = {"map texels", "960 × 540, 300 k triangles, one projector, one thread.", "texel"};
  table.of_maps = true;
  for (const int side : {256, 512, 1024, 2048, 4096, 8192, 16384}) {
    if (quick && side > 4096) break;
    table.rows.push_back({fmt::format("{}²", side), static_cast<double>(side) * side,
                          subject_of({300'000, 1, side}, {960, 540})});
  }
  return table;
}

Table threads_table() {
  Table table = {
      "threads",
      "1920 × 1080, 300 k triangles, one projector with a map of 1024². Stages are sums over threads.", ""};
  const int processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (int count = 1; count <= processors; count *= 2) {
    table.rows.push_back({std::to_string(count), 0, subject_of({}, {}, {count, {}})});
  }
  return table;
}

Table instruction_sets_table() {
  Table table = {"instruction sets",
                 "1920 × 1080, 300 k triangles, one projector with a map of 1024², one thread.", ""};
  for (const InstructionSet set : supported_instruction_sets()) {
    table.rows.push_back({std::string(name_of(set)), 0, subject_of({}, {}, {1, set})});
  }
  return table;
}

// What passes from frame to frame of a film.
constexpr double kFilmFrame = 1.0 / 24;

std::function<Result<app::Subject>()> subject_of(Crowd crowd, Size size, Machine machine = {}) {
  return [=]() -> Result<app::Subject> {
    Result<Scene> scene = make_crowd(crowd);
    if (!scene) return tl::unexpected(scene.error());
    Result<Renderer> renderer = Renderer::create(std::move(*scene), {machine.threads, machine.set});
    if (!renderer) return tl::unexpected(renderer.error());
    RenderSettings settings;
    settings.width = size.width;
    settings.height = size.height;
    return app::Subject{std::move(*renderer),
                        look_at_crowd(crowd, static_cast<double>(size.width) / size.height),
                        settings,
                        {}};
  };
}

constexpr Size kCrowdSize = {1280, 720};

Table crowd_models_table(bool quick) {
  Table table = {"crowd: models",
                 "1280 × 720, models that all move, under 8 moving spots with maps of 512², one thread.",
                 "model"};
  table.seconds_per_frame = kFilmFrame;
  for (const int count : {10, 50, 200, 800}) {
    if (quick && count > 200) break;
    table.rows.push_back(
        {std::to_string(count), static_cast<double>(count), subject_of(Crowd{count}, kCrowdSize)});
  }
  return table;
}

Table crowd_lights_table(bool quick) {
  Table table = {"crowd: lights", "The same with 200 models under more and more lights.", "light"};
  table.seconds_per_frame = kFilmFrame;
  for (const int count : {1, 2, 4, 8, 16}) {
    if (quick && count > 8) break;
    table.rows.push_back(
        {std::to_string(count), static_cast<double>(count), subject_of(Crowd{200, count}, kCrowdSize)});
  }
  return table;
}

Table crowd_pixels_table(bool quick) {
  Table table = {"crowd: pixels", "200 models under 8 lights, one thread.", "pixel"};
  table.seconds_per_frame = kFilmFrame;
  for (const Size size :
       {Size{640, 400}, Size{1280, 720}, Size{1920, 1080}, Size{2560, 1600}, Size{3840, 2160}}) {
    if (quick && size.width > 1920) break;
    table.rows.push_back(
        {fmt::format("{} × {}", size.width, size.height), size.pixels(), subject_of(Crowd{}, size)});
  }
  return table;
}

Table crowd_threads_table() {
  Table table = {"crowd: threads",
                 "1280 × 720, 200 models under 8 lights. Stages are sums over threads, but for posing.", ""};
  table.seconds_per_frame = kFilmFrame;
  const int processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (int count = 1; count <= processors; count *= 2)
    table.rows.push_back({std::to_string(count), 0, subject_of(Crowd{}, kCrowdSize, {count, {}})});
  return table;
}

// The workloads of a file, where there is one; see workload.h.
Table workloads_table(const std::filesystem::path& file) {
  Table table = {"workloads", fmt::format("Those of {}, one thread.", file.filename().string()), ""};
  table.poses_anew = false;
  const auto prepare = [file](const std::string& name) {
    return [file, name]() -> Result<app::Subject> {
      Result<app::Workload> workload = app::load_workload(file, name);
      if (!workload) return tl::unexpected(workload.error());
      Result<Renderer> renderer = Renderer::create(std::move(workload->scene), {1, {}});
      if (!renderer) return tl::unexpected(renderer.error());
      return app::Subject{std::move(*renderer), workload->view, workload->settings, workload->depth_light};
    };
  };
  for (const std::string& name : app::workload_names(file)) {
    table.rows.push_back({name, 0, prepare(name)});
    if (name == "W1") table.rows.push_back({"W1, maps kept", 0, prepare(name), true});
  }
  return table;
}

struct Options {
  bool quick = false;
  std::string only, workloads, pictures;
};

std::vector<Table> tables_of(const Options& options) {
  std::vector<Table> tables = {triangles_table(options.quick),
                               pixels_table(options.quick),
                               lights_table(options.quick),
                               maps_table(options.quick),
                               threads_table(),
                               instruction_sets_table(),
                               crowd_models_table(options.quick),
                               crowd_lights_table(options.quick),
                               crowd_pixels_table(options.quick),
                               crowd_threads_table()};
  if (std::filesystem::exists(options.workloads)) tables.push_back(workloads_table(options.workloads));
  return tables;
}

int run(const Options& options) {
  Effort effort;
  effort.rounds = options.quick ? 1 : 3;
  effort.series = {1, options.quick ? 1 : 3};
  effort.pictures = options.pictures;
  bool is_whole = true, is_known = false;
  for (const Table& table : tables_of(options)) {
    if (!options.only.empty() && table.name.rfind(options.only, 0) != 0) continue;
    is_known = true;
    is_whole = print_growth(table, effort) && is_whole;
  }
  if (!is_known) fmt::print(stderr, "there is no table \"{}\"\n", options.only);
  return is_whole && is_known ? 0 : 1;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("How the cost of a frame grows, as tables in Markdown");
  Options options;
  app.add_flag("--quick", options.quick, "one round, without the largest rows");
  app.add_option("--only", options.only, "tables whose names begin so, such as triangles, crowd");
  app.add_option("--pictures", options.pictures, "folder for the last frame of every row");
  app.add_option("--workloads", options.workloads, "file of workloads to add, see laterna bench --workload");
  CLI11_PARSE(app, argc, argv);
  return run(options);
}

}  // namespace
}  // namespace laterna::growth

int main(int argc, char** argv) {
  try {
    return laterna::growth::parse_and_run(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "growth_bench: %s\n", e.what());
    return 1;
  }
}
