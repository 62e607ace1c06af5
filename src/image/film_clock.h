// Which frame of a film is seen at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "laterna/film.h"

namespace laterna::image {

/// When each frame begins, in seconds of film: 0 for the first, none earlier than the one before. At least one frame;
/// `duration` is where the last one ends, and not before it begins.
struct FrameTimes {
  std::vector<double> begins;
  double duration = 0;
};

/// `count` frames of 1 / frames_per_second each.
FrameTimes even_times(std::size_t count, double frames_per_second);

/// Seconds of `ticks` units of numerator / denominator: the double nearest to the quotient, so that frames of a film and
/// pictures at the same rational time are at the same double. |ticks · numerator| must be less than 2⁵³.
double seconds_from_ticks(std::int64_t ticks, std::int64_t numerator, std::int64_t denominator);

/// The frame seen at `scene_time`: the last one that has begun. Nothing: it is dark.
std::optional<std::size_t> frame_at(const FrameTimes& times, const FilmTiming& timing, double scene_time);

}  // namespace laterna::image
