// The video plug-in, found beside the library and loaded when first asked for.
#pragma once

#include <string>

#include "image/video_interface.h"

namespace laterna::image {

struct LoadedVideoPlugin {
  const LaternaVideoPlugin* plugin = nullptr;
  std::string fault;  ///< why there is none, and what to do
};

/// Looks in the folder that LATERNA_PLUGINS names, or else beside the library and in the folder "laterna" there. Loaded once
/// in a process, and kept.
const LoadedVideoPlugin& video_plugin();

}  // namespace laterna::image
