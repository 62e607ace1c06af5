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
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "debug_picture.h"
#include "false_color.h"
#include "film_options.h"
#include "frame_range.h"
#include "interruption.h"
#include "laterna/blend.h"
#include "laterna/light_color.h"
#include "laterna/measure.h"
#include "laterna/mirrors.h"
#include "laterna/technique_choice.h"
#include "laterna/turntable.h"
#include "layer_pictures.h"
#include "outcome.h"
#include "progress_line.h"
#include "resumed_frames.h"
#include "scene_options.h"
#include "technique_names.h"
#include "unserved_lights.h"
#include "write_queue.h"

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
  names.reserve(map.size());
  for (const auto& [name, value] : map) names.push_back(name);
  return names;
}

struct RenderOptions {
  SceneOptions scene;
  ViewOptions view;
  FilmOptions film;
  FrameOptions frames;
  std::string output, layer_pictures;
  std::string shadows = "map", shading = "pbr", passes = "single", interpolation = "perspective",
              depth = "auto";
  std::string exposure = "0", background, debug, false_color;
  std::vector<std::string> layers;
  int samples = 1, anisotropy = 8, accumulate = 1, mirror_depth = 2;
  double noise = 0;
  bool progressive = false, resume = false, turntable = false, json = false;
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

nlohmann::json statistics_json(const RenderStatistics& s, double load_ms) {
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
  nlohmann::json told = {{"load_ms", load_ms},         {"plan_ms", s.plan_ms},
                         {"shadow_ms", s.shadow_ms},   {"bin_ms", s.bin_ms},
                         {"shade_ms", s.shade_ms},     {"render_ms", s.total_ms},
                         {"triangles", s.triangles},   {"triangles_drawn", s.triangles_drawn},
                         {"maps_drawn", s.maps_drawn}, {"maps_kept", s.maps_kept},
                         {"silhouettes", silhouettes}, {"shadow_memory", memory},
                         {"pictures", s.pictures},     {"noise", s.noise}};
  told["map_reuse"] = {{"maps_updated", s.map_reuse.maps_updated},
                       {"tiles_kept", s.map_reuse.tiles_kept},
                       {"tiles_updated", s.map_reuse.tiles_updated},
                       {"tiles_drawn", s.map_reuse.tiles_drawn},
                       {"triangles", s.map_reuse.triangles},
                       {"moving_triangles", s.map_reuse.moving_triangles},
                       {"bytes", s.map_reuse.bytes}};
  return told;
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
    const Result<double> shutter = options_.frames.shutter_seconds();
    if (!shutter) return report(shutter.error());
    shutter_ = *shutter;
    if (const std::string fault = find_output_fault(*settings); !fault.empty())
      return report(bad_option(fault));
    const Result<std::vector<TimedOutput>> outputs =
        options_.frames.outputs(options_.scene.time, options_.output);
    if (!outputs) return report(outputs.error());
    if (Result<void> writable = check_output(*settings, *outputs); !writable) return report(writable.error());
    SceneOptions at_first = options_.scene;
    at_first.time = outputs->front().seconds;
    Result<Renderer> renderer = at_first.make_renderer([&](Scene& scene) {
      if (*background) scene.background = *background;
      if (scene.environment && !options_.background.empty()) scene.environment->visible = false;
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
    if (options_.progressive && options_.frames.is_series())
      return "--progressive is for one picture: of a series, what is not finished would pass for a frame "
             "that is";
    if (options_.progressive && options_.output == "-")
      return "--progressive and -o - would write several pictures to standard output";
    if (options_.json && options_.output == "-") return "--json and -o - would both write to standard output";
    if (std::string fault = find_film_fault(settings); !fault.empty()) return fault;
    if (shutter_ > 0 && settings.accumulate == 1)
      return "--shutter needs --accumulate N: the picture is the mean of so many instants";
    if (shutter_ > 0 && !shows_light())
      return "--shutter is for pictures of light: leave --debug and --false-colour out";
    if (options_.turntable && !options_.frames.is_series())
      return "--turntable needs --frames, over which it turns";
    if (options_.turntable && !options_.view.from_light.empty())
      return "--turntable turns a camera: leave --from-light out";
    if (options_.frames.is_series() && !options_.layer_pictures.empty())
      return "--layer-pictures: with --frames, each frame's would replace the last one's; give an output "
             "that ends in .exr";
    if (!settings.layers.empty() && !keeps_layers(options_.output) && options_.layer_pictures.empty()) {
      return "--layers: only OpenEXR holds layers: give an output that ends in .exr, or --layer-pictures "
             "FOLDER";
    }
    return {};
  }

  // What films do not go with.
  [[nodiscard]] std::string find_film_fault(const RenderSettings& settings) const {
    if (options_.resume && (!options_.frames.is_series() || makes_film()))
      return "--resume goes on with numbered pictures: it needs --frames and an output such as out.####.png";
    if (!makes_film()) {
      return options_.film.are_given() ? "--codec and --quality are for films: give an output that ends in "
                                         ".mp4, .mkv, .webm or .gif"
                                       : "";
    }
    if (!options_.frames.is_series()) return "a film needs --frames FIRST:LAST";
    if (options_.background == "transparent") return "--background transparent: films are opaque";
    if (options_.depth != "auto" && options_.depth != "8") return "--depth: films have 8 bits";
    if (!settings.layers.empty())
      return "--layers: only OpenEXR holds layers: give numbered pictures, out.####.exr";
    return {};
  }

  [[nodiscard]] bool makes_film() const { return is_video_output(options_.output); }

  // Before what takes long.
  Result<void> check_output(const RenderSettings& settings, const std::vector<TimedOutput>& outputs) {
    if (!makes_film()) return check_image_output(outputs.front().file);
    const Result<VideoRate> rate = options_.frames.video_rate();
    if (!rate) return tl::unexpected(rate.error());
    film_options_ = options_.film.with(*rate, outputs.size());
    return check_video_output(options_.output, settings.width, settings.height, film_options_);
  }

  int draw_all(Renderer& renderer, const View& view, const RenderSettings& settings, float exposure,
               const std::vector<TimedOutput>& outputs) {
    settings_ = settings;
    threads_ = renderer.threads();
    exposure_ = exposure;
    const Renderer::Box box = renderer.bounds();
    turntable_centre_ws_ = 0.5 * (box.low_ws + box.high_ws);
    const bool is_series = options_.frames.is_series();
    const Interruption interruption(is_series);
    interruption_ = &interruption;
    if (makes_film()) {
      Result<VideoWriter> film =
          VideoWriter::create(options_.output, settings.width, settings.height, film_options_);
      if (!film) return report(film.error());
      film_ = std::move(*film);
    }
    std::vector<FrameReport> told(outputs.size());
    if (const Result<void> resumed = skip_finished(renderer, view, outputs, told); !resumed)
      return report(resumed.error());
    const Result<void> drawn = draw_frames(renderer, view, outputs, told);
    if (const int outcome = close(drawn, told); outcome != kOk) return outcome;
    if (!options_.json) return kOk;
    nlohmann::json pictures = nlohmann::json::array();
    for (FrameReport& frame : told) {
      if (!frame.is_skipped) frame.json["write_ms"] = frame.write_ms;
      pictures.push_back(std::move(frame.json));
    }
    fmt::print("{}\n", is_series ? pictures.dump(2) : pictures[0].dump(2));
    return kOk;
  }

  // What there is to tell of a frame in JSON, whose move the library does not declare free of exceptions.
  struct FrameReport {  // NOLINT(bugprone-exception-escape)
    nlohmann::json json;
    double write_ms = 0;
    bool is_skipped = false, is_drawn = false;
  };

  // Frames of --resume. The last of them is drawn once more, where others are to be added.
  Result<void> skip_finished(Renderer& renderer, const View& view, const std::vector<TimedOutput>& outputs,
                             std::vector<FrameReport>& told) {
    if (!options_.resume) return {};
    const std::vector<bool> is_finished = find_finished(outputs);
    const auto count = static_cast<std::size_t>(std::ranges::count(is_finished, true));
    std::size_t last = 0;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      if (!is_finished[i]) continue;
      last = i;
      told[i].is_skipped = true;
      told[i].json = {{"output", outputs[i].file}, {"time_s", outputs[i].seconds}, {"skipped", true}};
    }
    if (count > 0) {
      fmt::print(stderr, "laterna: note: {} of {} frames are there already\n", count, outputs.size());
    }
    if (count == 0 || count == outputs.size()) return {};
    return check_finished(outputs[last], [&](const std::filesystem::path& file) -> Result<void> {
      FrameReport ignored;
      Result<FinishedPicture> picture = draw(renderer, view, outputs, last, {}, ignored);
      if (!picture) return tl::unexpected(std::move(picture.error()));
      return write_picture(std::move(picture->image), file, picture->exposure);
    });
  }

  Result<void> draw_frames(Renderer& renderer, const View& view, const std::vector<TimedOutput>& outputs,
                           std::vector<FrameReport>& told) {
    WriteQueue queue([&](FinishedPicture picture) { return write(std::move(picture)); });
    const auto to_draw = static_cast<double>(std::ranges::count(told, false, &FrameReport::is_skipped));
    const Progress line = progress_line(
        options_.frames.is_series() ? fmt::format("rendering {} frames", to_draw) : std::string("rendering"));
    double done = 0;
    const Progress progress = [&](double fraction) {
      return (!line || line((done + fraction) / to_draw)) && interruption_->signal() == 0 &&
             !queue.has_failed();
    };
    Result<void> outcome;
    for (std::size_t i = 0; i < outputs.size() && outcome && interruption_->signal() == 0; ++i) {
      if (told[i].is_skipped) continue;
      Result<FinishedPicture> picture = draw(renderer, view, outputs, i, progress, told[i]);
      if (picture) {
        queue.add(std::move(*picture));
        told[i].is_drawn = true;
      } else {
        outcome = tl::unexpected(std::move(picture.error()));
      }
      ++done;
    }
    const Result<void> written = queue.finish();
    return written ? outcome : written;
  }

  // What a series leaves behind, however it ended.
  int close(const Result<void>& drawn, const std::vector<FrameReport>& told) {
    const auto missing =
        std::ranges::count_if(told, [](const FrameReport& f) { return !f.is_skipped && !f.is_drawn; });
    Result<void> outcome = drawn;
    if (film_ && drawn && missing == 0) outcome = film_->finish();
    if (outcome && missing == 0) return kOk;
    const int signal = interruption_->signal();
    if (!outcome && outcome.error().failure != Failure::cancelled) report(outcome.error());
    if (film_) keep_incomplete_film(told.size());
    if (signal == 0) return static_cast<int>(outcome.error().failure);
    if (!film_)
      fmt::print(stderr, "laterna: stopped; {} of {} frames are still to be drawn: --resume goes on\n",
                 missing, told.size());
    film_.reset();
    end_by_signal(signal);
  }

  void keep_incomplete_film(std::size_t frames) {
    const std::int64_t written = film_->frames();
    const Result<std::filesystem::path> kept = film_->keep_incomplete();
    if (kept) {
      fmt::print(stderr, "laterna: note: {} holds the film as far as it got: {} of {} frames were drawn\n",
                 kept->string(), written, frames);
    } else {
      report(kept.error());
    }
  }

  // A series as the camera goes through it.
  struct Course {
    View first;                         // view
    double first_time = 0;              // of its first frame
    double duration = 0;                // from the first frame to where the next after the last would be
    double frame_time = 0, turned = 0;  // of the frame that is drawn; how far it has come, 0 to 1
  };

  // The view at the renderer's time.
  [[nodiscard]] Result<View> view_now(const Renderer& renderer) const {
    if (renderer.time() == course_.first_time) return course_.first;
    const Result<View> view =
        options_.view.follow(renderer, {settings_.width, settings_.height}, course_.first);
    if (!view || !options_.turntable) return view;
    const double beside = (renderer.time() - course_.frame_time) / course_.duration;
    return turned_about(*view, turntable_centre_ws_, course_.turned + beside);
  }

  // Frame number `index`. `first`: the view of number 0. `told` gets what there is to tell in JSON, but for what writing costs.
  Result<FinishedPicture> draw(Renderer& renderer, const View& first, const std::vector<TimedOutput>& outputs,
                               std::size_t index, const Progress& progress, FrameReport& told) {
    const TimedOutput& output = outputs[index];
    const Result<int> changed = renderer.set_time(output.seconds);
    if (!changed) return tl::unexpected(changed.error());
    const auto count = static_cast<double>(outputs.size());
    const double first_time = outputs.front().seconds;
    const double duration = outputs.size() > 1 ? (outputs[1].seconds - first_time) * count
                                               : std::numeric_limits<double>::infinity();
    course_ = {first, first_time, duration, output.seconds, static_cast<double>(index) / count};
    const Result<View> view = view_now(renderer);
    if (!view) return tl::unexpected(view.error());
    output_ = output.file;
    float exposure = exposure_;
    RenderStatistics statistics;
    Result<LayeredImage> image = draw_image(renderer, *view, progress, statistics);
    if (!image) return tl::unexpected(std::move(image.error()));
    if (shows_light()) {
      const bool is_automatic = exposure == 0;
      if (is_automatic) exposure = automatic_exposure(*image);
      if (is_first_ && !keeps_layers(output_)) advise_exposure(*image, exposure, is_automatic);
    } else {
      exposure = 1;
    }
    is_first_ = false;
    if (options_.json) {
      told.json = statistics_json(statistics, load_ms_);
      told.json.update({{"output", output.file}, {"time_s", output.seconds}, {"films_changed", *changed}});
      told.json["size"] = {image->width, image->height};
      told.json["exposure"] = exposure;
    }
    return FinishedPicture{std::move(*image), output.file, exposure, &told.write_ms};
  }

  // Called by the thread that writes.
  Result<void> write(FinishedPicture picture) {
    if (film_) return film_->write(picture.image, picture.exposure, threads_);
    if (!options_.layer_pictures.empty()) {
      Result<void> written = write_layer_pictures(picture.image, options_.layer_pictures, picture.exposure);
      if (!written) return written;
    }
    return write_picture(std::move(picture.image), picture.file, picture.exposure);
  }

  Result<LayeredImage> draw_image(Renderer& renderer, const View& view, const Progress& progress,
                                  RenderStatistics& statistics) const {
    if (false_color_) return draw_false_color(renderer, view, settings_, *false_color_, statistics);
    if (!debug_) return draw_light(renderer, view, progress, statistics);
    Result<ExplainedPicture> shown = draw_debug_picture(renderer, view, settings_, *debug_, statistics);
    if (!shown) return tl::unexpected(std::move(shown.error()));
    for (const std::string& line : shown->legend) fmt::print(stderr, "laterna: {}\n", line);
    return std::move(shown->picture);
  }

  Result<LayeredImage> draw_light(Renderer& renderer, const View& view, const Progress& progress,
                                  RenderStatistics& statistics) const {
    Result<void> written;
    Preview preview;
    if (options_.progressive) {
      preview = [&](const PartialMean& mean) {
        if ((mean.pictures & (mean.pictures - 1)) != 0) return true;
        mean.write();
        written =
            write_picture(*mean.image, output_, exposure_ == 0 ? automatic_exposure(*mean.image) : exposure_);
        if (written) tell_noise(mean.pictures, mean.noise);
        return written.has_value();
      };
    }
    const Shutter shutter = {shutter_, [&](const Renderer& posed) { return view_now(posed); }};
    Result<LayeredImage> image =
        shutter_ > 0 ? renderer.render_exposed(view, settings_, shutter, progress, &statistics, preview)
                     : renderer.render(view, settings_, progress, &statistics, preview);
    if (!written) return tl::unexpected(written.error());
    if (!image || !is_first_) return image;
    if (settings_.accumulate == 1) {
      advise_softness(renderer.scene(), settings_.shadows);
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

  [[nodiscard]] WriteOptions write_options(const std::filesystem::path& file, float exposure) const {
    WriteOptions write;
    write.depth = kDepth.at(options_.depth);
    // In half precision the lights' layers would no longer add up to beauty.
    const bool has_light_layers = std::ranges::find(settings_.layers, Layer::light) != settings_.layers.end();
    if (has_light_layers && keeps_layers(file) && options_.depth == "auto")
      write.depth = WriteOptions::Depth::single;
    write.threads = threads_;
    write.exposure = exposure;
    return write;
  }

  // Formats for the screen hold neither layers nor, unless it was asked for, coverage.
  [[nodiscard]] Result<void> write_picture(LayeredImage image, const std::filesystem::path& file,
                                           float exposure) const {
    if (shows_light() && !keeps_layers(file))
      image.channels.resize(options_.background == "transparent" ? 4 : 3);
    return write_image(image, file, write_options(file, exposure));
  }

  const RenderOptions& options_;
  std::optional<DebugChoice> debug_;
  std::optional<FalseColorChoice> false_color_;
  RenderSettings settings_;
  VideoOptions film_options_;
  std::optional<VideoWriter> film_;  // used by the thread that writes, while there is one
  const Interruption* interruption_ = nullptr;
  std::string output_;  // of the picture that is drawn
  float exposure_ = 1;  // 0: automatic
  int threads_ = 0;
  double load_ms_ = 0;
  glm::dvec3 turntable_centre_ws_{0};  // of the scene as it is in the first picture
  double shutter_ = 0;                 // seconds
  Course course_;
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
    "  laterna render room.glb --rig film.json --frames 0:47 --fps 24 -o film.mp4\n"
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
  command.add_option("--mirror-depth", o.mirror_depth, "how many mirrors are seen one in the other, 0 to 8")
      ->check(CLI::Range(0, kMaxMirrorDepth))
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
      ->add_option(
          "-o,--output", o.output,
          "picture to write: .png, .exr, .hdr or .pfm; - is PNG on standard output; with --frames also a\n"
          "film: .mp4, .mkv, .webm or .gif")
      ->required();
  o.view.declare(*command);
  o.frames.declare(*command);
  o.film.declare(*command);
  command->add_flag(
      "--resume", o.resume,
      "of --frames: leave pictures that are there as they are; the last of them is drawn once more and\n"
      "compared, so that frames of other settings do not mix");
  command->add_flag("--turntable", o.turntable,
                    "the camera goes round the scene's middle once while --frames run; lights stay");
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
      "--list-blend-modes",
      [] {
        list_all_blend_modes();
        throw CLI::Success();
      },
      "print how layers of surfaces and projectors' light combine, and end");
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
