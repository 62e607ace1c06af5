#include "render_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "laterna/measure.h"
#include "outcome.h"
#include "render_option_names.h"

namespace laterna::app {
namespace {

Result<RenderSettings> parse_settings(const RenderOptions& options) {
  RenderSettings settings;
  const Result<ViewOptions::Size> size = options.view.parse_size();
  if (!size) return tl::unexpected(size.error());
  settings.width = size->width;
  settings.height = size->height;
  settings.samples = options.samples;
  settings.anisotropy = options.anisotropy;
  settings.accumulate = options.accumulate;
  settings.mirror_depth = options.mirror_depth;
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

// What films do not go with.
std::string find_film_fault(const RenderOptions& options, const RenderSettings& settings) {
  if (options.resume && (!options.frames.is_series() || options.makes_film()))
    return "--resume goes on with numbered pictures: it needs --frames and an output such as out.####.png";
  if (!options.makes_film()) {
    return options.film.are_given() ? "--codec and --quality are for films: give an output that ends in "
                                      ".mp4, .mkv, .webm or .gif"
                                    : "";
  }
  if (!options.frames.is_series()) return "a film needs --frames FIRST:LAST";
  if (options.background == "transparent") return "--background transparent: films are opaque";
  if (options.depth != "auto" && options.depth != "8") return "--depth: films have 8 bits";
  if (!settings.layers.empty())
    return "--layers: only OpenEXR holds layers: give numbered pictures, out.####.exr";
  return {};
}

std::string find_output_fault(const RenderOptions& options, const RenderRequest& request) {
  const RenderSettings& settings = request.settings;
  const bool has_passes = std::ranges::find(settings.layers, Layer::passes) != settings.layers.end();
  if (has_passes && settings.passes != Passes::multi) return "--layers passes needs --passes multi";
  if (request.false_color && (request.debug || !options.layers.empty() || !options.layer_pictures.empty()))
    return "--false-colour takes the picture's place: leave --debug, --layers and --layer-pictures out";
  if (options.progressive && !request.shows_light())
    return "--progressive is for pictures of light: leave --debug and --false-colour out";
  if (options.progressive && options.frames.is_series())
    return "--progressive is for one picture: of a series, what is not finished would pass for a frame "
           "that is";
  if (options.progressive && options.output == "-")
    return "--progressive and -o - would write several pictures to standard output";
  if (options.json && options.output == "-") return "--json and -o - would both write to standard output";
  if (std::string fault = find_film_fault(options, request.settings); !fault.empty()) return fault;
  if (settings.noise > 0 && settings.accumulate == 1)
    return "--noise needs --accumulate N: averaging stops at that noise, and at N pictures at the latest";
  if (request.shutter > 0 && settings.accumulate == 1)
    return "--shutter needs --accumulate N: the picture is the mean of so many instants";
  if (request.shutter > 0 && !request.shows_light())
    return "--shutter is for pictures of light: leave --debug and --false-colour out";
  if (options.turntable && !options.frames.is_series())
    return "--turntable needs --frames, over which it turns";
  if (options.turntable && !options.view.from_light.empty())
    return "--turntable turns a camera: leave --from-light out";
  if (options.frames.is_series() && !options.layer_pictures.empty())
    return "--layer-pictures: with --frames, each frame's would replace the last one's; give an output "
           "that ends in .exr";
  if (!settings.layers.empty() && !keeps_layers(options.output) && options.layer_pictures.empty()) {
    return "--layers: only OpenEXR holds layers: give an output that ends in .exr, or --layer-pictures "
           "FOLDER";
  }
  return {};
}

}  // namespace

Result<RenderRequest> parse_request(const RenderOptions& options) {
  RenderRequest request;
  Result<RenderSettings> settings = parse_settings(options);
  if (!settings) return tl::unexpected(settings.error());
  request.settings = std::move(*settings);
  const Result<float> exposure = parse_exposure(options.exposure);
  if (!exposure) return tl::unexpected(exposure.error());
  request.exposure = *exposure;
  const Result<std::optional<glm::vec3>> background = parse_background(options.background);
  if (!background) return tl::unexpected(background.error());
  request.background = *background;
  if (!options.debug.empty()) {
    Result<DebugChoice> debug = parse_debug_choice(options.debug);
    if (!debug) return tl::unexpected(debug.error());
    request.debug = std::move(*debug);
  }
  if (!options.false_color.empty()) {
    Result<FalseColorChoice> choice = parse_false_color(options.false_color);
    if (!choice) return tl::unexpected(choice.error());
    request.false_color = std::move(*choice);
  }
  const Result<double> shutter = options.frames.shutter_seconds();
  if (!shutter) return tl::unexpected(shutter.error());
  request.shutter = *shutter;
  if (std::string fault = find_output_fault(options, request); !fault.empty())
    return tl::unexpected(bad_option(std::move(fault)));
  return request;
}

Result<void> check_output(const RenderOptions& options, const RenderSettings& settings,
                          const std::vector<TimedOutput>& outputs, VideoOptions& film) {
  if (!options.makes_film()) return check_image_output(outputs.front().file);
  const Result<VideoRate> rate = options.frames.video_rate();
  if (!rate) return tl::unexpected(rate.error());
  film = options.film.with(*rate, outputs.size());
  return check_video_output(options.output, settings.width, settings.height, film);
}

}  // namespace laterna::app
