// How the cost of a frame grows: with triangles, pixels, lights, texels of shadow maps, threads, and from instruction set
// to instruction set. Prints Markdown.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <thread>

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
  std::string only, workloads;
};

std::vector<Table> tables_of(const Options& options) {
  std::vector<Table> tables = {triangles_table(options.quick),
                               pixels_table(options.quick),
                               lights_table(options.quick),
                               maps_table(options.quick),
                               threads_table(),
                               instruction_sets_table()};
  if (std::filesystem::exists(options.workloads)) tables.push_back(workloads_table(options.workloads));
  return tables;
}

int run(const Options& options) {
  Effort effort;
  effort.rounds = options.quick ? 1 : 3;
  effort.series = {1, options.quick ? 1 : 3};
  bool is_whole = true, is_known = false;
  for (const Table& table : tables_of(options)) {
    if (!options.only.empty() && table.name != options.only) continue;
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
  app.add_option("--only", options.only, "one table, such as triangles");
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
