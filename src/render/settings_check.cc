#include "render/settings_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/refuse.h"
#include "laterna/mirrors.h"
#include "raster/triangle_bins.h"

namespace laterna::render {
namespace {

/// Whether an enumerator is one of those from 0 to `last`.
template <class Enumeration>
bool is_known(Enumeration value, Enumeration last) {
  return static_cast<unsigned>(value) <= static_cast<unsigned>(last);
}

constexpr int kMaxThreads = 1024;

}  // namespace

Result<void> check_time(double seconds) {
  if (std::abs(seconds) <= kMaxSceneTime) return {};
  return refuse(fmt::format("a time must be from {:.0f} to {:.0f} seconds, not {}", -kMaxSceneTime,
                            kMaxSceneTime, seconds));
}

Result<void> check_shutter(double seconds, double middle) {
  if (!(seconds >= 0))
    return refuse(fmt::format("a shutter is open for 0 seconds or longer, not {}", seconds));
  if (Result<void> checked = check_time(middle - seconds / 2); !checked) return checked;
  return check_time(middle + seconds / 2);
}

Result<void> check_options(const RendererOptions& options) {
  if (Result<void> checked = check_time(options.time); !checked) return checked;
  if (options.threads < 0 || options.threads > kMaxThreads) {
    return refuse("threads must be from 0 (one per processor) to " + std::to_string(kMaxThreads) + ", not " +
                  std::to_string(options.threads));
  }
  if (options.cache_bytes > kMaxCacheBytes) {
    return refuse("what is kept between pictures may take from 0 to " + std::to_string(kMaxCacheBytes) +
                  " bytes, not " + std::to_string(options.cache_bytes));
  }
  if (!options.instruction_set) return {};
  const std::vector<InstructionSet> known = supported_instruction_sets();
  if (std::find(known.begin(), known.end(), *options.instruction_set) != known.end()) return {};
  std::string names;
  for (const InstructionSet set : known) names += (names.empty() ? "" : ", ") + std::string(name_of(set));
  return refuse("this machine or build has no " + std::string(name_of(*options.instruction_set)) +
                ": it has " + names);
}

Result<void> check_settings(const RenderSettings& settings, const View& view) {
  for (const int side : {settings.width, settings.height}) {
    if (side < 1 || side > raster::kMaxRasterSide) {
      return refuse("a picture's width and height must be from 1 to " +
                    std::to_string(raster::kMaxRasterSide) + ", not " + std::to_string(settings.width) + "x" +
                    std::to_string(settings.height));
    }
  }
  constexpr int kCounts[] = {1, 2, 4, 8, 16};
  if (std::find(std::begin(kCounts), std::end(kCounts), settings.samples) == std::end(kCounts)) {
    return refuse("samples per pixel must be 1, 2, 4, 8 or 16, not " + std::to_string(settings.samples));
  }
  if (!is_known(settings.shading, ShadingModel::pbr) ||
      !is_known(settings.shadows, ShadowTechnique::raytraced) || !is_known(settings.passes, Passes::multi) ||
      !is_known(settings.interpolation, Interpolation::affine)) {
    return refuse(
        "the settings hold a shading model, shadow technique, passes or interpolation that there is not");
  }
  for (const Layer layer : settings.layers) {
    if (std::ranges::find(list_layers(), layer, &LayerDescription::layer) == list_layers().end())
      return refuse("the settings ask for a layer that there is not");
  }
  if (settings.accumulate < 1 || settings.accumulate > kMaxAccumulated) {
    return refuse("pictures to accumulate must be from 1 to " + std::to_string(kMaxAccumulated) + ", not " +
                  std::to_string(settings.accumulate));
  }
  if (!(settings.noise >= 0 && settings.noise < 1)) {
    return refuse("the noise to stop at must be a fraction from 0 up to 1, not " +
                  std::to_string(settings.noise));
  }
  if (settings.anisotropy < 1 || settings.anisotropy > 16) {
    return refuse("anisotropy must be from 1 to 16, not " + std::to_string(settings.anisotropy));
  }
  if (settings.mirror_depth < 0 || settings.mirror_depth > kMaxMirrorDepth) {
    return refuse(
        fmt::format("mirrors may be seen from 0 to {} deep, not {}", kMaxMirrorDepth, settings.mirror_depth));
  }
  if (const std::string fault = find_fault(view.projection); !fault.empty())
    return refuse("the view: " + fault);
  if (const std::string fault = find_fault(view.pose); !fault.empty()) return refuse("the view: " + fault);
  return {};
}

}  // namespace laterna::render
