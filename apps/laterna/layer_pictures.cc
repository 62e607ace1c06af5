#include "layer_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "laterna/measure.h"

namespace laterna::app {
namespace {

/// Channels of one layer, in the order of the file.
struct LayerChannels {
  std::vector<const Channel*> channels;
};

bool begins_with(std::string_view name, std::string_view start) {
  return name.substr(0, start.size()) == start;
}

/// "light.sun.G" belongs to "light.sun"; beauty is "R", "G", "B" and "A". A light may be named "left.R", so what is cut
/// off depends on the kind of layer, not on how the name ends.
std::string layer_of(const std::string& channel) {
  if (channel == "Z") return "depth";
  if (channel.find('.') == std::string::npos) return "beauty";
  const bool is_whole = begins_with(channel, "visibility.") || begins_with(channel, "pixel_density.") ||
                        channel == "id.object" || channel == "pass.1.z" ||
                        (begins_with(channel, "pass.2.") && channel.ends_with(".alpha"));
  return is_whole ? channel : channel.substr(0, channel.rfind('.'));
}

LayeredImage picture_like(const LayeredImage& image) {
  LayeredImage picture;
  picture.width = image.width;
  picture.height = image.height;
  for (const char* name : {"R", "G", "B"})
    picture.channels.push_back({name, std::vector<float>(image.channels[0].values.size())});
  return picture;
}

/// Each component brought to 0…1 by (value − low) / (high − low).
LayeredImage within(const LayeredImage& image, const LayerChannels& layer, float low, float high) {
  LayeredImage picture = picture_like(image);
  for (std::size_t c = 0; c < std::min<std::size_t>(3, layer.channels.size()); ++c) {
    const std::vector<float>& values = layer.channels[c]->values;
    std::ranges::transform(values, picture.channels[c].values.begin(), [&](float v) {
      return std::isfinite(v) ? std::clamp((v - low) / (high - low), 0.0F, 1.0F) : 0.0F;
    });
  }
  return picture;
}

LayeredImage grey(const LayeredImage& image, const std::vector<float>& values, float largest) {
  LayeredImage picture = picture_like(image);
  for (Channel& channel : picture.channels) {
    std::ranges::transform(values, channel.values.begin(),
                           [&](float v) { return std::isfinite(v) ? v / largest : 0; });
  }
  return picture;
}

/// A colour for each number, far from those of its neighbours; black for −1.
LayeredImage distinct_colours(const LayeredImage& image, const std::vector<float>& ids) {
  LayeredImage picture = picture_like(image);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] < 0) continue;
    std::uint32_t n = (static_cast<std::uint32_t>(ids[i]) + 1) * 2654435761U;
    for (Channel& channel : picture.channels) {
      channel.values[i] = 0.1F + 0.9F * static_cast<float>(n >> 24U) / 255;
      n = n * 1664525U + 1013904223U;
    }
  }
  return picture;
}

float largest_finite(const std::vector<float>& values) {
  float largest = 0;
  for (const float v : values) largest = std::isfinite(v) ? std::max(largest, v) : largest;
  return largest > 0 ? largest : 1;
}

LayeredImage within_bounds(const LayeredImage& image, const LayerChannels& layer) {
  float low = std::numeric_limits<float>::max();
  float high = -low;
  for (const Channel* channel : layer.channels) {
    for (const float v : channel->values) {
      if (!std::isfinite(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  return within(image, layer, low, high > low ? high : low + 1);
}

Result<LayeredImage> depth_ramp(const LayeredImage& image, const Channel& depth) {
  LayeredImage only;
  only.width = image.width;
  only.height = image.height;
  only.channels.push_back({"Z", depth.values});
  return depth_picture(only);
}

/// What radiance is: beauty, ambient, each light, and the frame buffers of the passes.
LayeredImage exposed(const LayeredImage& image, const LayerChannels& layer, float exposure) {
  return within(image, layer, 0, 1 / exposure);
}

Result<LayeredImage> make_picture(const LayeredImage& image, const std::string& name,
                                  const LayerChannels& layer, float exposure) {
  const Channel& first = *layer.channels[0];
  if (name == "depth" || name == "pass.1.z") return depth_ramp(image, first);
  if (name == "N") return within(image, layer, -1, 1);
  if (name == "P") return within_bounds(image, layer);
  if (name == "id.object") return distinct_colours(image, first.values);
  if (begins_with(name, "uv.") || name == "albedo") return within(image, layer, 0, 1);
  if (name == "lux" || name == "luminance" || begins_with(name, "pixel_density."))
    return grey(image, first.values, largest_finite(first.values));
  if (layer.channels.size() == 1) return grey(image, first.values, 1);
  return exposed(image, layer, exposure);
}

}  // namespace

Result<void> write_layer_pictures(const LayeredImage& image, const std::filesystem::path& folder,
                                  float exposure) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault) {
    return tl::unexpected(
        Error(Failure::cannot_write,
              Diagnostic{folder.string(), {}, "cannot make the folder: " + fault.message()}));
  }
  std::map<std::string, LayerChannels> layers;
  for (const Channel& channel : image.channels) layers[layer_of(channel.name)].channels.push_back(&channel);
  for (const auto& [name, layer] : layers) {
    const Result<LayeredImage> picture = make_picture(image, name, layer, exposure);
    if (!picture) return tl::unexpected(picture.error());
    std::string file = name + ".png";
    std::ranges::replace(file, '/', '_');
    if (Result<void> written = write_image(*picture, folder / file); !written) return written;
  }
  return {};
}

}  // namespace laterna::app
