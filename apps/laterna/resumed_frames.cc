#include "resumed_frames.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

#include "laterna/image.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

// Removed when it is no longer needed.
class TemporaryPicture {
 public:
  explicit TemporaryPicture(const std::filesystem::path& like)
      : file_(std::filesystem::temp_directory_path() /
              fmt::format("laterna-resume-{}{}", ::getpid(), like.extension().string())) {}
  TemporaryPicture(const TemporaryPicture&) = delete;
  TemporaryPicture& operator=(const TemporaryPicture&) = delete;
  ~TemporaryPicture() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

bool have_same_bytes(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return std::equal(Bytes(first), Bytes(), Bytes(second), Bytes());
}

// Another version of a compressor may pack the same picture in other bytes.
Result<bool> hold_same_picture(const std::filesystem::path& a, const std::filesystem::path& b) {
  if (have_same_bytes(a, b)) return true;
  const Result<LayeredImage> first = read_layered_image(a, ChannelValues::stored);
  if (!first) return tl::unexpected(first.error());
  const Result<LayeredImage> second = read_layered_image(b, ChannelValues::stored);
  if (!second) return tl::unexpected(second.error());
  const Result<Comparison> compared = compare_images(*first, *second, {});
  return compared && compared->difference.max_error == 0;
}

}  // namespace

std::vector<bool> find_finished(const std::vector<TimedOutput>& outputs) {
  std::vector<bool> is_finished;
  is_finished.reserve(outputs.size());
  std::error_code ignored;
  for (const TimedOutput& output : outputs)
    is_finished.push_back(std::filesystem::is_regular_file(output.file, ignored));
  return is_finished;
}

Result<void> check_finished(const TimedOutput& last,
                            const std::function<Result<void>(const std::filesystem::path& file)>& draw_as) {
  const TemporaryPicture anew(last.file);
  if (Result<void> drawn = draw_as(anew.file()); !drawn) return drawn;
  const Result<bool> is_same = hold_same_picture(last.file, anew.file());
  if (!is_same) return tl::unexpected(is_same.error());
  if (*is_same) return {};
  return tl::unexpected(Error(
      Failure::bad_usage,
      Diagnostic{
          last.file,
          {},
          "--resume: this frame is not what is drawn now: the scene, the options or laterna have changed "
          "since; remove the frames that are there, or leave --resume out to draw all anew"}));
}

}  // namespace laterna::app
