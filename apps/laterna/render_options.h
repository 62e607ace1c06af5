// Options of `laterna render`, as they were typed.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "film_options.h"
#include "frame_range.h"
#include "laterna/video.h"
#include "scene_options.h"

namespace laterna::app {

struct RenderOptions {
  SceneOptions scene;
  ViewOptions view;
  FilmOptions film;
  FrameOptions frames;
  std::string output, layer_pictures;
  std::string shadows = "map", shading = "pbr", passes = "single", interpolation = "perspective",
              depth = "auto";
  std::string exposure = "0", background, debug, false_color;
  std::vector<std::string> layers;
  int samples = 1, anisotropy = 8, accumulate = 1, mirror_depth = 2;
  double noise = 0;
  bool progressive = false, resume = false, turntable = false, json = false;

  void declare(CLI::App& command);
  [[nodiscard]] bool makes_film() const { return is_video_output(output); }
};

}  // namespace laterna::app
