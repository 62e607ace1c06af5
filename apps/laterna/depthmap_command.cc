// laterna depthmap: what a light sees, as depth.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <memory>

#include "laterna/measure.h"
#include "outcome.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

struct Options {
  SceneOptions scene;
  std::string light, output, view = "inverse";
  int face = 0;
};

int run_depthmap(const Options& options) {
  if (Result<void> writable = check_image_output(options.output); !writable) return report(writable.error());
  const Result<Renderer> renderer = options.scene.make_renderer();
  if (!renderer) return report(renderer.error());
  Result<LayeredImage> map = renderer->depth_map(options.light, options.face);
  if (!map) return report(map.error());
  if (options.view == "inverse") map = depth_picture(*map);
  if (!map) return report(map.error());
  if (Result<void> written = write_image(*map, options.output); !written) return report(written.error());
  return kOk;
}

}  // namespace

void declare_depthmap(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("depthmap", "the depth map of a light, as grey ramp or as metres");
  options->scene.declare_scene(*command);
  command->add_option("--light", options->light, "light by name")->required();
  command->add_option("-o,--output", options->output, "picture to write")->required();
  command
      ->add_option("--view", options->view,
                   "inverse: near is light, far dark, nothing white; metres: channel Z of an .exr")
      ->check(CLI::IsMember({"inverse", "metres"}))
      ->capture_default_str();
  command->add_option("--face", options->face, "0 to 5 for a light that shines all round: +X -X +Y -Y +Z -Z")
      ->capture_default_str();
  options->scene.declare_machine(*command);
  command->footer("\nExample:\n  laterna depthmap room.glb --rig stage.json --light lantern -o depth.png\n");
  command->callback([options, &run] { run = [options] { return run_depthmap(*options); }; });
}

}  // namespace laterna::app
