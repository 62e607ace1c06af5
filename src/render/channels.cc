#include "render/channels.h"

#include <algorithm>
#include <array>

#include "image/luminance.h"

namespace laterna {
namespace {

constexpr std::array<LayerDescription, 13> kLayers = {{
    {Layer::light, "light", "ambient.R/G/B, light.<name>.R/G/B, environment.R/G/B, reflection.R/G/B",
     "ambient, each light, the environment and what mirrors show by itself; their sum is the picture"},
    {Layer::visibility, "visibility", "visibility.<name>",
     "fraction of each light that arrives, 0 in shadow"},
    {Layer::uv, "uv", "uv.<name>.u/.v", "slide coordinates of each projector, NaN outside its frame"},
    {Layer::lux, "lux", "lux.Y", "direct illuminance of the surface in lux, with shadows and slides"},
    {Layer::luminance, "luminance", "luminance.Y",
     "cd/m² that the camera sees with --shading pbr; otherwise the picture's luminance"},
    {Layer::pixel_density, "pixel_density", "pixel_density.<name>",
     "each projector's pixels per metre of the surface, in the sparser direction"},
    {Layer::depth, "depth", "Z", "distance along the camera's axis in metres, infinity where nothing is"},
    {Layer::position, "position", "P.X/Y/Z", "world position in metres"},
    {Layer::normal, "normal", "N.X/Y/Z", "shading normal in world space"},
    {Layer::albedo, "albedo", "albedo.R/G/B", "base colour, linear"},
    {Layer::photographs, "photographs", "photo.seen, photo.weight.*, photo.color.*",
     "how many photographs see a surface, -1 where nothing is; each one's share and colour"},
    {Layer::object, "object", "id.object",
     "number of the object, -1 where nothing is; names in the metadata"},
    {Layer::passes, "passes", "pass.*", "the frame buffer after each pass of --passes multi"},
}};

}  // namespace

std::span<const LayerDescription> list_layers() { return kLayers; }

namespace render {
namespace {

using shade::TileColor;
using shade::TilePlane;
using shade::TileResult;

class ChannelList {
 public:
  template <class Find>  // Find: TileResult → const TilePlane*
  void add(std::string name, Find find, bool is_light = true) {
    channels_.push_back(
        {std::move(name), [find](const TileResult& tile, TilePlane&) { return find(tile); }, is_light});
  }
  template <class Find>
  void add_data(std::string name, Find find) {
    add(std::move(name), find, false);
  }
  template <class Find>  // Find: TileResult → const TileColor&
  void add_color(const std::string& prefix, const std::array<const char*, 3>& suffixes, Find find,
                 bool is_light = true) {
    add(
        prefix + suffixes[0], [find](const TileResult& tile) { return &find(tile).r; }, is_light);
    add(
        prefix + suffixes[1], [find](const TileResult& tile) { return &find(tile).g; }, is_light);
    add(
        prefix + suffixes[2], [find](const TileResult& tile) { return &find(tile).b; }, is_light);
  }
  void add_luminance() {
    channels_.push_back({"luminance.Y",
                         [](const TileResult& tile, TilePlane& buffer) -> const TilePlane* {
                           const TileColor& c = tile.beauty;
                           for (std::size_t i = 0; i < buffer.size(); ++i)
                             buffer[i] = image::luminance(c.r[i], c.g[i], c.b[i]);
                           return &buffer;
                         },
                         true});
  }
  void add_object_ids() {
    channels_.push_back({"id.object",
                         [](const TileResult& tile, TilePlane& buffer) -> const TilePlane* {
                           for (std::size_t i = 0; i < buffer.size(); ++i) {
                             const std::uint32_t id = tile.object[i];
                             buffer[i] = id == shade::kNoObject ? -1.0F : static_cast<float>(id);
                           }
                           return &buffer;
                         },
                         false});
  }
  std::vector<PictureChannel> take() { return std::move(channels_); }

 private:
  std::vector<PictureChannel> channels_;
};

constexpr std::array<const char*, 3> kRgb = {"R", "G", "B"};
constexpr std::array<const char*, 3> kXyz = {"X", "Y", "Z"};

void add_lights(ChannelList& list, const RenderSettings& settings, const frame::Frame& frame) {
  if (has_layer(settings, Layer::light)) {
    list.add_color("ambient.", kRgb, [](const TileResult& t) -> const TileColor& { return t.radiance[0]; });
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
      list.add_color("light." + frame.lights[i].light->name + ".", kRgb,
                     [i](const TileResult& t) -> const TileColor& { return t.radiance[i + 1]; });
    }
    if (frame.has_environment) {
      list.add_color("environment.", kRgb,
                     [environment = frame.lights.size() + 1](const TileResult& t) -> const TileColor& {
                       return t.radiance[environment];
                     });
    }
    if (frame.has_mirrors) {
      list.add_color("reflection.", kRgb,
                     [](const TileResult& t) -> const TileColor& { return t.radiance.back(); });
    }
  }
  if (has_layer(settings, Layer::visibility)) {
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
      list.add("visibility." + frame.lights[i].light->name,
               [i](const TileResult& t) { return &t.visibility[i]; });
    }
  }
  if (!has_layer(settings, Layer::uv)) return;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    if (frame.lights[i].light->type != LightType::projector) continue;
    list.add_data("uv." + frame.lights[i].light->name + ".u",
                  [i](const TileResult& t) { return &t.slide_s[i]; });
    list.add_data("uv." + frame.lights[i].light->name + ".v",
                  [i](const TileResult& t) { return &t.slide_t[i]; });
  }
}

void add_photometry(ChannelList& list, const RenderSettings& settings, const frame::Frame& frame) {
  if (has_layer(settings, Layer::lux)) list.add("lux.Y", [](const TileResult& t) { return &t.lux; });
  if (has_layer(settings, Layer::luminance)) list.add_luminance();
  if (!has_layer(settings, Layer::pixel_density)) return;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    if (frame.lights[i].light->type != LightType::projector) continue;
    list.add_data("pixel_density." + frame.lights[i].light->name,
                  [i](const TileResult& t) { return &t.pixel_density[i]; });
  }
}

void add_photographs(ChannelList& list, const RenderSettings& settings, const frame::Frame& frame) {
  if (!has_layer(settings, Layer::photographs) || frame.photographs.empty()) return;
  list.add_data("photo.seen", [](const TileResult& t) { return &t.photographs_seen; });
  for (std::size_t i = 0; i < frame.photographs.size(); ++i) {
    const std::string& name = frame.photographs[i].photograph->name;
    list.add_data("photo.weight." + name, [i](const TileResult& t) { return &t.photograph_share[i]; });
    list.add_color(
        "photo.color." + name + ".", kRgb,
        [i](const TileResult& t) -> const TileColor& { return t.photograph_color[i]; }, false);
  }
}

void add_passes(ChannelList& list, const RenderSettings& settings, const frame::Frame& frame) {
  if (!has_layer(settings, Layer::passes) || settings.passes != Passes::multi) return;
  list.add_data("pass.1.z", [](const TileResult& t) { return &t.depth; });
  list.add_color("pass.1.c.", kRgb, [](const TileResult& t) -> const TileColor& { return t.pass_colors[0]; });
  for (std::size_t i = 0; i < frame.lights.size(); ++i) {
    const std::string& name = frame.lights[i].light->name;
    list.add("pass.2." + name + ".alpha", [i](const TileResult& t) { return &t.visibility[i]; });
    if (settings.shading == ShadingModel::papers) {
      list.add_color("pass.2." + name + ".c.", kRgb,
                     [i](const TileResult& t) -> const TileColor& { return t.pass_illumination[i]; });
    }
    list.add_color("pass.3." + name + ".c.", kRgb,
                   [i](const TileResult& t) -> const TileColor& { return t.pass_colors[i + 1]; });
  }
}

}  // namespace

bool has_layer(const RenderSettings& settings, Layer layer) {
  return std::find(settings.layers.begin(), settings.layers.end(), layer) != settings.layers.end();
}

std::vector<PictureChannel> picture_channels(const RenderSettings& settings, const frame::Frame& frame) {
  ChannelList list;
  list.add_color("", kRgb, [](const TileResult& t) -> const TileColor& { return t.beauty; });
  list.add("A", [](const TileResult& t) { return &t.alpha; });
  add_lights(list, settings, frame);
  add_photometry(list, settings, frame);
  if (has_layer(settings, Layer::depth)) list.add_data("Z", [](const TileResult& t) { return &t.depth; });
  if (has_layer(settings, Layer::position)) {
    list.add_color(
        "P.", kXyz, [](const TileResult& t) -> const TileColor& { return t.position; }, false);
  }
  if (has_layer(settings, Layer::normal)) {
    list.add_color(
        "N.", kXyz, [](const TileResult& t) -> const TileColor& { return t.normal; }, false);
  }
  if (has_layer(settings, Layer::albedo)) {
    list.add_color(
        "albedo.", kRgb, [](const TileResult& t) -> const TileColor& { return t.albedo; }, false);
  }
  if (has_layer(settings, Layer::object)) list.add_object_ids();
  add_photographs(list, settings, frame);
  add_passes(list, settings, frame);
  return list.take();
}

shade::WantedLayers wanted_layers(const RenderSettings& settings) {
  shade::WantedLayers wanted;
  wanted.passes = has_layer(settings, Layer::passes) && settings.passes == Passes::multi;
  wanted.lights = has_layer(settings, Layer::light) || settings.passes == Passes::multi;
  wanted.visibility = has_layer(settings, Layer::visibility) || wanted.passes;
  wanted.slide_uv = has_layer(settings, Layer::uv);
  wanted.lux = has_layer(settings, Layer::lux);
  wanted.pixel_density = has_layer(settings, Layer::pixel_density);
  wanted.geometry = has_layer(settings, Layer::depth) || has_layer(settings, Layer::position) ||
                    has_layer(settings, Layer::normal) || has_layer(settings, Layer::object) || wanted.passes;
  wanted.albedo = has_layer(settings, Layer::albedo);
  wanted.photographs = has_layer(settings, Layer::photographs);
  return wanted;
}

}  // namespace render
}  // namespace laterna
