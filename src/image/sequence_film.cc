// Films of numbered pictures, and of one picture.
#include <utility>

#include "image/frame_reader.h"
#include "image/numbered_files.h"

namespace laterna::image {
namespace {

class SequenceReader final : public FrameReader {
 public:
  explicit SequenceReader(std::vector<std::filesystem::path> files) : files_(std::move(files)) {}

  // The first picture tells what all must be.
  Result<void> open(double frames_per_second) {
    const Result<ImageHeader> first = read_image_header(files_.front());
    if (!first) return tl::unexpected(first.error());
    times_ = even_times(files_.size(), frames_per_second);
    header_ = {"numbered " + first->format, first->width, first->height, files_.size(), times_.duration};
    return {};
  }

  Result<Image> read(std::size_t number) override {
    Result<Image> image = read_image(files_[number]);
    if (image && (image->width() != header_.width || image->height() != header_.height)) {
      const auto size = [](int w, int h) { return std::to_string(w) + " x " + std::to_string(h); };
      return tl::unexpected(
          Error(Failure::bad_input, Diagnostic{files_[number].string(),
                                               {},
                                               "expected " + size(header_.width, header_.height) +
                                                   " pixels as in the film's first picture, found " +
                                                   size(image->width(), image->height())}));
    }
    return image;
  }

 private:
  std::vector<std::filesystem::path> files_;
};

}  // namespace

OpenedFilm open_sequence(const std::filesystem::path& pattern, double frames_per_second) {
  std::vector<std::filesystem::path> files;
  if (is_numbered(pattern)) {
    auto numbered = find_numbered_files(pattern);
    if (!numbered) return tl::unexpected(std::move(numbered.error()));
    for (auto& [number, file] : *numbered) files.push_back(std::move(file));
  } else {
    files.push_back(pattern);
  }
  auto reader = std::make_unique<SequenceReader>(std::move(files));
  if (Result<void> opened = reader->open(frames_per_second); !opened)
    return tl::unexpected(std::move(opened.error()));
  return reader;
}

}  // namespace laterna::image
