#include "false_color.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include "outcome.h"
#include "progress_line.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

struct ShownLayer {
  Layer layer;
  std::string_view name, channel, unit;
};
constexpr std::array<ShownLayer, 3> kShownLayers = {
    {{Layer::lux, "lux", "lux.Y", "lx"},
     {Layer::luminance, "luminance", "luminance.Y", "cd/m2"},
     {Layer::pixel_density, "pixel_density", "pixel_density.", "px/m"}}};

/// The number after the last colon, where there is one; lights' names may have colons too.
Result<double> take_maximum(std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return 0;
  char* end = nullptr;
  const char* number = text.c_str() + colon + 1;
  const double maximum = std::strtod(number, &end);
  if (end == number || *end != 0 || !(maximum > 0)) {
    return tl::unexpected(bad_option(fmt::format(
        "--false-colour: expected a maximum greater than 0 after the colon, got \"{}\"", number)));
  }
  text.resize(colon);
  return maximum;
}

Result<std::string> channel_of(const ShownLayer& shown, const FalseColorChoice& choice,
                               const Renderer& renderer) {
  if (shown.layer != Layer::pixel_density) return std::string(shown.channel);
  std::string names;
  for (const Light& light : renderer.scene().lights) {
    if (light.type != LightType::projector || !light.enabled) continue;
    if (choice.light.empty() || choice.light == light.name) return std::string(shown.channel) + light.name;
    names += (names.empty() ? "\"" : ", \"") + light.name + "\"";
  }
  return tl::unexpected(bad_option(
      names.empty()
          ? "--false-colour pixel_density: the scene has no projector"
          : fmt::format("--false-colour: there is no projector \"{}\"; there are {}", choice.light, names)));
}

}  // namespace

const char* describe_false_color() {
  return "lux, luminance or pixel_density[.LIGHT], with :MAX for the scale's end: amounts as colours, with a "
         "scale and "
         "iso-lines, in the picture's stead";
}

Result<FalseColorChoice> parse_false_color(const std::string& text) {
  std::string rest = text;
  const Result<double> maximum = take_maximum(rest);
  if (!maximum) return tl::unexpected(maximum.error());
  const std::size_t dot = rest.find('.');
  const std::string_view name = std::string_view(rest).substr(0, dot);
  for (const ShownLayer& shown : kShownLayers) {
    const bool takes_light = shown.layer == Layer::pixel_density;
    if (name != shown.name || (dot != std::string::npos && !takes_light)) continue;
    return FalseColorChoice{shown.layer, dot == std::string::npos ? "" : rest.substr(dot + 1), *maximum};
  }
  return tl::unexpected(bad_option(fmt::format(
      "--false-colour: expected lux, luminance or pixel_density[.LIGHT], with or without :MAX, got \"{}\"",
      text)));
}

void tell_scale(const LayeredImage& picture, const std::string& channel, const std::string& unit) {
  fmt::print(stderr, "laterna: {}: the scale goes from 0 to {}{}{}\n", channel,
             picture.metadata.at("laterna.scale_maximum"), unit.empty() ? "" : " ", unit);
}

Result<LayeredImage> draw_false_color(const Renderer& renderer, const View& camera,
                                      const RenderSettings& settings, const FalseColorChoice& choice,
                                      RenderStatistics& statistics) {
  const ShownLayer& shown = *std::ranges::find(kShownLayers, choice.layer, &ShownLayer::layer);
  const Result<std::string> channel = channel_of(shown, choice, renderer);
  if (!channel) return tl::unexpected(channel.error());
  RenderSettings with_layer = settings;
  with_layer.layers = {choice.layer};
  const Result<LayeredImage> image =
      renderer.render(camera, with_layer, progress_line("rendering"), &statistics);
  if (!image) return image;
  Result<LayeredImage> picture =
      false_color_picture(*image, *channel, {choice.maximum, std::string(shown.unit), true});
  if (picture) {
    tell_scale(*picture, *channel, std::string(shown.unit));
  }
  return picture;
}

}  // namespace laterna::app
