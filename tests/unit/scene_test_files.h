// Loading scenes from the files of a test.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "laterna/scene.h"
#include "unit/temporary_folder.h"

namespace laterna::testing_scenes {

/// Loads, and fails the test with the messages when that does not work.
inline Scene load_or_fail(const std::vector<std::filesystem::path>& files, const LoadOptions& options = {}) {
  Result<Scene> scene = load_scene(files, options);
  if (scene) return std::move(*scene);
  ADD_FAILURE() << to_string(scene.error());
  return {};
}

/// All messages of a failed load, with `folder` cut from them; "loaded" when it did not fail.
inline std::string messages_of(const Result<Scene>& scene, const std::filesystem::path& folder) {
  if (scene) return "loaded";
  std::string text = to_string(scene.error());
  const std::string prefix = folder.string() + "/";
  for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
    text.erase(at, prefix.size());
  return text;
}

/// All warnings of a scene, one per line, without their file.
inline std::string warnings_of(const Scene& scene) {
  std::string text;
  for (Diagnostic warning : scene.warnings) {
    warning.file.clear();
    text += to_string(warning) + "\n";
  }
  return text;
}

}  // namespace laterna::testing_scenes
