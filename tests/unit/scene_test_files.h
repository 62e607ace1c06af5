// A folder for the files of one test, and loading from it.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

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

namespace laterna::testing_scenes {

/// Made empty, and removed with everything in it at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("laterna_") + test->test_suite_name() + "_" + test->name() + "_" +
                       std::to_string(::getpid());
    for (char& c : name) c = c == '/' ? '_' : c;
    path_ = std::filesystem::path(::testing::TempDir()) / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, std::string_view content) const {
    std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }
  std::filesystem::path write(const std::string& name, std::span<const std::byte> content) const {
    return write(name, std::string_view(reinterpret_cast<const char*>(content.data()), content.size()));
  }

 private:
  std::filesystem::path path_;
};

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
