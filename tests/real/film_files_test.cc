// Films under ../shared/scenes/video.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "image/frame_reader.h"
#include "unit/test_films.h"

namespace laterna::image {
namespace {

std::filesystem::path film_file(const char* name) {
  return std::filesystem::path(LATERNA_SHARED_DIR) / "scenes/video" / name;
}

TEST(FilmFiles, Lightning) {
  const std::filesystem::path file = film_file("lightning_33049.mp4");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  if (!testing::has_video()) GTEST_SKIP() << video_support().description;
  const OpenedFilm film = open_film(file, 24);
  ASSERT_TRUE(film) << to_string(film.error());
  EXPECT_TRUE((*film)->warnings().empty());
  EXPECT_EQ((*film)->header().width, 1280);
  EXPECT_EQ((*film)->header().height, 720);
  ASSERT_EQ((*film)->header().frames, 201U);
  for (std::size_t k = 0; k < 201; ++k) EXPECT_EQ((*film)->times().begins[k], static_cast<double>(k) / 30);
  // The same pixels forward, and from behind.
  std::map<std::size_t, Image> forward;
  for (std::size_t k = 0; k < 60; ++k) {
    Result<Image> frame = (*film)->read(k);
    ASSERT_TRUE(frame) << to_string(frame.error());
    if (k % 7 == 0) forward.emplace(k, std::move(*frame));
  }
  for (const std::size_t k : {56, 28, 35, 14}) {
    const Result<Image> again = (*film)->read(k);
    ASSERT_TRUE(again) << to_string(again.error());
    EXPECT_TRUE(std::ranges::equal(again->bytes(), forward.at(k).bytes())) << k;
  }
}

TEST(FilmFiles, AnimatedGif) {
  const std::filesystem::path file = film_file("no_time_for_that_tiny.gif");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const OpenedFilm film = open_film(file, 24);
  ASSERT_TRUE(film) << to_string(film.error());
  EXPECT_TRUE((*film)->warnings().empty());
  EXPECT_GT((*film)->header().frames, 1U);
  for (std::size_t k = 0; k < (*film)->header().frames; ++k) {
    const Result<Image> frame = (*film)->read(k);
    ASSERT_TRUE(frame) << to_string(frame.error());
    EXPECT_EQ(frame->width(), (*film)->header().width);
  }
}

}  // namespace
}  // namespace laterna::image
