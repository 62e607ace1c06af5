// laterna doctor: what this machine and build can do.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include <unistd.h>

#include "laterna/build_info.h"
#include "laterna/film.h"
#include "laterna/render.h"
#include "laterna/video.h"
#include "outcome.h"

namespace laterna::app {
namespace {

using Json = nlohmann::json;

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  }
  return "unknown";
}

double memory_gib() {
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long size = sysconf(_SC_PAGE_SIZE);
  return static_cast<double>(pages) * static_cast<double>(size) / (1024.0 * 1024 * 1024);
}

// One small picture on every instruction set: the same bits, or something is badly wrong with this machine or build.
Result<bool> pictures_agree() {
  std::vector<float> first;
  for (const InstructionSet set : supported_instruction_sets()) {
    Scene scene;
    Primitive triangle;
    triangle.positions = {{-1, -1, -3}, {1, -0.8F, -2}, {0.1F, 1, -4}};
    scene.meshes.push_back({"triangle", {triangle}});
    Node node;
    node.mesh = 0;
    scene.nodes.push_back(node);
    Result<Renderer> renderer = Renderer::create(std::move(scene), {1, set});
    if (!renderer) return tl::unexpected(renderer.error());
    RenderSettings settings;
    settings.width = settings.height = 64;
    const View view = {Pose{}, Projection::perspective(Angle::degrees(60), 1, 0.1, 100)};
    const Result<LayeredImage> image = renderer->render(view, settings);
    if (!image) return tl::unexpected(image.error());
    if (first.empty()) first = image->channels[0].values;
    if (first != image->channels[0].values) return false;
  }
  return true;
}

int run_doctor(bool as_json) {
  const Result<bool> agree = pictures_agree();
  if (!agree) return report(agree.error());
  Json j = {{"version", version()},
            {"processor", processor_name()},
            {"threads", std::thread::hardware_concurrency()},
            {"memory_gib", memory_gib()},
            {"instruction_sets", Json::array()},
            {"best", name_of(best_instruction_set())},
            {"components", Json::object()},
            {"same_bits_on_every_set", *agree},
            {"gpu_needed", false},
            {"display_needed", false}};
  const VideoSupport video = video_support();
  j["video"] = {{"available", video.is_there}, {"detail", video.description}, {"codecs", Json::array()}};
  std::string codecs;
  for (const VideoCodec& codec : list_video_codecs()) {
    if (!codec.is_there) continue;
    j["video"]["codecs"].push_back(codec.name);
    codecs += std::string(codecs.empty() ? "" : " ") + std::string(codec.name);
  }
  for (const InstructionSet set : supported_instruction_sets()) j["instruction_sets"].push_back(name_of(set));
  for (const Component& c : components()) j["components"][c.name] = c.version;
  if (as_json) {
    fmt::print("{}\n", j.dump(2));
    return *agree ? kOk : kComparisonFailed;
  }
  fmt::print("laterna {}\n", version());
  fmt::print("{:<18} {}\n{:<18} {}\n{:<18} {:.1f} GiB\n", "processor", processor_name(), "threads",
             std::thread::hardware_concurrency(), "memory", memory_gib());
  std::string sets;
  for (const InstructionSet set : supported_instruction_sets()) sets += std::string(name_of(set)) + " ";
  fmt::print("{:<18} {}(using {})\n", "instruction sets", sets, name_of(best_instruction_set()));
  fmt::print("{:<18} {}\n", "self-test",
             *agree ? "same bits on every instruction set"
                    : "PICTURES DIFFER between instruction sets: please report this machine");
  fmt::print("{:<18} not needed\n", "GPU, display");
  for (const Component& c : components()) fmt::print("{:<18} {}\n", c.name, c.version);
  fmt::print("{:<18} {}\n", "video", video.is_there ? video.description : "none: " + video.description);
  fmt::print("{:<18} {}\n", "films out", codecs);
  return *agree ? kOk : kComparisonFailed;
}

}  // namespace

void declare_doctor(CLI::App& app, Run& run) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("doctor", "versions, processor, instruction sets, and a self-test");
  command->add_flag("--json", *json, "as JSON");
  command->callback([json, &run] { run = [json] { return run_doctor(*json); }; });
}

}  // namespace laterna::app
