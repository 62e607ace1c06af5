#include "laterna/accuracy.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/refuse.h"
#include "base/without_exceptions.h"
#include "measure/mask_errors.h"

namespace laterna {
namespace {

using measure::LitPixels;
using measure::Mask;
using measure::PictureSurface;
using measure::ShadowRays;

constexpr int kMostSubpixels = 8;

// The share of the whole that a number of equal steps makes, as they are done.
class StepProgress {
 public:
  StepProgress(const Progress& progress, std::size_t steps) : progress_(progress), steps_(steps) {}
  [[nodiscard]] Progress of_this_step() const {
    if (!progress_) return {};
    return [this](double fraction) {
      return progress_((static_cast<double>(done_) + fraction) / static_cast<double>(steps_));
    };
  }
  // False: the caller asks to stop.
  bool advance() {
    ++done_;
    return !progress_ || progress_(static_cast<double>(done_) / static_cast<double>(steps_));
  }

 private:
  const Progress& progress_;
  std::size_t steps_, done_ = 0;
};

Error cancelled() { return {Failure::cancelled, Diagnostic{{}, {}, "cancelled"}}; }

struct Cost {
  double ms = 0, mb = 0;
};

// Measures one light after the other in a renderer of its own.
class Measurement {
 public:
  Measurement(Renderer renderer, const View& view, const AccuracySettings& settings, const Progress& progress)
      : renderer_(std::move(renderer)),
        view_(view),
        settings_(settings),
        grid_(settings.picture),
        pool_(renderer_.threads()),
        techniques_(settings.techniques) {
    if (techniques_.empty()) {
      for (const TechniqueDescription& t : list_techniques()) techniques_.push_back(t.technique);
    }
    grid_.width *= settings.subpixels;
    grid_.height *= settings.subpixels;
    grid_.samples = 1;
    const std::size_t per_light = 1 + techniques_.size() * static_cast<std::size_t>(settings.frames + 2);
    progress_.emplace(progress, settings.lights.size() * per_light);
  }

  Result<AccuracyReport> run() {
    Result<std::unique_ptr<const ShadowRays>> rays = ShadowRays::create(renderer_.scene(), pool_);
    if (!rays) return tl::unexpected(std::move(rays.error()));
    for (std::size_t i = 0; i < renderer_.scene().lights.size(); ++i) {
      if (Result<void> off = turn(static_cast<int>(i), false, ShadowTechnique::none); !off)
        return tl::unexpected(std::move(off.error()));
    }
    const Result<PictureSurface> surface = measure::draw_picture_surface(renderer_, view_, grid_);
    if (!surface) return tl::unexpected(surface.error());
    AccuracyReport report;
    report.width = surface->width;
    report.height = surface->height;
    for (const float facing : surface->facing) report.grey.push_back(std::max(facing, 0.0F));
    for (const std::string& light : settings_.lights) {
      if (Result<void> done = measure_light(light, *surface, **rays, report); !done)
        return tl::unexpected(std::move(done.error()));
    }
    return report;
  }

 private:
  Result<void> turn(int light, bool on, ShadowTechnique technique) {
    Light changed = renderer_.scene().lights[static_cast<std::size_t>(light)];
    changed.enabled = on;
    changed.shadow.technique = technique;
    if (technique != ShadowTechnique::map) changed.shadow.warp = ShadowWarp::none;  // maps alone have one
    return renderer_.set_light(light, std::move(changed));
  }

  Result<void> measure_light(const std::string& name, const PictureSurface& surface, const ShadowRays& rays,
                             AccuracyReport& report) {
    const Scene& scene = renderer_.scene();
    const int light = scene.nodes[static_cast<std::size_t>(find_light_node(scene, name))].light;
    Result<Mask> truth = draw_mask(light, name, ShadowTechnique::raytraced);
    if (!truth) return tl::unexpected(std::move(truth.error()));
    const Result<LitPixels> pixels = LitPixels::find(renderer_, surface, rays, name);
    if (!pixels) return tl::unexpected(pixels.error());
    if (!progress_->advance()) return tl::unexpected(cancelled());
    for (const ShadowTechnique technique : techniques_) {
      Result<ShadowAccuracy> measured = measure_technique(light, name, technique, *pixels, *truth);
      if (measured) {
        report.measured.push_back(std::move(*measured));
      } else if (measured.error().failure == Failure::cancelled) {
        return tl::unexpected(std::move(measured.error()));
      } else {
        report.skipped.push_back({technique, name, to_string(measured.error())});
      }
    }
    return turn(light, false, ShadowTechnique::none);
  }

  // Error with another failure than `cancelled`: the technique cannot serve the light.
  Result<ShadowAccuracy> measure_technique(int light, const std::string& name, ShadowTechnique technique,
                                           const LitPixels& pixels, const Mask& truth) {
    if (std::string fault = find_fault(technique, renderer_.scene().lights[static_cast<std::size_t>(light)]);
        !fault.empty()) {
      return refuse(std::move(fault));
    }
    const Result<Mask> mask = draw_mask(light, name, technique);
    if (!mask) return tl::unexpected(mask.error());
    if (!progress_->advance()) return tl::unexpected(cancelled());
    ShadowAccuracy found = measure::find_mask_errors(pixels, truth, *mask, settings_.subpixels, pool_);
    found.technique = technique;
    found.light = name;
    if (!settings_.keep_verdicts) found.verdicts = {};
    const Result<Cost> cost = measure_cost();
    if (!cost) return tl::unexpected(cost.error());
    found.ms = cost->ms;
    found.mb = cost->mb;
    return found;
  }

  Result<Mask> draw_mask(int light, const std::string& name, ShadowTechnique technique) {
    if (Result<void> on = turn(light, true, technique); !on) return tl::unexpected(std::move(on.error()));
    RenderSettings wanted = grid_;
    wanted.shadows = technique;
    wanted.layers = {Layer::visibility};
    Result<LayeredImage> drawn = renderer_.render(view_, wanted, progress_->of_this_step());
    if (!drawn) return tl::unexpected(std::move(drawn.error()));
    for (Channel& channel : drawn->channels) {
      if (channel.name == "visibility." + name) return std::move(channel.values);
    }
    return refuse("light \"" + name + "\" has no visibility layer");
  }

  // Of the light that is on, as it is now.
  Result<Cost> measure_cost() {
    RenderSettings wanted = settings_.picture;
    wanted.samples = 1;
    wanted.layers = {};
    wanted.keep_shadow_maps = false;
    Image image(wanted.width, wanted.height, 3, PixelType::u8, Transfer::srgb);
    RenderTarget target;
    target.color8 =
        ColorTarget8{image.values<std::uint8_t>().data(), 3, static_cast<std::size_t>(wanted.width) * 3, 1};
    std::vector<double> ms;
    Cost cost;
    for (int frame = 0; frame <= settings_.frames; ++frame) {
      const Result<RenderStatistics> drawn =
          renderer_.render_into(view_, wanted, target, progress_->of_this_step());
      if (!drawn) return tl::unexpected(drawn.error());
      if (!progress_->advance()) return tl::unexpected(cancelled());
      if (frame > 0) ms.push_back(shadow_cost_ms(*drawn));
      std::size_t bytes = 0;
      for (const RenderStatistics::LightMemory& memory : drawn->shadow_memory) bytes += memory.bytes;
      cost.mb = static_cast<double>(bytes) / (1U << 20U);
    }
    std::nth_element(ms.begin(), ms.begin() + static_cast<std::ptrdiff_t>(ms.size() / 2), ms.end());
    cost.ms = ms[ms.size() / 2];
    return cost;
  }

  Renderer renderer_;
  const View& view_;
  const AccuracySettings& settings_;
  RenderSettings grid_;
  TaskPool pool_;
  std::vector<ShadowTechnique> techniques_;
  std::optional<StepProgress> progress_;
};

Result<void> check(const AccuracySettings& settings) {
  if (settings.subpixels < 1 || settings.subpixels > kMostSubpixels)
    return refuse("subpixels must be 1 to 8, not " + std::to_string(settings.subpixels));
  if (settings.frames < 1) return refuse("at least one frame must be timed");
  if (settings.resolution < 0) return refuse("a shadow map's resolution cannot be negative");
  return {};
}

// The names asked for, or of all lights that are on.
Result<std::vector<std::string>> find_lights(const Scene& scene, const std::vector<std::string>& wanted) {
  std::vector<std::string> known;
  std::string listed;
  for (const Node& node : scene.nodes) {
    if (node.light < 0) continue;
    const Light& light = scene.lights[static_cast<std::size_t>(node.light)];
    if (!light.enabled || std::find(known.begin(), known.end(), light.name) != known.end()) continue;
    known.push_back(light.name);
    listed += (listed.empty() ? "\"" : ", \"") + light.name + "\"";
  }
  if (known.empty()) return refuse("the scene has no light whose shadows could be measured");
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      return refuse("the scene has no light \"" + name + "\" that is on: it has " + listed);
  }
  return wanted.empty() ? known : wanted;
}

Result<AccuracyReport> measure_all(const Renderer& renderer, const View& view, AccuracySettings settings,
                                   const Progress& progress) {
  if (Result<void> checked = check(settings); !checked) return tl::unexpected(std::move(checked.error()));
  Result<std::vector<std::string>> lights = find_lights(renderer.scene(), settings.lights);
  if (!lights) return tl::unexpected(std::move(lights.error()));
  settings.lights = std::move(*lights);
  Scene scene = renderer.scene();
  scene.warnings.clear();
  scene.clips.clear();        // it is posed as it is measured
  scene.environment.reset();  // shadows are of lights
  for (Light& light : scene.lights) {
    if (settings.resolution > 0) light.shadow.resolution = settings.resolution;
  }
  Result<Renderer> own =
      Renderer::create(std::move(scene), {renderer.threads(), renderer.instruction_set(), renderer.time()});
  if (!own) return tl::unexpected(std::move(own.error()));
  return Measurement(std::move(*own), view, settings, progress).run();
}

}  // namespace

double shadow_cost_ms(const RenderStatistics& statistics) {
  const double drawn = statistics.map_stages[Stage::raster];
  const double prepared = std::max(statistics.shadow_ms, statistics.map_stages.total() - drawn);
  return prepared + drawn + statistics.picture_stages[Stage::shadow];
}

Result<AccuracyReport> measure_accuracy(const Renderer& renderer, const View& view,
                                        const AccuracySettings& settings, const Progress& progress) {
  return without_exceptions(
      refuse("not enough memory to measure shadows: ask for a smaller picture or fewer subpixels").value(),
      [&] { return measure_all(renderer, view, settings, progress); });
}

}  // namespace laterna
