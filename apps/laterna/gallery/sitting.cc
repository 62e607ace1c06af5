#include "sitting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "laterna/accuracy.h"
#include "laterna/false_color.h"
#include "laterna/measure.h"
#include "laterna/polar_plot.h"

namespace laterna::app {
namespace {

bool is_offered(ShadowTechnique technique) {
  return std::ranges::any_of(list_techniques(), [&](const auto& t) { return t.technique == technique; });
}

/// The part of a picture between two corners, in pixels.
LayeredImage cut_out(const LayeredImage& image, int left, int top, int width, int height) {
  LayeredImage part;
  part.width = width;
  part.height = height;
  for (const Channel& channel : image.channels) {
    Channel& cut = part.channels.emplace_back();
    cut.name = channel.name;
    for (int y = top; y < top + height; ++y) {
      const auto row = channel.values.begin() + static_cast<std::ptrdiff_t>(y) * image.width + left;
      cut.values.insert(cut.values.end(), row, row + width);
    }
  }
  return part;
}

/// The picture, multiplied by a layer where the scene is.
Result<LayeredImage> multiplied(LayeredImage image, const LayeredImage& factor, const std::string& name) {
  const Channel* share = factor.find(name);
  const Channel* depth = factor.find("Z");
  if (share == nullptr || depth == nullptr)
    return tl::unexpected(Error(Failure::bad_input, Diagnostic{{}, {}, "there is no layer " + name}));
  for (Channel& channel : image.channels) {
    for (std::size_t i = 0; i < channel.values.size(); ++i)
      if (std::isfinite(depth->values[i])) channel.values[i] *= share->values[i];
  }
  return image;
}

std::string sentence_about(const TechniqueDescription& technique, const AccuracyReport& report) {
  const std::string begin = fmt::format("{}: {}.", technique.name, technique.meaning);
  for (const ShadowAccuracy& m : report.measured) {
    if (m.technique != technique.technique) continue;
    return fmt::format(
        "{} False light {:.3g} % of the pixels that the light may reach, false shadow {:.3g} %, acne {:.3g} "
        "%, edges {:.2f} "
        "pixels off on average. Its shadows take {:.1f} ms and {:.1f} MB.",
        begin, 100 * m.false_lit, 100 * m.false_dark, 100 * m.acne, m.edge_px_mean, m.ms, m.mb);
  }
  return begin;
}

}  // namespace

Shot::Shot() {
  settings.width = 640;
  settings.height = 480;
  settings.samples = 4;
  settings.shading = ShadingModel::phong;
}

Shot Shot::with(ShadowTechnique technique) const {
  Shot shot = *this;
  shot.settings.shadows = technique;
  return shot;
}

Result<Drawing> Sitting::set_up(const Shot& shot) const {
  Result<Renderer> renderer = Renderer::create(shot.scene, darkroom_.renderer);
  if (!renderer) return tl::unexpected(renderer.error());
  const Result<Pose> pose = Pose::look_at(shot.camera.from, shot.camera.to, {0, 1, 0});
  if (!pose) return tl::unexpected(pose.error());
  RenderSettings settings = shot.settings;
  settings.width = std::max(1, static_cast<int>(std::lround(darkroom_.scale * settings.width)));
  settings.height = std::max(1, static_cast<int>(std::lround(darkroom_.scale * settings.height)));
  const double aspect = static_cast<double>(settings.width) / settings.height;
  const Projection projection =
      Projection::perspective(shot.yfov, aspect, 0.05, std::numeric_limits<double>::infinity());
  return Drawing{std::move(*renderer), View{*pose, projection}, std::move(settings)};
}

Result<LayeredImage> Sitting::draw(const Shot& shot) const {
  const Result<Drawing> drawing = set_up(shot);
  if (!drawing) return tl::unexpected(drawing.error());
  return drawing->renderer.render(drawing->view, drawing->settings);
}

std::string Sitting::next_file(const char* ending) const {
  return fmt::format("{}-{}.{}", id_, panels_.size() + 1, ending);
}

void Sitting::add(std::string caption, Result<LayeredImage> image, int magnification, double stops) {
  if (!outcome_) return;
  if (!image) {
    outcome_ = tl::unexpected(image.error());
    return;
  }
  std::erase_if(image->channels,
                [](const Channel& c) { return c.name != "R" && c.name != "G" && c.name != "B"; });
  Panel panel{next_file(), std::move(caption), image->width, image->height, magnification};
  WriteOptions options;
  options.exposure = exposure_from_stops(stops);
  outcome_ = write_image(*image, darkroom_.folder / panel.file, options);
  panels_.push_back(std::move(panel));
}

bool Sitting::can_draw(const std::string& caption, const Shot& shot) {
  if (!outcome_) return false;
  if (is_offered(shot.settings.shadows)) return true;
  panels_.push_back({"", caption, shot.settings.width, shot.settings.height, 1});
  return false;
}

void Sitting::picture(std::string caption, const Shot& shot) {
  if (can_draw(caption, shot)) add(std::move(caption), draw(shot), 1, shot.stops);
}

void Sitting::detail(std::string caption, const Shot& shot, const Detail& part) {
  if (!can_draw(caption, shot)) return;
  const Result<LayeredImage> whole = draw(shot);
  if (!whole) return add(std::move(caption), whole);
  const auto pixels = [](double share, int side) { return static_cast<int>(std::lround(share * side)); };
  const int left = pixels(part.left, whole->width);
  const int top = pixels(part.top, whole->height);
  const int width = std::clamp(pixels(part.width, whole->width), 1, whole->width - left);
  const int height = std::clamp(pixels(part.height, whole->height), 1, whole->height - top);
  add(std::move(caption), cut_out(*whole, left, top, width, height), part.magnification);
}

void Sitting::light_view(std::string caption, const Shot& shot, const std::string& light) {
  if (!can_draw(caption, shot)) return;
  const Result<Drawing> drawing = set_up(shot);
  if (!drawing) return add(std::move(caption), tl::unexpected(drawing.error()));
  const Result<View> view = drawing->renderer.light_view(light);
  if (!view) return add(std::move(caption), tl::unexpected(view.error()));
  RenderSettings settings = drawing->settings;
  settings.width = std::max(1, static_cast<int>(std::lround(settings.height * view->projection.aspect())));
  add(std::move(caption), drawing->renderer.render(*view, settings));
}

void Sitting::depth_map(std::string caption, const Shot& shot, const std::string& light) {
  if (!can_draw(caption, shot)) return;
  Shot small = shot;
  for (Light& each : small.scene.lights) {
    each.shadow.resolution =
        std::max(16, static_cast<int>(std::lround(darkroom_.scale * shot.settings.height)));
  }
  const Result<Drawing> drawing = set_up(small);
  if (!drawing) return add(std::move(caption), tl::unexpected(drawing.error()));
  const Result<LayeredImage> map = drawing->renderer.depth_map(light);
  add(std::move(caption), map ? depth_picture(*map) : map);
}

void Sitting::projected_depth(std::string caption, const Shot& shot, const std::string& light) {
  if (!can_draw(caption, shot)) return;
  const Result<Drawing> drawing = set_up(shot);
  if (!drawing) return add(std::move(caption), tl::unexpected(drawing.error()));
  add(std::move(caption),
      laterna::projected_depth(drawing->renderer, drawing->view, drawing->settings, light));
}

void Sitting::failures(std::string caption, const Shot& shot, const std::string& light) {
  if (!can_draw(caption, shot)) return;
  Shot layered = shot;
  layered.settings.layers = {Layer::visibility, Layer::depth};
  const Result<LayeredImage> tested = draw(layered);
  if (!tested) return add(std::move(caption), tested);
  Result<LayeredImage> lit = draw(shot.with(ShadowTechnique::none));
  add(std::move(caption), lit ? multiplied(std::move(*lit), *tested, "visibility." + light) : std::move(lit));
}

void Sitting::image(std::string caption, const Image& image) {
  if (!outcome_) return;
  Panel panel{next_file(), std::move(caption), image.width(), image.height(), 1};
  outcome_ = write_image(image, darkroom_.folder / panel.file);
  panels_.push_back(std::move(panel));
}

void Sitting::false_color(std::string caption, const Shot& shot, const Amounts& amounts) {
  if (!can_draw(caption, shot)) return;
  Shot layered = shot;
  layered.settings.layers = {amounts.layer};
  const Result<LayeredImage> image = draw(layered);
  add(std::move(caption),
      image ? false_color_picture(*image, amounts.channel, {amounts.maximum, amounts.unit, true}) : image);
}

void Sitting::polar_plot(std::string caption, const LightDistribution& lamp) {
  if (!outcome_) return;
  constexpr int kWidth = 640, kHeight = 720;  // of the document
  Panel panel{next_file("svg"), std::move(caption), kWidth, kHeight, 1};
  outcome_ = write_polar_plot(lamp, darkroom_.folder / panel.file);
  panels_.push_back(std::move(panel));
}

void Sitting::techniques(const Shot& shot) {
  if (!outcome_) return;
  const Result<Drawing> drawing = set_up(shot);
  AccuracySettings settings;
  if (drawing) settings.picture = drawing->settings;
  const Result<AccuracyReport> report = drawing ? measure_accuracy(drawing->renderer, drawing->view, settings)
                                                : tl::unexpected(drawing.error());
  if (!report) {
    outcome_ = tl::unexpected(report.error());
    return;
  }
  for (const TechniqueDescription& technique : list_techniques())
    picture(sentence_about(technique, *report), shot.with(technique.technique));
}

Visibility Sitting::visibility(const Shot& shot, const std::string& light) {
  if (!outcome_) return {};
  Shot layered = shot;
  layered.settings.samples = 1;
  layered.settings.layers = {Layer::visibility};
  Result<LayeredImage> image = draw(layered);
  if (!image) {
    outcome_ = tl::unexpected(image.error());
    return {};
  }
  for (Channel& channel : image->channels) {
    if (channel.name == "visibility." + light)
      return {image->width, image->height, std::move(channel.values)};
  }
  outcome_ = tl::unexpected(Error(Failure::bad_input, Diagnostic{{}, {}, "there is no light " + light}));
  return {};
}

}  // namespace laterna::app
