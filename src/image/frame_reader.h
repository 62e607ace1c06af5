// The frames of a film by number, whatever kind of file they come from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "image/film_clock.h"
#include "laterna/film.h"
#include "laterna/image.h"

namespace laterna::image {

class FrameReader {
 public:
  FrameReader() = default;
  virtual ~FrameReader() = default;
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  [[nodiscard]] const FilmHeader& header() const { return header_; }
  [[nodiscard]] const FrameTimes& times() const { return times_; }
  /// What is wrong with the file without keeping it from being shown: it ends early.
  [[nodiscard]] const std::vector<Diagnostic>& warnings() const { return warnings_; }

  /// Frame `number` < header().frames, of the header's size: the same pixels whatever was read before. Frames in rising
  /// order are read fastest. To be called by one thread at a time.
  virtual Result<Image> read(std::size_t number) = 0;

 protected:
  FilmHeader header_;
  FrameTimes times_;
  std::vector<Diagnostic> warnings_;
};

using OpenedFilm = Result<std::unique_ptr<FrameReader>>;

/// Any kind of film; see read_film_header().
OpenedFilm open_film(const std::filesystem::path& file, double frames_per_second);

/// Numbered pictures, or one picture.
OpenedFilm open_sequence(const std::filesystem::path& pattern, double frames_per_second);
/// `name` stands in messages.
OpenedFilm open_gif(std::vector<std::byte> encoded, std::string name);
/// A file that FFmpeg reads, by the plug-in.
OpenedFilm open_video(const std::filesystem::path& file);

}  // namespace laterna::image
