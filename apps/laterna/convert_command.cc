// laterna convert: scenes and rigs into one glTF file.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <system_error>

#include "laterna/still_scene.h"
#include "laterna/write_scene.h"
#include "outcome.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

struct Options {
  SceneOptions scene;
  std::string output;
  bool embeds = false, is_still = false;
  ImageBasedLightSettings environment;
};

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::size_t triangles_of(const Scene& scene) {
  std::size_t corners = 0;
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& primitive : mesh.primitives)
      corners += primitive.indices.empty() ? primitive.positions.size() : primitive.indices.size();
  }
  return corners / 3;
}

void tell(const Scene& scene, const std::string& output) {
  std::size_t projectors = 0, lamps = 0;
  for (const Light& light : scene.lights) {
    projectors += light.type == LightType::projector ? 1 : 0;
    lamps += light.distribution != nullptr ? 1 : 0;
  }
  std::error_code ignored;
  const auto bytes = std::filesystem::file_size(output, ignored);
  fmt::print("{}: {}, {} of {}, {}, {}, {} ({}, {}), {} bytes\n", output,
             counted(scene.nodes.size(), "node", "nodes"), counted(scene.meshes.size(), "mesh", "meshes"),
             counted(triangles_of(scene), "triangle", "triangles"),
             counted(scene.materials.size(), "material", "materials"),
             counted(scene.cameras.size(), "camera", "cameras"),
             counted(scene.lights.size(), "light", "lights"), counted(projectors, "projector", "projectors"),
             counted(lamps, "measured lamp", "measured lamps"), bytes);
}

int run_convert(const Options& options) {
  if (const Result<void> possible = check_scene_output(options.output); !possible)
    return report(possible.error());
  Result<Scene> scene = options.scene.load();
  if (!scene) return report(scene.error());
  if (options.is_still && changes_with_time(*scene)) {
    const Result<std::vector<Diagnostic>> stilled = make_still(*scene, options.scene.time);
    if (!stilled) return report(stilled.error());
    report_warnings(*stilled);
    fmt::print(stderr,
               "laterna: note: animation is left out: the file shows the scene at {} s, as --time asks\n",
               options.scene.time);
  }
  const Result<RendererOptions> machine = options.scene.renderer_options();
  if (!machine) return report(machine.error());
  if (const Result<void> filtered = filter_environment(*scene, options.environment, *machine); !filtered)
    return report(filtered.error());
  const Result<std::vector<Diagnostic>> written =
      write_scene(*scene, options.output, SceneWriteOptions{.embeds = options.embeds});
  if (!written) return report(written.error());
  report_warnings(*written);
  tell(*scene, options.output);
  return kOk;
}

}  // namespace

void declare_convert(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("convert", "scenes and rigs into one glTF file, projectors and all");
  options->scene.declare_scene(*command);
  command->add_option("-o,--output", options->output, "the file to write: .glb or .gltf")->required();
  declare_written_environment(*command, options->environment);
  options->scene.declare_machine(*command);
  command->add_flag("--embed", options->embeds,
                    "a .gltf of one piece: geometry, pictures and lamps inside it, as a .glb has them");
  command->footer(
      "\nWhat is written is what `laterna render` shows: its pictures are the same, bit for bit, but for "
      "what\n"
      "a warning tells is not carried: layers on surfaces, photographs. Clips and paths go along, their "
      "numbers\n"
      "in single precision; with --time the file shows that instant and does not move: waves stand still, "
      "and of\n"
      "films there is the frame that is then shown. Environments are filtered and packed into 8 bits\n"
      "(EXT_lights_image_based), which shows a little. Other programs see\n"
      "projectors as spotlights; what only Laterna knows is in the glTF extensions LATERNA_projector and\n"
      "LATERNA_lighting, which they pass over. Beside a .gltf lie its .bin and those pictures that are not "
      "in its\n"
      "folder already. Films stay where they are without --time, and are named relative to the file. What "
      "cannot\n"
      "be carried is told as a warning.\n"
      "\nExamples:\n"
      "  laterna convert room.glb --rig stage.json -o stage.glb\n"
      "  laterna convert house.obj --up z --unit cm -o house.glb\n"
      "  laterna convert stage.glb -o stage.gltf --embed\n");
  command->callback([options, command, &run] {
    options->is_still = command->count("--time") > 0;
    run = [options] { return run_convert(*options); };
  });
}

}  // namespace laterna::app
