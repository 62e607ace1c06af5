// The channels of a picture: their names, and where in a shaded tile each is found.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "frame/frame.h"
#include "laterna/render.h"
#include "shade/tile_shader.h"

namespace laterna::render {

/// Finds a channel's plane in a tile; object ids are converted into `buffer`.
using ChannelPlane =
    std::function<const shade::TilePlane*(const shade::TileResult& tile, shade::TilePlane& buffer)>;

struct PictureChannel {
  std::string name;
  ChannelPlane plane;
  bool is_light = false;  ///< an amount of light or coverage, of which means can be taken; others are data
};

bool has_layer(const RenderSettings& settings, Layer layer);

/// Every channel the settings produce, in the order of a file.
std::vector<PictureChannel> picture_channels(const RenderSettings& settings, const frame::Frame& frame);

shade::WantedLayers wanted_layers(const RenderSettings& settings);

}  // namespace laterna::render
