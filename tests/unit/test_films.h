// The films under tests/films, and the plug-in of this build.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "laterna/film.h"

namespace laterna::testing {

inline std::filesystem::path test_film(const std::string& name) {
  return std::filesystem::path(LATERNA_SOURCE_DIR) / "tests/films" / name;
}

/// Whether videos can be opened; a test program's plug-in does not lie beside it.
inline bool has_video() {
  setenv("LATERNA_PLUGINS", LATERNA_PLUGIN_DIR, 1);
  return video_support().is_there;
}

}  // namespace laterna::testing
