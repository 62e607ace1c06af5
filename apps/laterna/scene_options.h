// Options shared by commands that read scenes.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "laterna/image_based_light.h"
#include "laterna/render.h"

namespace laterna::app {

struct SceneOptions {
  std::vector<std::string> files;
  std::vector<std::string> rigs;
  std::string up = "y";
  std::string unit = "m";
  std::string clip;
  double time = 0;  ///< seconds
  int threads = 0;
  std::string instruction_set;
  std::string environment;
  bool no_cache = false;
  std::uint64_t cache_megabytes = kDefaultCacheBytes >> 20U;

  /// SCENE..., --rig, --environment, --up, --unit, --clip, --time.
  void declare_scene(CLI::App& command);
  /// --threads, --isa, --no-cache, --cache-memory.
  void declare_machine(CLI::App& command);

  [[nodiscard]] double metres_per_unit() const;  ///< of --unit
  [[nodiscard]] Result<Scene> load() const;
  [[nodiscard]] Result<RendererOptions> renderer_options() const;
  /// Loads the scene, lets `amend` change it, makes it ready at its time, and tells its warnings.
  [[nodiscard]] Result<Renderer> make_renderer(const std::function<void(Scene&)>& amend = {}) const;
};

/// --environment-size, of commands that write scenes.
void declare_written_environment(CLI::App& command, ImageBasedLightSettings& settings);

struct ViewOptions {
  std::string camera;
  std::string from_light;
  std::string size = "1280x720";

  /// --camera, --from-light, --size.
  void declare(CLI::App& command);
  struct Size {
    int width, height;
  };
  [[nodiscard]] Result<Size> parse_size() const;
  /// The named camera; the first; without one, an overview. Tells which, where none was asked for.
  [[nodiscard]] Result<View> find(const Renderer& renderer, const Size& size) const;
  /// The same at another time than when `first` was found, without a word: cameras and lights move, an overview stays.
  [[nodiscard]] Result<View> follow(const Renderer& renderer, const Size& size, const View& first) const;
};

/// An error about an option.
Error bad_option(std::string message);

}  // namespace laterna::app
