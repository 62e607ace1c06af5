#include "image/film_clock.h"

#include <algorithm>
#include <cmath>

namespace laterna::image {
namespace {

// The last frame that has begun at `film_time`, 0 or more.
std::size_t last_begun(const FrameTimes& times, double film_time) {
  const auto next = std::upper_bound(times.begins.begin(), times.begins.end(), film_time);
  return static_cast<std::size_t>(next - times.begins.begin()) - 1;
}

// Forward through all frames, then backward through all but the last and the first, each as long as ever.
std::size_t there_and_back(const FrameTimes& times, double film_time) {
  const std::size_t count = times.begins.size();
  if (count < 3) return last_begun(times, std::fmod(film_time, times.duration));
  const double last_begins = times.begins.back();
  const double back = last_begins - times.begins[1];
  const double within = std::fmod(film_time, times.duration + back);
  if (within < times.duration) return last_begun(times, within);
  // Backward, a frame is seen from its end on.
  const double mirrored = last_begins - (within - times.duration);
  const auto next = std::lower_bound(times.begins.begin(), times.begins.end(), mirrored);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - times.begins.begin() - 1, 0));
}

}  // namespace

FrameTimes even_times(std::size_t count, double frames_per_second) {
  FrameTimes times;
  times.begins.reserve(count);
  for (std::size_t i = 0; i < count; ++i) times.begins.push_back(static_cast<double>(i) / frames_per_second);
  times.duration = static_cast<double>(count) / frames_per_second;
  return times;
}

double seconds_from_ticks(std::int64_t ticks, std::int64_t numerator, std::int64_t denominator) {
  return static_cast<double>(ticks * numerator) / static_cast<double>(denominator);
}

std::optional<std::size_t> frame_at(const FrameTimes& times, const FilmTiming& timing, double scene_time) {
  const bool is_black = timing.at_end == AtEnd::black;
  const double film_time = (scene_time - timing.start + kSameInstant) * timing.rate;
  if (film_time < 0) return is_black ? std::nullopt : std::optional<std::size_t>(0);
  if (film_time < times.duration) return last_begun(times, film_time);
  if (is_black) return std::nullopt;
  if (timing.at_end == AtEnd::hold || times.duration <= 0) return times.begins.size() - 1;
  return timing.at_end == AtEnd::loop ? last_begun(times, std::fmod(film_time, times.duration))
                                      : there_and_back(times, film_time);
}

}  // namespace laterna::image
