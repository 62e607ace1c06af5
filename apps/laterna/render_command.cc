// laterna render: pictures of scenes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "debug_picture.h"
#include "false_color.h"
#include "frame_range.h"
#include "laterna/light_color.h"
#include "laterna/measure.h"
#include "laterna/technique_choice.h"
#include "layer_pictures.h"
#include "outcome.h"
#include "progress_line.h"
#include "scene_options.h"
#include "technique_names.h"
#include "unserved_lights.h"

namespace laterna::app {
namespace {

const std::map<std::string, ShadingModel> kShading = {
    {"papers", ShadingModel::papers}, {"phong", ShadingModel::phong}, {"pbr", ShadingModel::pbr}};
const std::map<std::string, Passes> kPasses = {{"single", Passes::single}, {"multi", Passes::multi}};
const std::map<std::string, Interpolation> kInterpolation = {{"perspective", Interpolation::perspective},
                                                             {"affine", Interpolation::affine}};
const std::map<std::string, WriteOptions::Depth> kDepth = {{"auto", WriteOptions::Depth::automatic},
                                                           {"8", WriteOptions::Depth::bits8},
                                                           {"16", WriteOptions::Depth::bits16},
                                                           {"half", WriteOptions::Depth::half},
                                                           {"float", WriteOptions::Depth::single}};

template <class Value>
std::vector<std::string> names_of(const std::map<std::string, Value>& map) {
  std::vector<std::string> names;
  for (const auto& [name, value] : map) names.push_back(name);
  return names;
}

struct RenderOptions {
  SceneOptions scene;
  ViewOptions view;
  FrameOptions frames;
  std::string output, layer_pictures;
  std::string shadows = "map", shading = "pbr", passes = "single", interpolation = "perspective",
              depth = "auto";
  std::string exposure = "0", background, debug, false_color;
  std::vector<std::string> layers;
  int samples = 1, anisotropy = 8, accumulate = 1;
  double noise = 0;
  bool progressive = false, json = false;
};

void list_all_techniques() {
  for (const TechniqueDescription& t : list_techniques()) fmt::print("{:<12} {}\n", t.name, t.meaning);
}
void list_all_gels() {
  for (const Gel& gel : list_gels()) {
    const glm::vec3 passed = transmission(gel);
    fmt::print("{:<12} {:.3f} {:.3f} {:.3f}   {}\n", gel.name, passed.x, passed.y, passed.z, gel.meaning);
  }
}
void list_all_layers() {
  for (const LayerDescription& l : list_layers())
    fmt::print("{:<12} {:<36} {}\n", l.name, l.channels, l.meaning);
}

Result<RenderSettings> parse_settings(const RenderOptions& options) {
  RenderSettings settings;
  const Result<ViewOptions::Size> size = options.view.parse_size();
  if (!size) return tl::unexpected(size.error());
  settings.width = size->width;
  settings.height = size->height;
  settings.samples = options.samples;
  settings.anisotropy = options.anisotropy;
  settings.accumulate = options.accumulate;
  settings.noise = options.noise;
  settings.shading = kShading.at(options.shading);
  settings.passes = kPasses.at(options.passes);
  settings.interpolation = kInterpolation.at(options.interpolation);
  for (const TechniqueDescription& t : list_techniques()) {
    if (t.name == options.shadows) settings.shadows = t.technique;
  }
  for (const std::string& name : options.layers) {
    for (const LayerDescription& layer : list_layers()) {
      const bool is_there = layer.layer != Layer::passes || settings.passes == Passes::multi;
      if (name == layer.name || (name == "all" && is_there)) settings.layers.push_back(layer.layer);
    }
  }
  return settings;
}

/// The colour behind the scene, where one was given.
Result<std::optional<glm::vec3>> parse_background(const std::string& text) {
  if (text.empty() || text == "transparent") return std::nullopt;
  float c[3];
  char rest = 0;
  if (std::sscanf(text.c_str(), "%f,%f,%f%c", &c[0], &c[1], &c[2], &rest) != 3 ||
      !std::all_of(c, c + 3, [](float v) { return v >= 0 && std::isfinite(v); })) {
    return tl::unexpected(bad_option(
        fmt::format("--background: expected \"transparent\" or R,G,B in linear light, got \"{}\"", text)));
  }
  return glm::vec3(c[0], c[1], c[2]);
}

/// A factor; 0 stands for "auto".
Result<float> parse_exposure(const std::string& text) {
  if (text == "auto") return 0.0F;
  char* end = nullptr;
  const double stops = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != 0 || !(std::abs(stops) <= 60)) {
    return tl::unexpected(
        bad_option(fmt::format("--exposure: expected stops from -60 to 60, or \"auto\", got \"{}\"", text)));
  }
  return exposure_from_stops(stops);
}

/// Keeps users from wondering at white or black pictures.
void advise_exposure(const LayeredImage& image, float exposure, bool is_automatic) {
  std::size_t seen = 0;
  std::size_t white = 0;
  std::size_t dark = 0;
  const std::vector<float>& alpha = image.find("A")->values;
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    if (alpha[i] <= 0) continue;
    const float brightest = exposure * std::max({image.channels[0].values[i], image.channels[1].values[i],
                                                 image.channels[2].values[i]});
    ++seen;
    white += brightest >= 1 ? 1U : 0U;
    dark += brightest < 0.002F ? 1U : 0U;
  }
  if (seen == 0) fmt::print(stderr, "laterna: note: nothing of the scene is in the picture\n");
  if (2 * white > seen)
    fmt::print(stderr, "laterna: note: more than half of the picture is over-exposed: try --exposure auto\n");
  if (seen > 0 && 10 * dark > 9 * seen) {
    fmt::print(
        stderr,
        "laterna: note: nearly all of the picture is black: try {}--from-light NAME, which shows what a "
        "lamp's light falls on; films may be dark at this --time\n",
        is_automatic ? "" : "--exposure auto, or ");
  }
}

nlohmann::json statistics_json(const RenderStatistics& s, double load_ms, double write_ms) {
  nlohmann::json memory = nlohmann::json::array();
  for (const auto& light : s.shadow_memory) {
    memory.push_back({{"light", light.light}, {"maps", light.maps}, {"bytes", light.bytes}});
  }
  nlohmann::json silhouettes = nlohmann::json::array();
  for (const auto& light : s.silhouettes) {
    silhouettes.push_back({{"light", light.light},
                           {"objects", light.objects},
                           {"pairs", light.pairs},
                           {"silhouettes", light.silhouettes},
                           {"silhouettes_drawn", light.silhouettes_drawn}});
  }
  return {{"load_ms", load_ms},         {"plan_ms", s.plan_ms},     {"shadow_ms", s.shadow_ms},
          {"bin_ms", s.bin_ms},         {"shade_ms", s.shade_ms},   {"render_ms", s.total_ms},
          {"write_ms", write_ms},       {"triangles", s.triangles}, {"triangles_drawn", s.triangles_drawn},
          {"maps_drawn", s.maps_drawn}, {"maps_kept", s.maps_kept}, {"silhouettes", silhouettes},
          {"shadow_memory", memory},    {"pictures", s.pictures},   {"noise", s.noise}};
}

/// A lamp with a size and a lens that is open throw soft shadows, but most techniques see their middle alone.
void advise_softness(const Scene& scene, ShadowTechnique for_all) {
  for (const Light& light : scene.lights) {
    const ShadowTechnique technique = technique_for(light, for_all);
    const bool is_hard = technique != ShadowTechnique::pcss && technique != ShadowTechnique::none;
    const bool is_wide = light.source.has_size() || light.aperture.radius > 0;
    if (!light.enabled || !is_wide || !is_hard) continue;
    fmt::print(stderr,
               "laterna: note: light \"{}\" has {}, but its shadows are hard: try --shadows exact "
               "--accumulate 64, or --shadows pcss, which is a guess\n",
               light.name, light.source.has_size() ? "a size" : "an aperture");
  }
}

/// A projector that is aimed past everything is seldom meant.
void tell_idle_projectors(const Renderer& renderer) {
  for (const std::string& name : renderer.idle_projectors()) {
    fmt::print(stderr,
               "laterna: note: the light of projector \"{}\" meets nothing: laterna inspect --light tells "
               "where it points\n",
               name);
  }
}

/// Only one model's numbers are candela per square metre.
void advise_luminance(const RenderSettings& settings, const std::optional<FalseColorChoice>& false_color) {
  const bool is_shown = std::ranges::find(settings.layers, Layer::luminance) != settings.layers.end() ||
                        (false_color && false_color->layer == Layer::luminance);
  if (!is_shown || settings.shading == ShadingModel::pbr) return;
  fmt::print(
      stderr,
      "laterna: note: luminance is in cd/m² only with --shading pbr: in this model a white matt surface "
      "under 1 lx is 1\n");
}

class RenderCommand {
 public:
  explicit RenderCommand(const RenderOptions& options) : options_(options) {}

  int run() {
    const auto start = std::chrono::steady_clock::now();
    const Result<RenderSettings> settings = parse_settings(options_);
    if (!settings) return report(settings.error());
    const Result<float> exposure = parse_exposure(options_.exposure);
    if (!exposure) return report(exposure.error());
    const Result<std::optional<glm::vec3>> background = parse_background(options_.background);
    if (!background) return report(background.error());
    if (!options_.debug.empty()) {
      Result<DebugChoice> debug = parse_debug_choice(options_.debug);
      if (!debug) return report(debug.error());
      debug_ = std::move(*debug);
    }
    if (!options_.false_color.empty()) {
      Result<FalseColorChoice> choice = parse_false_color(options_.false_color);
      if (!choice) return report(choice.error());
      false_color_ = std::move(*choice);
    }
    if (const std::string fault = find_output_fault(*settings); !fault.empty())
      return report(bad_option(fault));
    const Result<std::vector<TimedOutput>> outputs =
        options_.frames.outputs(options_.scene.time, options_.output);
    if (!outputs) return report(outputs.error());
    if (Result<void> writable = check_image_output(outputs->front().file); !writable)
      return report(writable.error());
    SceneOptions at_first = options_.scene;
    at_first.time = outputs->front().seconds;
    Result<Renderer> renderer = at_first.make_renderer([&](Scene& scene) {
      if (*background) scene.background = *background;
    });
    if (!renderer) return report(renderer.error());
    const Result<View> view = options_.view.find(*renderer, {settings->width, settings->height});
    if (!view) return report(view.error());
    tell_unserved_lights(renderer->scene(), settings->shadows);
    tell_idle_projectors(*renderer);
    load_ms_ = elapsed(start);
    advise_luminance(*settings, false_color_);
    return draw_all(*renderer, *view, *settings, *exposure, *outputs);
  }

 private:
  static double elapsed(std::chrono::steady_clock::time_point since) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - since).count();
  }

  [[nodiscard]] std::string find_output_fault(const RenderSettings& settings) const {
    const bool has_passes = std::ranges::find(settings.layers, Layer::passes) != settings.layers.end();
    if (has_passes && settings.passes != Passes::multi) return "--layers passes needs --passes multi";
    if (false_color_ && (debug_ || !options_.layers.empty() || !options_.layer_pictures.empty()))
      return "--false-colour takes the picture's place: leave --debug, --layers and --layer-pictures out";
    if (options_.progressive && !shows_light())
      return "--progressive is for pictures of light: leave --debug and --false-colour out";
    if (options_.progressive && options_.output == "-")
      return "--progressive and -o - would write several pictures to standard output";
    if (options_.json && options_.output == "-") return "--json and -o - would both write to standard output";
    if (options_.frames.is_series() && !options_.layer_pictures.empty())
      return "--layer-pictures: with --frames, each frame's would replace the last one's; give an output "
             "that ends in .exr";
    if (!settings.layers.empty() && !keeps_layers(options_.output) && options_.layer_pictures.empty()) {
      return "--layers: only OpenEXR holds layers: give an output that ends in .exr, or --layer-pictures "
             "FOLDER";
    }
    return {};
  }

  int draw_all(Renderer& renderer, const View& view, const RenderSettings& settings, float exposure,
               const std::vector<TimedOutput>& outputs) {
    nlohmann::json pictures = nlohmann::json::array();
    for (const TimedOutput& output : outputs) {
      const Result<int> changed = renderer.set_time(output.seconds);
      if (!changed) return report(changed.error());
      is_first_ = &output == &outputs.front();
      nlohmann::json picture = {
          {"output", output.file}, {"time_s", output.seconds}, {"films_changed", *changed}};
      if (const int outcome = draw(renderer, view, settings, exposure, picture); outcome != kOk)
        return outcome;
      if (options_.json) pictures.push_back(std::move(picture));
    }
    if (!options_.json) return kOk;
    fmt::print("{}\n", options_.frames.is_series() ? pictures.dump(2) : pictures[0].dump(2));
    return kOk;
  }

  // `told`: what there is to tell in JSON, with the "output" to write.
  int draw(const Renderer& renderer, const View& view, const RenderSettings& settings, float exposure,
           nlohmann::json& told) {
    output_ = told.at("output").get<std::string>();
    RenderStatistics statistics;
    settings_ = settings;
    threads_ = renderer.threads();
    Result<LayeredImage> image = draw_image(renderer, view, settings, exposure, statistics);
    if (!image) return report(image.error());
    if (shows_light()) {
      const bool is_automatic = exposure == 0;
      if (is_automatic) exposure = automatic_exposure(*image);
      if (is_first_ && !keeps_layers(output_)) advise_exposure(*image, exposure, is_automatic);
    } else {
      exposure = 1;
    }
    const auto write_start = std::chrono::steady_clock::now();
    if (!options_.layer_pictures.empty()) {
      const Result<void> written = write_layer_pictures(*image, options_.layer_pictures, exposure);
      if (!written) return report(written.error());
    }
    const int width = image->width, height = image->height;
    if (Result<void> written = write_picture(std::move(*image), exposure); !written)
      return report(written.error());
    if (!options_.json) return kOk;
    told.update(statistics_json(statistics, load_ms_, elapsed(write_start)));
    told["size"] = {width, height};
    told["exposure"] = exposure;
    return kOk;
  }

  Result<LayeredImage> draw_image(const Renderer& renderer, const View& view, const RenderSettings& settings,
                                  float exposure, RenderStatistics& statistics) const {
    if (false_color_) return draw_false_color(renderer, view, settings, *false_color_, statistics);
    if (!debug_) return draw_light(renderer, view, settings, exposure, statistics);
    Result<ExplainedPicture> shown = draw_debug_picture(renderer, view, settings, *debug_, statistics);
    if (!shown) return tl::unexpected(std::move(shown.error()));
    for (const std::string& line : shown->legend) fmt::print(stderr, "laterna: {}\n", line);
    return std::move(shown->picture);
  }

  Result<LayeredImage> draw_light(const Renderer& renderer, const View& view, const RenderSettings& settings,
                                  float exposure, RenderStatistics& statistics) const {
    Result<void> written;
    Preview preview;
    if (options_.progressive) {
      preview = [&](const PartialMean& mean) {
        if ((mean.pictures & (mean.pictures - 1)) != 0) return true;
        mean.write();
        written = write_picture(*mean.image, exposure == 0 ? automatic_exposure(*mean.image) : exposure);
        if (written) tell_noise(mean.pictures, mean.noise);
        return written.has_value();
      };
    }
    Result<LayeredImage> image =
        renderer.render(view, settings, progress_line("rendering"), &statistics, preview);
    if (!written) return tl::unexpected(written.error());
    if (!image || !is_first_) return image;
    if (settings.accumulate == 1) {
      advise_softness(renderer.scene(), settings.shadows);
    } else {
      tell_noise(statistics.pictures, statistics.noise);
    }
    return image;
  }

  // Rather than explaining it.
  [[nodiscard]] bool shows_light() const { return !debug_ && !false_color_; }

  static void tell_noise(int pictures, double noise) {
    fmt::print(stderr, "laterna: mean of {} pictures, estimated noise {:.2g} % of the mean luminance\n",
               pictures, 100 * noise);
  }

  [[nodiscard]] WriteOptions write_options(float exposure) const {
    WriteOptions write;
    write.depth = kDepth.at(options_.depth);
    // In half precision the lights' layers would no longer add up to beauty.
    const bool has_light_layers = std::ranges::find(settings_.layers, Layer::light) != settings_.layers.end();
    if (has_light_layers && keeps_layers(output_) && options_.depth == "auto")
      write.depth = WriteOptions::Depth::single;
    write.threads = threads_;
    write.exposure = exposure;
    return write;
  }

  // Formats for the screen hold neither layers nor, unless it was asked for, coverage.
  [[nodiscard]] Result<void> write_picture(LayeredImage image, float exposure) const {
    if (shows_light() && !keeps_layers(output_))
      image.channels.resize(options_.background == "transparent" ? 4 : 3);
    return write_image(image, output_, write_options(exposure));
  }

  const RenderOptions& options_;
  std::optional<DebugChoice> debug_;
  std::optional<FalseColorChoice> false_color_;
  RenderSettings settings_;
  std::string output_;
  int threads_ = 0;
  double load_ms_ = 0;
  bool is_first_ = true;  // picture of a series: what there is to remark is remarked once
};

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
    "  laterna render room.glb -o - | display\n";

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
}

}  // namespace

void declare_render(CLI::App& app, Run& run) {
  auto options = std::make_shared<RenderOptions>();
  RenderOptions& o = *options;
  CLI::App* command =
      app.add_subcommand("render", "draw a picture of scenes lit by projectors, spotlights and suns");
  command->footer(kFooter);
  o.scene.declare_scene(*command);
  command
      ->add_option("-o,--output", o.output,
                   "picture to write: .png, .exr, .hdr or .pfm; - is PNG on standard output")
      ->required();
  o.view.declare(*command);
  o.frames.declare(*command);
  declare_picture_options(*command, o);
  std::vector<std::string> layers = {"all"};
  for (const LayerDescription& layer : list_layers()) layers.emplace_back(layer.name);
  command
      ->add_option("--layers", o.layers, "further channels of an .exr, by comma; --list-layers tells which")
      ->allow_extra_args(false)
      ->delimiter(',')
      ->check(CLI::IsMember(layers));
  command->add_option("--layer-pictures", o.layer_pictures,
                      "folder for a PNG of each layer, beside the output");
  command
      ->add_option("--exposure", o.exposure,
                   "stops, or auto; for .png: other formats keep the light as it is")
      ->capture_default_str();
  command->add_option("--background", o.background, "R,G,B in linear light, or transparent (PNG with alpha)");
  command
      ->add_option(
          "--depth", o.depth,
          "of the output: 8 or 16 bits (PNG), half or float (EXR; float by default with layers of lights)")
      ->check(CLI::IsMember(names_of(kDepth)))
      ->capture_default_str();
  command->add_option("--debug", o.debug, describe_debug_choices());
  command->add_option("--false-colour,--false-color", o.false_color, describe_false_color());
  o.scene.declare_machine(*command);
  command->add_flag("--json", o.json, "print what it cost, to standard output");
  command->add_flag_callback(
      "--list-techniques",
      [] {
        list_all_techniques();
        throw CLI::Success();
      },
      "print shadow techniques and end");
  command->add_flag_callback(
      "--list-layers",
      [] {
        list_all_layers();
        throw CLI::Success();
      },
      "print layers and end");
  command->add_flag_callback(
      "--list-gels",
      [] {
        list_all_gels();
        throw CLI::Success();
      },
      "print gels that rigs know, with what they pass of R, G and B, and end");
  command->callback([options, &run] { run = [options] { return RenderCommand(*options).run(); }; });
}

}  // namespace laterna::app
