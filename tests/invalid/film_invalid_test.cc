// Films that are damaged, cut short or something else: what is said, and what is still shown.
#include <gtest/gtest.h>

#include <random>

#include "base/file_io.h"
#include "image/frame_reader.h"
#include "unit/image_bytes.h"
#include "unit/test_films.h"

namespace laterna::image {
namespace {

using namespace laterna::testing;

std::string message(const OpenedFilm& film) { return film ? "it opened" : to_string(film.error()); }

// Two frames of 2 × 1.
Bytes two_frames() {
  const Bytes pixels = u16_le(0) + u16_le(0) + u16_le(2) + u16_le(1) + bytes({0}) + gif_codes({1, 2});
  return bytes("GIF89a") + u16_le(2) + u16_le(1) + bytes({0x81, 0, 0}) +
         bytes({255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}) + bytes({0x2C}) + pixels +
         bytes({0x21, 0xF9, 4, 0, 7, 0, 0, 0, 0x2C}) + pixels + bytes({0x3B});
}

// The film goes as far as there are whole frames, and says so; without one it is no film.
TEST(InvalidFilm, EveryTruncationOfAGif) {
  const Bytes whole = two_frames();
  const std::size_t second = whole.size() - 1;  // where the second frame's blocks end
  const std::size_t one = 25 + 10 + gif_codes({1, 2}).size();
  for (std::size_t size = 6; size < whole.size(); ++size) {
    const OpenedFilm film = open_gif(first(whole, size), "a.gif");
    if (size < one) {
      ASSERT_FALSE(film) << size;
      EXPECT_EQ(message(film).rfind("a.gif: ", 0), 0U) << size;
      continue;
    }
    ASSERT_TRUE(film) << size << message(film);
    ASSERT_EQ((*film)->warnings().size(), 1U);
    const std::string place = "a.gif: byte " + std::to_string(size) + ": the file ends here, inside ";
    const bool has_both = size >= second;
    EXPECT_EQ((*film)->header().frames, has_both ? 2U : 1U) << size;
    EXPECT_EQ(to_string((*film)->warnings()[0]).rfind(place, 0), 0U) << to_string((*film)->warnings()[0]);
    EXPECT_NE(to_string((*film)->warnings()[0])
                  .find(has_both ? ": the film has 2 whole frames" : ": the film has 1 whole frame"),
              std::string::npos);
    for (std::size_t k = 0; k < (*film)->header().frames; ++k) EXPECT_TRUE((*film)->read(k)) << size;
  }
}

TEST(InvalidFilm, DamageInALaterFrameOfAGif) {
  Bytes file = two_frames();
  file[file.size() - 1 - gif_codes({1, 2}).size() + 2] = std::byte{0xFF};  // first codes of the second frame
  const OpenedFilm film = open_gif(file, "a.gif");
  ASSERT_TRUE(film) << message(film);
  EXPECT_TRUE((*film)->read(0));
  const Result<Image> second = (*film)->read(1);
  ASSERT_FALSE(second);
  EXPECT_NE(to_string(second.error()).find("the compressed pixels are damaged"), std::string::npos);
  EXPECT_TRUE((*film)->read(0));
}

TEST(InvalidFilm, Sequences) {
  const TemporaryFolder folder;
  const auto said = [&](const char* pattern) {
    std::string text = message(open_film(folder / pattern, 24));
    for (std::size_t at; (at = text.find(folder.path().string() + "/")) != std::string::npos;)
      text.erase(at, folder.path().string().size() + 1);
    return text;
  };
  const Bytes pixel = bytes("P5 1 1 255\n") + bytes({7});
  folder.write("a.01.pgm", pixel);
  folder.write("a.02.pgm", pixel);
  folder.write("a.04.pgm", pixel);
  folder.write("b.1.pgm", pixel);
  folder.write("b.2.pgm", bytes("P5 2 1 255\n") + bytes({7, 8}));
  folder.write("c.1.pgm", std::string_view("rubbish"));
  EXPECT_EQ(said("a.##.pgm"), "a.##.pgm: number 3 is missing: there are 1 to 4");
  EXPECT_EQ(said("a.#.#.pgm"),
            "a.#.#.pgm: expected one place for a number, as in frame.####.png, got several");
  EXPECT_EQ(said("x.%03d.pgm"), "x.%03d.pgm: no file fits this pattern of numbers");
  EXPECT_EQ(said("nowhere/x.#.pgm"), "nowhere: cannot be read: No such file or directory");
  EXPECT_EQ(
      said("c.#.pgm"),
      "c.1.pgm: expected a PNG, JPEG, GIF, BMP, TGA, PCX, PNM, PFM, Radiance HDR or OpenEXR picture, found "
      "none of these");
  EXPECT_EQ(said("missing.mp4"), "missing.mp4: cannot open: No such file or directory");
  const OpenedFilm film = open_film(folder / "b.#.pgm", 24);
  ASSERT_TRUE(film) << message(film);
  EXPECT_TRUE((*film)->read(0));
  const Result<Image> other_size = (*film)->read(1);
  ASSERT_FALSE(other_size);
  EXPECT_NE(to_string(other_size.error())
                .find("b.2.pgm: expected 1 x 1 pixels as in the film's first picture, found 2 x 1"),
            std::string::npos);
}

TEST(InvalidFilm, WithoutThePlugin) {
  // What a build without FFmpeg says cannot be had beside one with it, for a process loads the plug-in once; so in a child.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        setenv("LATERNA_PLUGINS", "/nowhere", 1);
        const VideoSupport support = video_support();
        std::fprintf(stderr, "%s", support.description.c_str());
        std::exit(support.is_there ? 1 : 0);
      },
      ::testing::ExitedWithCode(0),
      "videos need the plug-in liblaterna_ffmpeg.so.*install libavformat-dev, libavcodec-dev and "
      "libavutil-dev.*"
      "/nowhere/liblaterna_ffmpeg.so");
}

class InvalidVideo : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_video()) GTEST_SKIP() << video_support().description;
  }
};

TEST_F(InvalidVideo, Rubbish) {
  const TemporaryFolder folder;
  const std::filesystem::path text = folder.write("a.mp4", std::string_view("this is no film at all"));
  EXPECT_EQ(message(open_film(text, 24)),
            text.string() + ": FFmpeg does not read it as a film: Invalid data found when processing input");
}

// What can be shown is what the whole film shows; what cannot is an error with its place, and a film that ends early says so.
TEST_F(InvalidVideo, EveryTruncation) {
  const Bytes whole = read_file(test_film("steps.mp4")).value();
  const TemporaryFolder folder;
  std::vector<Image> frames;
  const OpenedFilm good = open_film(test_film("steps.mp4"), 24);
  ASSERT_TRUE(good) << message(good);
  for (std::size_t k = 0; k < 24; ++k) frames.push_back((*good)->read(k).value());
  bool has_warned = false;
  for (std::size_t size = 0; size < whole.size(); size += size < 1000 ? 37 : 11) {
    const std::filesystem::path file = folder.write("cut.mp4", first(whole, size));
    const OpenedFilm film = open_film(file, 24);
    if (!film) {
      EXPECT_EQ(message(film).rfind(file.string() + ": ", 0), 0U) << message(film);
      continue;
    }
    const std::size_t count = (*film)->header().frames;
    if (count < 24) {
      ASSERT_EQ((*film)->warnings().size(), 1U) << size;
      EXPECT_EQ(to_string((*film)->warnings()[0]),
                file.string() + ": the film ends early, after " + std::to_string(count) + " of 24 frames");
      has_warned = true;
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Result<Image> frame = (*film)->read(k);
      if (!frame) {
        EXPECT_EQ(to_string(frame.error()).rfind(file.string() + ": at ", 0), 0U) << to_string(frame.error());
      } else if (k + 3 < count) {  // the last group may lack what its frames are made from
        EXPECT_TRUE(std::ranges::equal(frame->bytes(), frames[k].bytes())) << size << " " << k;
      }
    }
  }
  EXPECT_TRUE(has_warned);
}

// Bytes changed at random never bring the process down.
TEST_F(InvalidVideo, ChangedBytes) {
  const TemporaryFolder folder;
  std::mt19937 random(1);
  for (const char* name : {"steps.mp4", "uneven.mkv", "counted.avi", "ten_bits.mkv"}) {
    const Bytes whole = read_file(test_film(name)).value();
    for (int i = 0; i < 60; ++i) {
      Bytes changed = whole;
      for (int j = 0; j < 4; ++j)
        changed[random() % changed.size()] = static_cast<std::byte>(random() & 255U);
      const OpenedFilm film = open_film(folder.write(name, changed), 24);
      if (!film) continue;
      for (std::size_t k = 0; k < std::min<std::size_t>((*film)->header().frames, 30); ++k)
        (void)(*film)->read(k);
    }
  }
}

}  // namespace
}  // namespace laterna::image
