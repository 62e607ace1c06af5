// Which kind of film is this?
#include <algorithm>
#include <array>
#include <fstream>

#include "base/file_io.h"
#include "base/without_exceptions.h"
#include "image/decoder.h"
#include "image/frame_reader.h"

namespace laterna::image {
namespace {

// Enough for any signature. What cannot be read is empty, and whoever opens the file says why.
std::vector<std::byte> read_signature(const std::filesystem::path& file) {
  std::array<char, 64> bytes{};
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), bytes.size());
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  return {first, first + std::max<std::streamsize>(in.gcount(), 0)};
}

OpenedFilm open_any(const std::filesystem::path& file, double frames_per_second) {
  if (is_numbered(file)) return open_sequence(file, frames_per_second);
  const std::vector<std::byte> begin = read_signature(file);
  const std::string name = file.string();
  if (kGifDecoder.recognises({begin, name})) {
    Result<std::vector<std::byte>> bytes = read_file(file);
    if (!bytes) return tl::unexpected(std::move(bytes.error()));
    return open_gif(std::move(*bytes), name);
  }
  if (begin.empty() || is_picture({begin, name})) return open_sequence(file, frames_per_second);
  return open_video(file);
}

}  // namespace

OpenedFilm open_film(const std::filesystem::path& file, double frames_per_second) {
  Error exhausted(Failure::bad_input, Diagnostic{file.string(), {}, "not enough memory for the film"});
  return without_exceptions(std::move(exhausted), [&] { return open_any(file, frames_per_second); });
}

}  // namespace laterna::image

namespace laterna {

Result<FilmHeader> read_film_header(const std::filesystem::path& file, double frames_per_second) {
  const image::OpenedFilm film = image::open_film(file, frames_per_second);
  if (!film) return tl::unexpected(film.error());
  return (*film)->header();
}

Result<std::optional<std::size_t>> find_film_frame(const std::filesystem::path& file,
                                                   const FilmTiming& timing, double scene_time) {
  const image::OpenedFilm film = image::open_film(file, timing.frames_per_second);
  if (!film) return tl::unexpected(film.error());
  return image::frame_at((*film)->times(), timing, scene_time);
}

}  // namespace laterna
