// laterna render: pictures of scenes.
#include <CLI/App.hpp>
#include <chrono>
#include <memory>

#include "outcome.h"
#include "picture_series.h"
#include "render_options.h"
#include "render_remarks.h"
#include "render_request.h"
#include "unserved_lights.h"

namespace laterna::app {
namespace {

int draw_pictures(const RenderOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const Result<RenderRequest> request = parse_request(options);
  if (!request) return report(request.error());
  const RenderSettings& settings = request->settings;
  const Result<std::vector<TimedOutput>> outputs = options.frames.outputs(options.scene.time, options.output);
  if (!outputs) return report(outputs.error());
  VideoOptions film;
  if (Result<void> writable = check_output(options, settings, *outputs, film); !writable)
    return report(writable.error());
  SceneOptions at_first = options.scene;
  at_first.time = outputs->front().seconds;
  Result<Renderer> renderer = at_first.make_renderer([&](Scene& scene) {
    if (request->background) scene.background = *request->background;
    if (scene.environment && !options.background.empty()) scene.environment->visible = false;
  });
  if (!renderer) return report(renderer.error());
  const Result<View> view = options.view.find(*renderer, {settings.width, settings.height});
  if (!view) return report(view.error());
  tell_unserved_lights(renderer->scene(), settings.shadows);
  tell_idle_projectors(*renderer);
  const std::chrono::duration<double, std::milli> load = std::chrono::steady_clock::now() - start;
  advise_luminance(*request);
  return PictureSeries(options, *request, *outputs, film).draw(*renderer, *view, load.count());
}

constexpr const char* kFooter =
    "\nWithout a light in SCENE or a rig, a default sun shines. Lights and cameras come from glTF\n"
    "(KHR_lights_punctual) or from a rig: JSON with \"cameras\" and \"lights\", a projector as\n"
    "  {\"name\": \"lantern\", \"type\": \"projector\", \"position\": [0,2,5], \"target\": [0,1,0],\n"
    "   \"yfov_deg\": 30, \"slide\": \"slide.png\", \"candela\": 50}\n"
    "\nExamples:\n"
    "  laterna render room.glb --rig stage.json -o room.png --size 1920x1080 --samples 4\n"
    "  laterna render room.glb --rig stage.json -o room.exr --layers light,lux,visibility\n"
    "  laterna render room.glb --rig stage.json --from-light lantern -o what-the-lantern-sees.png\n"
    "  laterna render room.glb --rig film.json --frames 0:47 --fps 24 -o film.####.png\n"
    "  laterna render room.glb --rig film.json --frames 0:47 --fps 24 -o film.mp4\n"
    "  laterna render room.glb -o - | display\n";

}  // namespace

void declare_render(CLI::App& app, Run& run) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      app.add_subcommand("render", "draw a picture of scenes lit by projectors, spotlights and suns");
  command->footer(kFooter);
  options->declare(*command);
  command->callback([options, &run] { run = [options] { return draw_pictures(*options); }; });
}

}  // namespace laterna::app
