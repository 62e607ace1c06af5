#include "render_options.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <CLI/Validators.hpp>

#include "debug_picture.h"
#include "false_color.h"
#include "laterna/blend.h"
#include "laterna/light_color.h"
#include "laterna/mirrors.h"
#include "render_option_names.h"
#include "technique_names.h"

namespace laterna::app {
namespace {

void list_all_techniques() {
  for (const TechniqueDescription& t : list_techniques()) fmt::print("{:<12} {}\n", t.name, t.meaning);
}
void list_all_gels() {
  for (const Gel& gel : list_gels()) {
    const glm::vec3 passed = transmission(gel);
    fmt::print("{:<12} {:.3f} {:.3f} {:.3f}   {}\n", gel.name, passed.x, passed.y, passed.z, gel.meaning);
  }
}
void list_all_blend_modes() {
  fmt::print("{:<17} {:<27} {}\n", "", "c below, layer t, its alpha a", "");
  for (const BlendModeDescription& m : list_blend_modes())
    fmt::print("{:<17} {:<27} {} ({}){}\n", m.name, m.formula, m.meaning, m.known_as,
               find_light_fault(m.mode).empty() ? "" : "; of surfaces only");
}
void list_all_layers() {
  for (const LayerDescription& l : list_layers())
    fmt::print("{:<12} {:<36} {}\n", l.name, l.channels, l.meaning);
}

void declare_picture_options(CLI::App& command, RenderOptions& o) {
  command.add_option("--samples", o.samples, "samples per pixel: 1, 2, 4, 8 or 16")
      ->check(CLI::IsMember({1, 2, 4, 8, 16}))
      ->capture_default_str();
  command
      .add_option("--shadows", o.shadows,
                  "technique for lights that name none; those that it cannot serve keep map, which is said;\n"
                  "--list-techniques tells more")
      ->check(CLI::IsMember(technique_names()))
      ->capture_default_str();
  command
      .add_option(
          "--accumulate", o.accumulate,
          "the mean of so many pictures, which sample pixels at other places, are lit from other points\n"
          "of lights with a size, and through other points of projectors' lenses; best with --shadows exact")
      ->check(CLI::Range(1, kMaxAccumulated))
      ->capture_default_str();
  command.add_flag("--progressive", o.progressive,
                   "write the output after 1, 2, 4, 8, … accumulated pictures already");
  command
      .add_option("--noise", o.noise,
                  "stop averaging at this estimated noise, a fraction of the mean luminance; 0: never")
      ->check(CLI::Range(0.0, 0.999))
      ->capture_default_str();
  command
      .add_option("--shading", o.shading,
                  "papers: colour times light, nothing else; phong; pbr: as glTF defines it")
      ->check(CLI::IsMember(names_of(kShading)))
      ->capture_default_str();
  command
      .add_option("--passes", o.passes,
                  "multi: the papers' frame-buffer algorithms, literally; same picture, slower")
      ->check(CLI::IsMember(names_of(kPasses)))
      ->capture_default_str();
  command
      .add_option("--interpolation", o.interpolation, "affine: deliberately wrong, shows texture swimming")
      ->check(CLI::IsMember(names_of(kInterpolation)))
      ->capture_default_str();
  command
      .add_option("--anisotropy", o.anisotropy, "most probes along a stretched texture footprint, 1 to 16")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  command.add_option("--mirror-depth", o.mirror_depth, "how many mirrors are seen one in the other, 0 to 8")
      ->check(CLI::Range(0, kMaxMirrorDepth))
      ->capture_default_str();
}

void declare_lists(CLI::App& command) {
  command.add_flag_callback(
      "--list-techniques",
      [] {
        list_all_techniques();
        throw CLI::Success();
      },
      "print shadow techniques and end");
  command.add_flag_callback(
      "--list-layers",
      [] {
        list_all_layers();
        throw CLI::Success();
      },
      "print layers and end");
  command.add_flag_callback(
      "--list-blend-modes",
      [] {
        list_all_blend_modes();
        throw CLI::Success();
      },
      "print how layers of surfaces and projectors' light combine, and end");
  command.add_flag_callback(
      "--list-gels",
      [] {
        list_all_gels();
        throw CLI::Success();
      },
      "print gels that rigs know, with what they pass of R, G and B, and end");
}

}  // namespace

void RenderOptions::declare(CLI::App& command) {
  scene.declare_scene(command);
  command
      .add_option(
          "-o,--output", output,
          "picture to write: .png, .exr, .hdr or .pfm; - is PNG on standard output; with --frames also a\n"
          "film: .mp4, .mkv, .webm or .gif")
      ->required();
  view.declare(command);
  frames.declare(command);
  film.declare(command);
  command.add_flag(
      "--resume", resume,
      "of --frames: leave pictures that are there as they are; the last of them is drawn once more and\n"
      "compared, so that frames of other settings do not mix");
  command.add_flag("--turntable", turntable,
                   "the camera goes round the scene's middle once while --frames run; lights stay");
  declare_picture_options(command, *this);
  std::vector<std::string> layer_names = {"all"};
  for (const LayerDescription& layer : list_layers()) layer_names.emplace_back(layer.name);
  command.add_option("--layers", layers, "further channels of an .exr, by comma; --list-layers tells which")
      ->allow_extra_args(false)
      ->delimiter(',')
      ->check(CLI::IsMember(layer_names));
  command.add_option("--layer-pictures", layer_pictures, "folder for a PNG of each layer, beside the output");
  command
      .add_option("--exposure", exposure, "stops, or auto; for .png: other formats keep the light as it is")
      ->capture_default_str();
  command.add_option("--background", background, "R,G,B in linear light, or transparent (PNG with alpha)");
  command
      .add_option(
          "--depth", depth,
          "of the output: 8 or 16 bits (PNG), half or float (EXR; float by default with layers of lights)")
      ->check(CLI::IsMember(names_of(kDepth)))
      ->capture_default_str();
  command.add_option("--debug", debug, describe_debug_choices());
  command.add_option("--false-colour,--false-color", false_color, describe_false_color());
  scene.declare_machine(command);
  command.add_flag("--json", json, "print what it cost, to standard output");
  declare_lists(command);
}

}  // namespace laterna::app
