// Films out: colours in integers, palettes, files that hold what was put in, and what remains of films that were broken off.
#include "laterna/video.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <set>

#include "image/frame_reader.h"
#include "image/palette.h"
#include "image/video_planes.h"
#include "unit/temporary_folder.h"
#include "unit/test_films.h"

namespace laterna::image {
namespace {

using namespace laterna::testing;
using Names = std::vector<std::string>;

// A bright disc that moves over a slow gradient.
Image disc_frame(int width, int height, int k) {
  Image frame(width, height, 3, PixelType::u8, Transfer::srgb);
  std::size_t at = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int dx = x - 12 - 5 * k, dy = y - height / 2;
      const int light = std::max(0, 150 - dx * dx - dy * dy);
      for (const int base : {40 + x, 60 + y, 90}) {
        frame.values<std::uint8_t>()[at++] = static_cast<std::uint8_t>(std::min(255, base + light));
      }
    }
  }
  return frame;
}

// Any colour anywhere: worst for what compresses, and for codes of growing width.
Image noise_frame(int width, int height, unsigned colours) {
  Image frame(width, height, 3, PixelType::u8, Transfer::srgb);
  std::uint32_t state = 12345;
  std::size_t at = 0;
  for (int i = 0; i < width * height; ++i) {
    state = state * 1664525U + 1013904223U;
    const std::uint32_t colour = state >> 8U;
    const unsigned place = colour % colours;
    for (unsigned c = 0; c < 3; ++c)
      frame.values<std::uint8_t>()[at++] = static_cast<std::uint8_t>(place * (37U + 2 * c) + 11 * c);
  }
  return frame;
}

std::vector<std::uint8_t> rgb_of(const Image& image) {
  const auto step = static_cast<std::size_t>(image.channels());
  const std::span<const std::uint8_t> values = image.values<std::uint8_t>();
  std::vector<std::uint8_t> rgb;
  for (std::size_t i = 0; i < values.size(); i += step)
    rgb.insert(rgb.end(), {values[i], values[i + 1], values[i + 2]});
  return rgb;
}

double psnr(const Image& a, const Image& b) {
  const std::vector<std::uint8_t> first = rgb_of(a), second = rgb_of(b);
  double squares = 0;
  for (std::size_t i = 0; i < first.size(); ++i) squares += std::pow(first[i] - second[i], 2);
  return 10 * std::log10(255 * 255 * static_cast<double>(first.size()) / squares);
}

std::string text_of(const Result<void>& result) { return result ? "no error" : to_string(result.error()); }

Result<void> write_discs(const std::filesystem::path& file, int frames, const VideoOptions& options) {
  Result<VideoWriter> film = VideoWriter::create(file, 96, 64, options);
  if (!film) return tl::unexpected(film.error());
  for (int k = 0; k < frames; ++k) {
    if (Result<void> written = film->write(disc_frame(96, 64, k)); !written) return written;
  }
  return film->finish();
}

// ------------------------------------------------------------------------------------------------------- colours

// The standard's equations in floating point: never more than rounding apart. ITU-R BT.709-6, items 3.2 to 3.5.
TEST(VideoPlanes, FollowTheStandard) {
  for (unsigned i = 0; i < 4096; ++i) {
    const std::array<int, 3> code = {static_cast<int>(i % 16 * 17), static_cast<int>(i / 16 % 16 * 17),
                                     static_cast<int>(i / 256 * 17)};
    Image frame(2, 2, 3, PixelType::u8, Transfer::srgb);
    for (std::size_t v = 0; v < 12; ++v)
      frame.values<std::uint8_t>()[v] = static_cast<std::uint8_t>(code[v % 3]);
    VideoPlanes planes(2, 2);
    planes.convert(frame);
    const double r = code[0] / 255.0, g = code[1] / 255.0, b = code[2] / 255.0;
    const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    ASSERT_LE(std::abs(planes.y().values[3] - (16 + 219 * y)), 0.5 + 1e-6);
    ASSERT_LE(std::abs(planes.cb().values[0] - (128 + 224 * (b - y) / 1.8556)), 0.5 + 1e-6);
    ASSERT_LE(std::abs(planes.cr().values[0] - (128 + 224 * (r - y) / 1.5748)), 0.5 + 1e-6);
  }
}

TEST(VideoPlanes, BlackWhiteAndChromaOfAMean) {
  Image frame(4, 2, 3, PixelType::u8, Transfer::srgb);
  const std::span<std::uint8_t> v = frame.values<std::uint8_t>();
  for (std::size_t i = 0; i < 6; ++i)
    v[i] = 255;                           // the upper left two pixels are white, the two under them black
  v[6 + 2] = v[9 + 2] = v[18 + 2] = 255;  // three blue ones on the right
  VideoPlanes planes(4, 2);
  planes.convert(frame);
  EXPECT_EQ(planes.y().values, (std::vector<std::uint8_t>{235, 235, 32, 32, 16, 16, 32, 16}));
  EXPECT_EQ(planes.cb().values, (std::vector<std::uint8_t>{128, 212}));  // 128 + 112 · ¾
  EXPECT_EQ(planes.cr().values[0], 128);
}

// ------------------------------------------------------------------------------------------------------- palettes

TEST(Palette, KeepsFewColoursAndSpendsManyWhereTheyAre) {
  const Image few = noise_frame(64, 64, 200);
  const PalettePicture kept = reduce_colours(few);
  EXPECT_EQ(kept.colours.size(), 200U);
  for (std::size_t i = 0; i < kept.pixels.size(); ++i) {
    const Rgb colour = kept.colours[kept.pixels[i]];
    for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(colour[c], few.values<std::uint8_t>()[3 * i + c]);
  }
  const Image many = disc_frame(256, 192, 7);
  const PalettePicture reduced = reduce_colours(many);
  EXPECT_EQ(reduced.colours.size(), 256U);
  // Dithering costs nearness of single pixels, not of means: each block of 8 × 8 keeps its own.
  double worst = 0;
  for (int top = 0; top < 192; top += 8) {
    for (int left = 0; left < 256; left += 8) {
      double sum = 0;
      for (int y = top; y < top + 8; ++y) {
        for (int x = left; x < left + 8; ++x) {
          const std::size_t i = static_cast<std::size_t>(y) * 256 + static_cast<std::size_t>(x);
          sum += reduced.colours[reduced.pixels[i]][0] - many.value(x, y, 0) * 255;
        }
      }
      worst = std::max(worst, std::abs(sum) / 64);
    }
  }
  EXPECT_LT(worst, 6);
}

// ------------------------------------------------------------------------------------------------------- files

TEST(VideoWriter, GifHoldsTheFramesAndTheirTimes) {
  const TemporaryFolder folder;
  Result<VideoWriter> film = VideoWriter::create(folder / "a.gif", 200, 150, {});
  ASSERT_TRUE(film);
  std::vector<Image> frames;
  for (const unsigned colours : {256U, 256U, 3U, 2U, 1U, 129U})
    frames.push_back(noise_frame(200, 150, colours));
  for (const Image& frame : frames) ASSERT_TRUE(film->write(frame));
  EXPECT_EQ(film->frames(), 6);
  ASSERT_TRUE(film->finish());
  EXPECT_EQ(folder.names(), Names{"a.gif"});
  const OpenedFilm read = open_film(folder / "a.gif", 24);
  ASSERT_TRUE(read);
  EXPECT_TRUE((*read)->warnings().empty());
  ASSERT_EQ((*read)->header().frames, 6U);
  EXPECT_EQ((*read)->times().begins, (std::vector<double>{0, 0.04, 0.08, 0.13, 0.17, 0.21}));
  EXPECT_EQ((*read)->header().duration, 0.25);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(rgb_of(*(*read)->read(k)), rgb_of(frames[k])) << k;
}

TEST(VideoWriter, GifOfManyColoursIsNear) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_discs(folder / "a.gif", 3, {.codec = "gif", .rate = {50, 1}}));
  const OpenedFilm read = open_film(folder / "a.gif", 24);
  ASSERT_TRUE(read);
  EXPECT_EQ((*read)->header().duration, 0.06);
  for (int k = 0; k < 3; ++k)
    EXPECT_GT(psnr(*(*read)->read(static_cast<std::size_t>(k)), disc_frame(96, 64, k)), 34) << k;
}

// What comes back is within the codec's error; of FFV1, what was put in, bit for bit.
TEST(VideoWriter, VideosHoldTheFramesAndTheirTimes) {
  if (!has_video()) GTEST_SKIP() << video_support().description;
  struct Case {
    const char *codec, *file;
    double least_psnr;
  };
  const TemporaryFolder folder;
  int tried = 0;
  for (const Case& test : {Case{"ffv1", "a.mkv", INFINITY}, Case{"h264", "b.mp4", 38},
                           Case{"h264", "c.mkv", 38}, Case{"vp9", "d.webm", 36}, Case{"h265", "e.mp4", 38}}) {
    bool is_there = false;
    for (const VideoCodec& codec : list_video_codecs())
      is_there |= codec.name == test.codec && codec.is_there;
    if (!is_there) continue;
    ++tried;
    const Result<void> written =
        write_discs(folder / test.file, 12, {.codec = test.codec, .rate = {25, 2}, .most_frames = 12});
    ASSERT_TRUE(written) << text_of(written);
    const OpenedFilm read = open_film(folder / test.file, 24);
    ASSERT_TRUE(read) << test.file;
    EXPECT_TRUE((*read)->warnings().empty()) << test.file;
    ASSERT_EQ((*read)->header().frames, 12U) << test.file;
    EXPECT_NEAR((*read)->header().duration, 12 / 12.5, 1e-3);
    for (int k = 0; k < 12; ++k) {
      EXPECT_NEAR((*read)->times().begins[static_cast<std::size_t>(k)], k / 12.5,
                  5.1e-4);  // Matroska counts milliseconds
      EXPECT_GE(psnr(*(*read)->read(static_cast<std::size_t>(k)), disc_frame(96, 64, k)), test.least_psnr)
          << test.file << " " << k;
    }
  }
  EXPECT_GE(tried, 1);  // FFV1 is FFmpeg's own
}

// A linear picture becomes the pixels that its PNG has.
TEST(VideoWriter, TakesWhatAPngTakes) {
  if (!has_video()) GTEST_SKIP() << video_support().description;
  const TemporaryFolder folder;
  LayeredImage picture;
  picture.width = 5;
  picture.height = 3;
  for (const char* name : {"R", "G", "B", "Z"}) picture.channels.push_back({name, std::vector<float>(15)});
  for (std::size_t i = 0; i < 45; ++i) picture.channels[i % 3].values[i / 3] = static_cast<float>(i) / 30;
  Result<VideoWriter> film = VideoWriter::create(folder / "a.mkv", 5, 3, {.codec = "ffv1"});
  ASSERT_TRUE(film) << to_string(film.error());
  ASSERT_TRUE(film->write(picture, 0.5F));
  ASSERT_TRUE(film->finish());
  picture.channels.pop_back();
  ASSERT_TRUE(write_image(picture, folder / "a.png", {.exposure = 0.5F}));
  const OpenedFilm read = open_film(folder / "a.mkv", 24);
  ASSERT_TRUE(read);
  EXPECT_EQ(rgb_of(*(*read)->read(0)), rgb_of(*read_image(folder / "a.png")));
}

// ------------------------------------------------------------------------------------------------------- broken off

TEST(VideoWriter, AFilmThatIsNotFinishedIsNotThere) {
  const TemporaryFolder folder;
  folder.write("a.gif", std::string_view("before"));
  {
    Result<VideoWriter> film = VideoWriter::create(folder / "a.gif", 96, 64, {});
    ASSERT_TRUE(film);
    ASSERT_TRUE(film->write(disc_frame(96, 64, 0)));
  }
  EXPECT_EQ(folder.names(), Names{"a.gif"});
  EXPECT_EQ(std::filesystem::file_size(folder / "a.gif"), 6U);
  ASSERT_TRUE(check_video_output(folder / "a.gif", 96, 64, {}));
  EXPECT_EQ(std::filesystem::file_size(folder / "a.gif"), 6U);
}

TEST(VideoWriter, KeepsWhatThereIsUnderAnotherName) {
  const bool has_encoders = has_video();
  for (const char* const ending : {".gif", ".mkv"}) {
    if (!has_encoders && ending != std::string(".gif")) continue;
    const TemporaryFolder folder;
    Result<VideoWriter> film = VideoWriter::create(folder / (std::string("a") + ending), 96, 64,
                                                   {.codec = ending == std::string(".mkv") ? "ffv1" : ""});
    ASSERT_TRUE(film);
    for (int k = 0; k < 5; ++k) ASSERT_TRUE(film->write(disc_frame(96, 64, k)));
    const Result<std::filesystem::path> kept = film->keep_incomplete();
    ASSERT_TRUE(kept) << to_string(kept.error());
    EXPECT_EQ(folder.names(), Names{std::string("a.incomplete") + ending});
    const OpenedFilm read = open_film(*kept, 24);
    ASSERT_TRUE(read);
    EXPECT_EQ((*read)->header().frames, 5U);
    EXPECT_TRUE((*read)->warnings().empty());
  }
  const TemporaryFolder folder;
  Result<VideoWriter> film = VideoWriter::create(folder / "a.gif", 96, 64, {});
  ASSERT_TRUE(film);
  EXPECT_FALSE(film->keep_incomplete());
  EXPECT_FALSE(VideoWriter::create(folder / "a.gif", 96, 64, {})->finish());
}

// Files may not grow beyond a limit while it lives.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(VideoWriter, AFullDiskLeavesWhatCanBePlayed) {
  const bool has_encoders = has_video();
  struct Case {
    const char *codec, *file;
  };
  for (const Case& test : {Case{"gif", "a.gif"}, Case{"ffv1", "b.mkv"}, Case{"h264", "c.mp4"}}) {
    const TemporaryFolder folder;
    if (test.codec != std::string("gif") &&
        (!has_encoders || !check_video_output(folder / test.file, 96, 64, {test.codec})))
      continue;
    Result<VideoWriter> film =
        VideoWriter::create(folder / test.file, 128, 128, {.codec = test.codec, .quality = 100});
    ASSERT_TRUE(film);
    Result<void> outcome;
    Result<std::filesystem::path> kept;
    {
      const FullDisk full(200'000);
      for (int k = 0; k < 40 && outcome; ++k)
        outcome = film->write(noise_frame(128, 128, 256 + static_cast<unsigned>(k)));
      if (outcome) outcome = film->finish();
      kept = film->keep_incomplete();
    }
    ASSERT_FALSE(outcome) << test.file;
    EXPECT_EQ(outcome.error().failure, Failure::cannot_write);
    EXPECT_EQ(text_of(outcome), (folder / test.file).string() + ": cannot write: File too large");
    ASSERT_TRUE(kept) << test.file;
    const std::int64_t frames = film->frames();
    EXPECT_GE(frames, 1);
    film = VideoWriter::create(folder / "other.gif", 1, 1, {});  // the unfinished one goes
    const OpenedFilm read = open_film(*kept, 24);
    ASSERT_TRUE(read) << to_string(read.error());
    EXPECT_EQ((*read)->header().frames, static_cast<std::size_t>(frames)) << test.file;
    for (std::size_t k = 0; k < (*read)->header().frames; ++k) {
      const Result<Image> frame = (*read)->read(k);
      EXPECT_TRUE(frame) << test.file << " " << to_string(frame.error());
    }
  }
}

// Where the one that is not finished is.
std::filesystem::path part_in(const TemporaryFolder& folder) {
  for (const std::string& name : folder.names()) {
    if (name.ends_with(".part")) return folder / name;
  }
  return {};
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// What is left when the process is killed after any frame: nothing that was drawn waits in an encoder.
TEST(VideoWriter, EachFrameIsInTheFileOnceItIsWritten) {
  const bool has_encoders = has_video();
  struct Case {
    const char *codec, *file;
  };
  for (const Case& test : {Case{"gif", "a.gif"}, Case{"ffv1", "b.mkv"}, Case{"h264", "c.mp4"},
                           Case{"h264", "d.mkv"}, Case{"vp9", "e.webm"}, Case{"h265", "f.mp4"}}) {
    const TemporaryFolder folder;
    const std::filesystem::path target = folder / test.file;
    if (test.codec != std::string("gif") &&
        (!has_encoders || !check_video_output(target, 96, 64, {test.codec})))
      continue;
    Result<VideoWriter> film = VideoWriter::create(target, 96, 64, {.codec = test.codec});
    ASSERT_TRUE(film);
    for (int k = 0; k < 4; ++k) {
      ASSERT_TRUE(film->write(disc_frame(96, 64, k)));
      const OpenedFilm read = open_film(part_in(folder), 24);
      ASSERT_TRUE(read) << test.file << " " << to_string(read.error());
      ASSERT_EQ((*read)->header().frames, static_cast<std::size_t>(k) + 1) << test.file;
      const Result<Image> last = (*read)->read(static_cast<std::size_t>(k));
      ASSERT_TRUE(last) << test.file;
      EXPECT_GT(psnr(*last, disc_frame(96, 64, k)), 30) << test.file;
    }
    ASSERT_TRUE(film->finish());
    EXPECT_EQ(folder.names(), Names{test.file});
    if (!target.string().ends_with(".mp4")) continue;
    // In one piece, with the index before the frames.
    const std::string bytes = bytes_of(target);
    EXPECT_EQ(bytes.find("moof"), std::string::npos);
    EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
  }
}

TEST(VideoWriter, AnMp4FileForWhichThereIsNoRoomTwiceStaysInFragments) {
  const TemporaryFolder folder;
  if (!has_video() || !check_video_output(folder / "a.mp4", 96, 64, {"h264"})) GTEST_SKIP();
  for (const bool is_full : {false, true}) {
    Result<VideoWriter> film = VideoWriter::create(folder / "a.mp4", 96, 64, {.codec = "h264"});
    ASSERT_TRUE(film);
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(film->write(disc_frame(96, 64, k)));
    {
      // Enough for the end of the fragments, too little for the index that is made room for.
      const FullDisk full(is_full ? std::filesystem::file_size(part_in(folder)) + 1000 : 1U << 30U);
      ASSERT_TRUE(film->finish());
    }
    EXPECT_EQ(folder.names(), Names{"a.mp4"});
    EXPECT_EQ(bytes_of(folder / "a.mp4").find("moof") != std::string::npos, is_full);
    const OpenedFilm read = open_film(folder / "a.mp4", 24);
    ASSERT_TRUE(read);
    EXPECT_EQ((*read)->header().frames, 3U);
    EXPECT_TRUE((*read)->warnings().empty());
  }
}

// ------------------------------------------------------------------------------------------------------- errors

TEST(VideoWriter, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  struct Case {
    const char* file;
    int width, height;
    VideoOptions options;
    const char* message;
  };
  const Case cases[] = {
      {"a.avi", 2, 2, {}, "the name of a film must end in .mp4, .mkv, .webm or .gif"},
      {"a.mp4",
       2,
       2,
       {.codec = "xvid"},
       "there is no codec \"xvid\"; there are h264, vp9, h265, ffv1, gif, and a .mp4 file holds h264, h265"},
      {"a.webm",
       2,
       2,
       {.codec = "h264"},
       "a .webm file does not hold h264; give a file that ends in .mp4 .mkv"},
      {"a.mp4",
       65,
       48,
       {},
       "h264 keeps one colour for 2 x 2 pixels, so that width and height must be even, got 65 x 48: take 66 "
       "x 48, or the codec ffv1"},
      {"a.gif", 0, 48, {}, "expected a size from 1 x 1 to 65535 x 65535 pixels, got 0 x 48"},
      {"a.gif", 65536, 1, {}, "expected a size from 1 x 1 to 65535 x 65535 pixels, got 65536 x 1"},
      {"a.gif", 2, 2, {.quality = 101}, "expected a quality from 0 to 100, got 101"},
      {"a.gif", 2, 2, {.rate = {51, 1}}, "a GIF shows at most 50 frames per second, got 51"},
      {"a.mp4",
       2,
       2,
       {.rate = {25, 0}},
       "expected frames per second greater than 0, at most 1e+06, got 25/0"},
      {"a.mp4",
       2,
       2,
       {.rate = {2000001, 2}},
       "expected frames per second greater than 0, at most 1e+06, got 2000001/2"},
      {"a.gif", 2, 2, {.most_frames = -1}, "the number of frames must be from 0 to 2147483648, not -1"},
      {"a.mp4",
       2,
       2,
       {.most_frames = kMaxVideoFrames + 1},
       "the number of frames must be from 0 to 2147483648, not 2147483649"},
  };
  for (const Case& test : cases) {
    const Result<void> checked =
        check_video_output(folder / test.file, test.width, test.height, test.options);
    ASSERT_FALSE(checked) << test.file;
    EXPECT_EQ(checked.error().failure, Failure::bad_usage);
    EXPECT_EQ(text_of(checked), (folder / test.file).string() + ": " + test.message);
  }
  EXPECT_EQ(check_video_output(folder / "no/a.gif", 2, 2).error().failure, Failure::cannot_write);
  std::filesystem::create_symlink("/dev/null", folder / "null.gif");
  EXPECT_EQ(
      text_of(check_video_output(folder / "null.gif", 2, 2)),
      (folder / "null.gif").string() + ": a film is written to a regular file, not to a pipe or device");
  Result<VideoWriter> film = VideoWriter::create(folder / "a.gif", 4, 4, {.most_frames = 1});
  ASSERT_TRUE(film);
  EXPECT_NE(text_of(film->write(disc_frame(4, 6, 0))).find("expected frames of 4 x 4 pixels"),
            std::string::npos);
  EXPECT_NE(
      text_of(film->write(Image(4, 4, 4, PixelType::u8, Transfer::srgb))).find("got 4 x 4 with 4 channels"),
      std::string::npos);
  EXPECT_TRUE(film->write(disc_frame(4, 4, 0)));
  EXPECT_NE(text_of(film->write(disc_frame(4, 4, 1))).find("at most 1 frames"), std::string::npos);
}

}  // namespace
}  // namespace laterna::image
