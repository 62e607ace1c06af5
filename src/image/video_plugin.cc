#include "image/video_plugin.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "laterna/film.h"

namespace laterna::image {
namespace {

constexpr const char* kFileName = "liblaterna_ffmpeg.so";

std::vector<std::filesystem::path> plugin_folders() {
  if (const char* chosen = std::getenv("LATERNA_PLUGINS"); chosen != nullptr && *chosen != 0) return {chosen};
  // The library that this code is in: the shared library, or a program that holds it.
  Dl_info self = {};
  if (dladdr(reinterpret_cast<const void*>(&video_plugin), &self) == 0 || self.dli_fname == nullptr)
    return {};
  std::error_code ignored;
  const std::filesystem::path folder =
      std::filesystem::weakly_canonical(self.dli_fname, ignored).parent_path();
  return {folder, folder / "laterna"};
}

LoadedVideoPlugin load(const std::filesystem::path& file) {
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* const reason = dlerror();
    return {nullptr,
            "videos need FFmpeg's libraries; on Debian 12: apt-get install libavformat59 libavcodec59 "
            "libavutil57 (" +
                std::string(reason == nullptr ? file.string() + " cannot be loaded" : reason) + ")"};
  }
  const auto entry = reinterpret_cast<LaternaVideoEntry>(dlsym(library, LATERNA_VIDEO_ENTRY));
  const LaternaVideoPlugin* const plugin = entry == nullptr ? nullptr : entry();
  if (plugin == nullptr || plugin->interface_number != kVideoInterface)
    return {nullptr, file.string() + " belongs to another version of laterna: install the two together"};
  return {plugin, {}};
}

LoadedVideoPlugin find_and_load() {
  std::string tried;
  for (const std::filesystem::path& folder : plugin_folders()) {
    const std::filesystem::path file = folder / kFileName;
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored)) return load(file);
    tried += (tried.empty() ? "" : ", ") + file.string();
  }
  return {nullptr, "videos need the plug-in " + std::string(kFileName) +
                       ", which this build lacks: install libavformat-dev, libavcodec-dev and libavutil-dev, "
                       "and build laterna "
                       "again (looked for " +
                       tried + ")"};
}

}  // namespace

const LoadedVideoPlugin& video_plugin() {
  static const LoadedVideoPlugin kPlugin = find_and_load();
  return kPlugin;
}

}  // namespace laterna::image

namespace laterna {

VideoSupport video_support() {
  const image::LoadedVideoPlugin& loaded = image::video_plugin();
  if (loaded.plugin == nullptr) return {false, loaded.fault};
  return {true, loaded.plugin->versions};
}

}  // namespace laterna
