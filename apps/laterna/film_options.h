// Options for films that are written: --codec, --quality, --list-codecs.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "laterna/video.h"

namespace laterna::app {

struct FilmOptions {
  std::string codec;
  double quality = VideoOptions{}.quality;

  void declare(CLI::App& command);
  [[nodiscard]] VideoOptions with(const VideoRate& rate, std::size_t frames) const {
    return {codec, quality, rate, static_cast<std::int64_t>(frames)};
  }
  [[nodiscard]] bool are_given() const { return !codec.empty() || quality != VideoOptions{}.quality; }
};

}  // namespace laterna::app
