#include "subject.h"

#include <CLI/App.hpp>

#include "outcome.h"
#include "workload.h"

namespace laterna::app {

void SubjectOptions::declare(CLI::App& command) {
  scene.declare_scene(command);
  command.get_option("SCENE")->required(false);
  view.declare(command);
  command.add_option("--workload", workload, "JSON file of named workloads instead of a SCENE");
  command.add_option("--name", name, "which workload; W4.0: the first of a list, here of depth maps alone")
      ->capture_default_str();
  command.add_option("--scenes", scenes, "folder of the workload's models; default: scenes beside the file");
}

std::string SubjectOptions::find_fault(const std::string& command) const {
  return workload.empty() && scene.files.empty() ? command + " needs a SCENE or --workload" : "";
}

Result<Subject> SubjectOptions::prepare(const Amend& amend) const {
  return workload.empty() ? prepare_scene(amend) : prepare_workload(amend);
}

Result<Subject> SubjectOptions::prepare_workload(const Amend& amend) const {
  const Result<RendererOptions> machine = scene.renderer_options();
  if (!machine) return tl::unexpected(machine.error());
  Result<Workload> loaded = load_workload(workload, name, scenes);
  if (!loaded) return tl::unexpected(loaded.error());
  Result<Scene> amended = amend ? amend(std::move(loaded->scene)) : std::move(loaded->scene);
  if (!amended) return tl::unexpected(amended.error());
  Result<Renderer> renderer = Renderer::create(std::move(*amended), *machine);
  if (!renderer) return tl::unexpected(renderer.error());
  return Subject{std::move(*renderer), loaded->view, loaded->settings, loaded->depth_light};
}

Result<Subject> SubjectOptions::prepare_scene(const Amend& amend) const {
  const Result<ViewOptions::Size> size = view.parse_size();
  if (!size) return tl::unexpected(size.error());
  Result<void> amending;
  Result<Renderer> renderer = scene.make_renderer([&](Scene& loaded) {
    if (!amend) return;
    Result<Scene> amended = amend(std::move(loaded));
    if (amended) {
      loaded = std::move(*amended);
    } else {
      amending = tl::unexpected(std::move(amended.error()));
    }
  });
  if (!amending) return tl::unexpected(std::move(amending.error()));
  if (!renderer) return tl::unexpected(renderer.error());
  const Result<View> from = view.find(*renderer, *size);
  if (!from) return tl::unexpected(from.error());
  RenderSettings settings;
  settings.width = size->width;
  settings.height = size->height;
  return Subject{std::move(*renderer), *from, settings, {}};
}

}  // namespace laterna::app
