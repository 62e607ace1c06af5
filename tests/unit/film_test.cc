// Films without video: which frame is seen when, GIFs, numbered pictures, and frames made ready ahead.
#include "image/film.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "image/numbered_files.h"
#include "unit/image_bytes.h"

namespace laterna::image {
namespace {

using namespace laterna::testing;

// ------------------------------------------------------------------------------------------------------- the clock

constexpr std::size_t kDark = 999;

// The frames seen at t = first / fps, (first + 1) / fps, …
std::vector<std::size_t> seen(const FrameTimes& times, const FilmTiming& timing, int first, int count,
                              double fps) {
  std::vector<std::size_t> numbers;
  for (int i = first; i < first + count; ++i)
    numbers.push_back(frame_at(times, timing, i / fps).value_or(kDark));
  return numbers;
}

using Numbers = std::vector<std::size_t>;

TEST(FilmClock, WhatIsSeenBeforeAndAfter) {
  const FrameTimes four = even_times(4, 24);
  FilmTiming timing;
  timing.at_end = AtEnd::hold;
  EXPECT_EQ(seen(four, timing, -2, 9, 24), (Numbers{0, 0, 0, 1, 2, 3, 3, 3, 3}));
  timing.at_end = AtEnd::black;
  EXPECT_EQ(seen(four, timing, -2, 9, 24), (Numbers{kDark, kDark, 0, 1, 2, 3, kDark, kDark, kDark}));
  timing.at_end = AtEnd::loop;
  EXPECT_EQ(seen(four, timing, -1, 12, 24), (Numbers{0, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2}));
  timing.at_end = AtEnd::ping_pong;
  EXPECT_EQ(seen(four, timing, -1, 15, 24), (Numbers{0, 0, 1, 2, 3, 2, 1, 0, 1, 2, 3, 2, 1, 0, 1}));
  EXPECT_EQ(seen(even_times(1, 24), timing, -1, 4, 24), (Numbers{0, 0, 0, 0}));
  EXPECT_EQ(seen(even_times(2, 24), timing, 0, 5, 24), (Numbers{0, 1, 0, 1, 0}));
}

TEST(FilmClock, FramesOfUnequalLength) {
  const FrameTimes times = {{0, 0.04, 0.1, 0.3}, 0.5};
  FilmTiming timing;
  timing.at_end = AtEnd::ping_pong;
  const auto at = [&](double t) { return frame_at(times, timing, t).value_or(kDark); };
  EXPECT_EQ(at(0.0399), 0U);
  EXPECT_EQ(at(0.04), 1U);
  EXPECT_EQ(at(0.0999), 1U);
  EXPECT_EQ(at(0.1), 2U);
  EXPECT_EQ(at(0.4999), 3U);
  // Back: frame 2 for its 0.2 s, frame 1 for its 0.06 s, then forward from frame 0.
  EXPECT_EQ(at(0.5), 2U);
  EXPECT_EQ(at(0.6999), 2U);
  EXPECT_EQ(at(0.7), 1U);
  EXPECT_EQ(at(0.7599), 1U);
  EXPECT_EQ(at(0.76), 0U);
  EXPECT_EQ(at(0.8), 1U);
}

// No frame is missed because k / fps, the start or the rate were rounded.
TEST(FilmClock, EveryFrameIsSeenAtItsOwnTime) {
  for (const auto& [numerator, denominator] : {std::pair{24, 1}, {25, 1}, {30000, 1001}, {60, 1}, {7, 3}}) {
    FrameTimes times;
    constexpr int kFrames = 3000;
    for (int k = 0; k <= kFrames; ++k) times.begins.push_back(seconds_from_ticks(k, denominator, numerator));
    times.duration = times.begins.back();
    times.begins.pop_back();
    for (const double start : {0.0, 0.1, -3.7, 86400.3}) {
      for (const double rate : {1.0, 0.3, 3.0}) {
        const FilmTiming timing = {24, start, rate, AtEnd::loop};
        for (int k = 0; k < 2 * kFrames; ++k) {
          const double t = start + k * (static_cast<double>(denominator) / numerator) / rate;
          ASSERT_EQ(frame_at(times, timing, t), static_cast<std::size_t>(k % kFrames))
              << numerator << "/" << denominator << " start " << start << " rate " << rate << " frame " << k;
        }
      }
    }
  }
}

TEST(FilmClock, RateAndStart) {
  const FrameTimes ten = even_times(10, 10);
  EXPECT_EQ(seen(ten, {10, 1, 2, AtEnd::hold}, 0, 8, 5), (Numbers{0, 0, 0, 0, 0, 0, 4, 8}));
  EXPECT_EQ(seen(ten, {10, -0.5, 0.5, AtEnd::hold}, 0, 3, 1), (Numbers{2, 7, 9}));
}

// ------------------------------------------------------------------------------------------------------- GIF

// A frame of a 4-colour GIF whose pixels are all `colour`.
Bytes gif_frame(int left, int top, int width, int height, int colour, int delay, int disposal,
                int transparent = -1) {
  const auto u16 = [](int value) { return u16_le(static_cast<unsigned>(value)); };
  return bytes({0x21, 0xF9, 4, disposal << 2 | (transparent >= 0 ? 1 : 0)}) + u16(delay) +
         bytes({std::max(transparent, 0), 0, 0x2C}) + u16(left) + u16(top) + u16(width) + u16(height) +
         bytes({0}) + gif_codes(std::vector<int>(static_cast<std::size_t>(width * height), colour));
}

Bytes gif_start(int width, int height) {
  return bytes("GIF89a") + u16_le(static_cast<unsigned>(width)) + u16_le(static_cast<unsigned>(height)) +
         bytes({0x81, 0, 0}) + bytes({255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});
}

// Letters of the colours of a 3 × 1 picture: red, green, blue, white, and . for what is transparent.
std::string letters(const Image& image) {
  std::string text;
  for (int x = 0; x < image.width(); ++x) {
    const auto part = [&](int c) { return image.value(x, 0, c) > 0.5F; };
    text += !part(3) ? '.' : part(0) && part(1) ? 'w' : part(0) ? 'r' : part(1) ? 'g' : 'b';
  }
  return text;
}

Bytes disposals_gif() {
  return gif_start(3, 1) + gif_frame(0, 0, 2, 1, 0, 5, 1) +  // stays
         gif_frame(1, 0, 2, 1, 1, 0, 2) +                    // cleared afterwards
         gif_frame(2, 0, 1, 1, 2, 1, 3) +                    // restored afterwards
         gif_frame(0, 0, 3, 1, 3, 20, 0, 3) +                // all transparent
         gif_frame(1, 0, 1, 1, 3, 10, 0) + bytes({0x3B});
}

TEST(GifFilm, DisposalAndDelays) {
  const OpenedFilm film = open_gif(disposals_gif(), "a.gif");
  ASSERT_TRUE(film) << to_string(film.error());
  EXPECT_TRUE((*film)->warnings().empty());
  EXPECT_EQ((*film)->header().frames, 5U);
  EXPECT_EQ((*film)->header().format, "GIF");
  // A delay of 0 or 1 hundredths is taken for 10.
  EXPECT_EQ((*film)->times().begins, (std::vector<double>{0, 0.05, 0.15, 0.25, 0.45}));
  EXPECT_EQ((*film)->times().duration, 0.55);
  const std::vector<std::string> expected = {"rr.", "rgg", "r.b", "r..", "rw."};
  // Forward, backward, and again.
  for (const std::size_t number : {0, 1, 2, 3, 4, 4, 3, 2, 1, 0, 3, 1, 4, 2})
    EXPECT_EQ(letters((*film)->read(number).value()), expected[number]) << number;
}

TEST(GifFilm, ItsFirstFrameIsTheStill) {
  const Bytes file = disposals_gif();
  const Image still = decode_image(file, "a.gif").value();
  const Image frame = open_gif(file, "a.gif").value()->read(0).value();
  EXPECT_TRUE(
      std::equal(still.bytes().begin(), still.bytes().end(), frame.bytes().begin(), frame.bytes().end()));
}

// ------------------------------------------------------------------------------------------------------- sequences

TEST(NumberedFiles, NamesAndNumbers) {
  const auto number = [](const char* pattern, const char* name) {
    return number_in_name(find_number_pattern(pattern).value(), name);
  };
  EXPECT_EQ(number("a.####.png", "a.0012.png"), 12U);
  EXPECT_EQ(number("a.####.png", "a.12345.png"), 12345U);
  EXPECT_FALSE(number("a.####.png", "a.012.png"));
  EXPECT_FALSE(number("a.####.png", "a.00012.png"));
  EXPECT_FALSE(number("a.####.png", "a.0012.jpg"));
  EXPECT_FALSE(number("a.####.png", "a.001x.png"));
  EXPECT_EQ(number("a_%04d.png", "a_0007.png"), 7U);
  EXPECT_EQ(number("a_%d.png", "a_7.png"), 7U);
  EXPECT_FALSE(number("a_%d.png", "a_07.png"));
  EXPECT_FALSE(is_numbered("shots.####/a.png"));
  EXPECT_FALSE(is_numbered("100%.png"));
  EXPECT_TRUE(is_numbered("shots/a.#.png"));
}

// 1 × 1 grey pictures of these levels, named by `first` and up.
void write_levels(const TemporaryFolder& folder, int first, const std::vector<int>& levels) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    std::string number = std::to_string(first + static_cast<int>(i));
    number.insert(0, 4 - number.size(), '0');
    folder.write("f." + number + ".pgm", bytes("P5 1 1 255\n") + bytes({levels[i]}));
  }
}

TEST(SequenceFilm, StartsAnywhere) {
  const TemporaryFolder folder;
  write_levels(folder, 98, {10, 20, 30, 40});
  const OpenedFilm film = open_film(folder / "f.####.pgm", 25);
  ASSERT_TRUE(film) << to_string(film.error());
  EXPECT_EQ((*film)->header().format, "numbered PNM");
  EXPECT_EQ((*film)->header().frames, 4U);
  EXPECT_EQ((*film)->header().duration, 4 / 25.0);
  EXPECT_EQ((*film)->read(2)->values<std::uint8_t>()[0], 30);
  EXPECT_EQ((*film)->read(0)->values<std::uint8_t>()[0], 10);
  const OpenedFilm one = open_film(folder / "f.0099.pgm", 25);
  ASSERT_TRUE(one);
  EXPECT_EQ((*one)->header().frames, 1U);
}

// ------------------------------------------------------------------------------------------------------- ahead

// Frames of 16 × 16, frame k of level k, that remembers what was asked for.
class CountingReader final : public FrameReader {
 public:
  explicit CountingReader(std::size_t frames) {
    times_ = even_times(frames, 10);
    header_ = {"counting", 16, 16, frames, times_.duration};
  }
  Result<Image> read(std::size_t number) override {
    asked.push_back(number);
    Image image(16, 16, 3, PixelType::u8, Transfer::srgb);
    std::ranges::fill(image.values<std::uint8_t>(), static_cast<std::uint8_t>(number));
    return image;
  }
  std::vector<std::size_t> asked;  // read after the film is gone, or while it is at rest
};

std::unique_ptr<Film> counting_film(CountingReader*& reader, FilmTiming timing, FilmLimits limits = {}) {
  auto made = std::make_unique<CountingReader>(40);
  reader = made.get();
  return std::make_unique<Film>(std::move(made), "counting", timing, std::vector{MipUse::data},
                                best_instruction_set(), limits);
}

int level(const FilmFrame& frame) {
  return static_cast<int>(std::lround(texel(frame.chains.at(MipUse::data), 0, 0, 0)[0] * 255));
}

// Until the film's thread has nothing to do.
void wait_for(const Film& film, std::size_t frames) {
  while (film.holding().frames < frames) std::this_thread::yield();
}

TEST(FilmAhead, MakesTheNextFramesReady) {
  CountingReader* reader = nullptr;
  const auto film = counting_film(reader, {}, {3, std::size_t{1} << 20U});
  EXPECT_EQ(level(*film->at(0).value()), 0);
  EXPECT_EQ(film->holding().frames, 1U);  // no way is known yet
  EXPECT_EQ(level(*film->at(0.2).value()), 2);
  wait_for(*film, 4);
  EXPECT_EQ(reader->asked, (std::vector<std::size_t>{0, 2, 4, 6, 8}));
  EXPECT_EQ(level(*film->at(0.4).value()), 4);
  wait_for(*film, 4);
  EXPECT_EQ(reader->asked, (std::vector<std::size_t>{0, 2, 4, 6, 8, 10}));
  // Backward, across the beginning.
  EXPECT_EQ(level(*film->at(0.3).value()), 3);
  wait_for(*film, 4);
  EXPECT_EQ(level(*film->at(0.2).value()), 2);
  wait_for(*film, 3);
  EXPECT_EQ(level(*film->at(0.1).value()), 1);
}

TEST(FilmAhead, KnowsTheWayRoundALoop) {
  CountingReader* reader = nullptr;
  const auto film = counting_film(reader, {24, 0, 1, AtEnd::loop}, {3, std::size_t{1} << 20U});
  EXPECT_EQ(level(*film->at(3.7).value()), 37);
  EXPECT_EQ(level(*film->at(3.8).value()), 38);
  wait_for(*film, 4);
  EXPECT_EQ(reader->asked, (std::vector<std::size_t>{37, 38, 39, 0, 1}));
}

TEST(FilmAhead, HoldsNoMoreThanItMay) {
  CountingReader* reader = nullptr;
  const std::size_t each = [&] {
    const auto film = counting_film(reader, {});
    return film->at(0).value()->memory_bytes();
  }();
  for (const std::size_t room : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
    const auto film = counting_film(reader, {}, {8, room * each + each / 2});
    for (int k = 0; k < 20; ++k) {
      EXPECT_EQ(level(*film->at(k / 10.0).value()), k);
      if (k > 0) wait_for(*film, room);
      EXPECT_LE(film->holding().frames, room);
      EXPECT_LE(film->holding().bytes, room * each + each / 2);
    }
  }
  // Even where there is no room, the frame that is shown is there.
  const auto film = counting_film(reader, {}, {8, 0});
  EXPECT_EQ(level(*film->at(0).value()), 0);
  EXPECT_EQ(level(*film->at(0.1).value()), 1);
  EXPECT_EQ(film->holding().frames, 1U);
}

TEST(FilmAhead, DarknessIsAsLargeAsTheFilm) {
  CountingReader* reader = nullptr;
  const auto film = counting_film(reader, {24, 1, 1, AtEnd::black});
  const auto frame = film->at(0.5).value();
  EXPECT_FALSE(frame->number);
  EXPECT_EQ(frame->chains.at(MipUse::data).width(), 16);
  EXPECT_EQ(level(*frame), 0);
  EXPECT_TRUE(reader->asked.empty());
}

}  // namespace
}  // namespace laterna::image
