#include "laterna/still_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/refuse.h"
#include "base/without_exceptions.h"
#include "image/film_clock.h"
#include "image/frame_reader.h"
#include "laterna/mirrors.h"

namespace laterna {
namespace {

using Pixels = std::shared_ptr<const Image>;

bool runs(const Wave& wave) { return wave.amplitude > 0 && (!wave.speed || *wave.speed != 0); }

// What a film shows then, as large as its frames where that is nothing.
Result<Pixels> frame_of(const Picture& picture, double seconds, std::vector<Diagnostic>& warnings) {
  const image::OpenedFilm film = image::open_film(picture.file, picture.film->frames_per_second);
  if (!film) return tl::unexpected(film.error());
  const std::vector<Diagnostic>& told = (*film)->warnings();
  warnings.insert(warnings.end(), told.begin(), told.end());
  const FilmHeader& header = (*film)->header();
  const std::optional<std::size_t> number = image::frame_at((*film)->times(), *picture.film, seconds);
  if (!number)
    return std::make_shared<const Image>(header.width, header.height, 3, PixelType::u8, Transfer::srgb);
  Result<Image> frame = (*film)->read(*number);
  if (!frame) return tl::unexpected(std::move(frame.error()));
  return std::make_shared<const Image>(std::move(*frame));
}

// By picture; null for those that are no films.
Result<std::vector<Pixels>> frames_of_films(const Scene& scene, double seconds,
                                            std::vector<Diagnostic>& warnings) {
  std::vector<Pixels> frames;
  for (const Picture& picture : scene.pictures) {
    frames.emplace_back();
    if (!picture.film) continue;
    Error exhausted(Failure::bad_input,
                    Diagnostic{picture.file.string(), {}, "not enough memory for a frame of the film"});
    Result<Pixels> frame =
        without_exceptions(std::move(exhausted), [&] { return frame_of(picture, seconds, warnings); });
    if (!frame) return tl::unexpected(std::move(frame.error()));
    frames.back() = std::move(*frame);
  }
  return frames;
}

void show_frame(Picture& picture, Pixels frame) {
  if (picture.name.empty()) picture.name = picture.file.string();
  picture.file.clear();
  picture.film.reset();
  picture.pixels = std::move(frame);
}

std::shared_ptr<const Mirror> with_still_waves(const Mirror& moving, double seconds) {
  auto still = std::make_shared<Mirror>(moving);
  for (Wave& wave : still->waves) {
    wave.phase = phase_at(wave, seconds);
    wave.speed = 0;
  }
  return still;
}

}  // namespace

bool changes_with_time(const Scene& scene) {
  return !scene.clips.empty() || std::ranges::any_of(scene.pictures, [](const Picture& picture) {
    return picture.film.has_value();
  }) || std::ranges::any_of(scene.materials, [](const Material& material) {
    return material.mirror != nullptr && std::ranges::any_of(material.mirror->waves, runs);
  });
}

Result<std::vector<Diagnostic>> make_still(Scene& scene, double seconds) {
  if (!(std::abs(seconds) <= kMaxSceneTime))
    return refuse(fmt::format("expected a time from {:g} to {:g} seconds, got {}", -kMaxSceneTime,
                              kMaxSceneTime, seconds));
  if (std::vector<Diagnostic> faults = validate(scene); !faults.empty())
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  std::vector<Diagnostic> warnings;
  Result<std::vector<Pixels>> frames = frames_of_films(scene, seconds, warnings);
  if (!frames) return tl::unexpected(std::move(frames.error()));
  for (std::size_t i = 0; i < frames->size(); ++i) {
    if ((*frames)[i] != nullptr) show_frame(scene.pictures[i], std::move((*frames)[i]));
  }
  pose_scene(scene, seconds);
  scene.clips.clear();
  for (Material& material : scene.materials) {
    if (material.mirror != nullptr && !material.mirror->waves.empty())
      material.mirror = with_still_waves(*material.mirror, seconds);
  }
  return warnings;
}

}  // namespace laterna
