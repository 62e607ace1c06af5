#include "render/settings_check.h"

#include <algorithm>

#include "raster/triangle_bins.h"

namespace laterna::render {
namespace {

Result<void> refuse(std::string message) {
  return tl::unexpected(Error(Failure::bad_usage, Diagnostic{{}, {}, std::move(message)}));
}

constexpr int kMaxThreads = 1024;

}  // namespace

Result<void> check_options(const RendererOptions& options) {
  if (options.threads < 0 || options.threads > kMaxThreads) {
    return refuse("threads must be from 0 (one per processor) to " + std::to_string(kMaxThreads) + ", not " +
                  std::to_string(options.threads));
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
  if (settings.anisotropy < 1 || settings.anisotropy > 16) {
    return refuse("anisotropy must be from 1 to 16, not " + std::to_string(settings.anisotropy));
  }
  if (const std::string fault = find_fault(view.projection); !fault.empty())
    return refuse("the view: " + fault);
  return {};
}

}  // namespace laterna::render
