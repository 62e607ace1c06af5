#include "sitting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "laterna/measure.h"

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

/// Of the pixels that are lit in one of the two, how many differ by more than half.
double share_that_differs(const LayeredImage& a, const LayeredImage& b) {
  std::size_t counted = 0;
  std::size_t differing = 0;
  for (const Channel& channel : a.channels) {
    const Channel* other = channel.name.starts_with("visibility.") ? b.find(channel.name) : nullptr;
    if (other == nullptr) continue;
    counted += channel.values.size();
    for (std::size_t i = 0; i < channel.values.size(); ++i)
      differing += std::abs(channel.values[i] - other->values[i]) > 0.5F ? 1U : 0U;
  }
  return counted == 0 ? 0 : static_cast<double>(differing) / static_cast<double>(counted);
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

struct Sitting::Drawing {
  Renderer renderer;
  View view;
  RenderSettings settings;
};

Result<Sitting::Drawing> Sitting::set_up(const Shot& shot) const {
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

Result<LayeredImage> Sitting::draw(const Shot& shot, RenderStatistics* statistics) const {
  const Result<Drawing> drawing = set_up(shot);
  if (!drawing) return tl::unexpected(drawing.error());
  return drawing->renderer.render(drawing->view, drawing->settings, {}, statistics);
}

std::string Sitting::next_file() { return fmt::format("{}-{}.png", id_, panels_.size() + 1); }

void Sitting::add(std::string caption, Result<LayeredImage> image, int magnification) {
  if (!outcome_) return;
  if (!image) {
    outcome_ = tl::unexpected(image.error());
    return;
  }
  std::erase_if(image->channels,
                [](const Channel& c) { return c.name != "R" && c.name != "G" && c.name != "B"; });
  Panel panel{next_file(), std::move(caption), image->width, image->height, magnification};
  outcome_ = write_image(*image, darkroom_.folder / panel.file);
  panels_.push_back(std::move(panel));
}

bool Sitting::can_draw(const std::string& caption, const Shot& shot) {
  if (!outcome_) return false;
  if (is_offered(shot.settings.shadows)) return true;
  panels_.push_back({"", caption, shot.settings.width, shot.settings.height, 1});
  return false;
}

void Sitting::picture(std::string caption, const Shot& shot) {
  if (can_draw(caption, shot)) add(std::move(caption), draw(shot));
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

void Sitting::measured(const Shot& shot, const Shot& truth) {
  std::string name;
  for (const TechniqueDescription& t : list_techniques()) {
    if (t.technique == shot.settings.shadows) name = fmt::format("{}: {}", t.name, t.meaning);
  }
  if (!can_draw(name, shot) || !can_draw(name, truth)) return;
  Shot layered = shot;
  layered.settings.layers = {Layer::visibility};
  RenderStatistics statistics;
  Result<LayeredImage> image = draw(layered, &statistics);
  if (!image) return add(std::move(name), std::move(image));
  layered.settings.shadows = truth.settings.shadows;
  const Result<LayeredImage> rays = draw(layered);
  if (!rays) return add(std::move(name), rays);
  std::size_t bytes = 0;
  for (const RenderStatistics::LightMemory& memory : statistics.shadow_memory) bytes += memory.bytes;
  std::string caption = fmt::format(
      "{}. Picture and shadows {:.0f} ms, {:.1f} MB; other than rays in {:.3f} % of its pixels.", name,
      statistics.total_ms, static_cast<double>(bytes) / (1 << 20), 100 * share_that_differs(*image, *rays));
  add(std::move(caption), std::move(image));
}

}  // namespace laterna::app
