#include "film_options.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <CLI/Validators.hpp>

namespace laterna::app {
namespace {

void list_codecs() {
  for (const VideoCodec& codec : list_video_codecs()) {
    const std::string missing =
        codec.is_there ? "" : fmt::format(" (not here: FFmpeg lacks {})", codec.encoder);
    fmt::print("{:<6} {:<11} {}{}\n", codec.name, codec.endings, codec.meaning, missing);
  }
}

}  // namespace

void FilmOptions::declare(CLI::App& command) {
  command.add_option(
      "--codec", codec,
      "of a film; --list-codecs tells which there are; by default the usual one of its ending");
  command
      .add_option("--quality", quality,
                  "of a film, 0 (smallest file) to 100 (best picture); ffv1 and gif have none")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command.add_flag_callback(
      "--list-codecs",
      [] {
        list_codecs();
        throw CLI::Success();
      },
      "print the codecs of films, with the endings of the files that hold them, and end");
}

}  // namespace laterna::app
