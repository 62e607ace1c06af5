// laterna false-colour: a layer of an OpenEXR file in colours that can be read off.
#include <CLI/App.hpp>
#include <memory>

#include "false_color.h"
#include "laterna/false_color.h"
#include "outcome.h"

namespace laterna::app {
namespace {

struct Options {
  std::string input, output, channel = "lux.Y";
  FalseColorSettings settings;
  bool no_iso_lines = false;
};

int run_false_color(const Options& options) {
  if (const Result<void> writable = check_image_output(options.output); !writable)
    return report(writable.error());
  const Result<LayeredImage> image = read_layered_image(options.input);
  if (!image) return report(image.error());
  FalseColorSettings settings = options.settings;
  settings.iso_lines = !options.no_iso_lines;
  if (settings.unit.empty() && options.channel == "lux.Y") settings.unit = "lx";
  const Result<LayeredImage> picture = false_color_picture(*image, options.channel, settings);
  if (!picture) return report(picture.error());
  if (const Result<void> written = write_image(*picture, options.output); !written)
    return report(written.error());
  tell_scale(*picture, options.channel, settings.unit);
  return kOk;
}

}  // namespace

void declare_false_color(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App* command =
      app.add_subcommand("false-colour", "a channel of a picture, such as lux.Y, as colours with a scale");
  command->alias("false-color");
  command->add_option("PICTURE", o.input, "OpenEXR with layers, or any other picture")->required();
  command->add_option("-o,--output", o.output, "picture to write")->required();
  command->add_option("--channel", o.channel, "what is shown")->capture_default_str();
  command
      ->add_option("--max", o.settings.maximum,
                   "end of the scale; 0: a round number that nearly all stay below")
      ->capture_default_str();
  command->add_option("--unit", o.settings.unit, "written over the scale");
  command->add_flag("--no-iso-lines", o.no_iso_lines, "colours alone");
  command->footer(
      "\nExample:\n  laterna render room.glb --rig stage.json -o room.exr --layers lux\n"
      "  laterna false-colour room.exr -o lux.png --max 500\n");
  command->callback([options, &run] { run = [options] { return run_false_color(*options); }; });
}

}  // namespace laterna::app
