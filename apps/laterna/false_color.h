// Amounts of light in colours that can be read off: --false-colour, and the command of that name.
#pragma once

#include <string>

#include "laterna/false_color.h"
#include "laterna/render.h"

namespace laterna::app {

/// What --false-colour shows.
struct FalseColorChoice {
  Layer layer = Layer::lux;
  std::string light;   ///< of pixel_density; empty: the first projector
  double maximum = 0;  ///< 0: found
};

/// For --help.
const char* describe_false_color();

/// From "lux", "luminance" or "pixel_density" ("pixel_density.LIGHT"), each with or without ":MAX".
Result<FalseColorChoice> parse_false_color(const std::string& text);

/// Says on stderr where the scale of a false-colour picture begins and ends.
void tell_scale(const LayeredImage& picture, const std::string& channel, const std::string& unit);

/// Draws the layer and colours it; tells its scale.
Result<LayeredImage> draw_false_color(const Renderer& renderer, const View& camera,
                                      const RenderSettings& settings, const FalseColorChoice& choice,
                                      RenderStatistics& statistics);

}  // namespace laterna::app
