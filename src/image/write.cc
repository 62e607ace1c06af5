// Pictures to files: checks, the choice of format by the file's name, and writing.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/output_file.h"
#include "base/without_exceptions.h"
#include "image/encoder.h"
#include "image/file_ending.h"
#include "image/layers.h"

namespace laterna::image {
namespace {

using Encode = Result<EncodedBytes> (*)(const LayeredImage&, const WriteOptions&, std::string_view);

struct WrittenFormat {
  std::string_view ending;
  Encode encode;
};
constexpr std::array<WrittenFormat, 4> kFormats = {
    {{".png", encode_png}, {".exr", encode_exr}, {".hdr", encode_radiance}, {".pfm", encode_pfm}}};

bool is_png(const std::string& name) { return name == "-" || has_ending(name, ".png"); }

Result<Encode> find_encoder(const std::string& name) {
  if (is_png(name)) return kFormats[0].encode;
  const auto found = std::find_if(kFormats.begin(), kFormats.end(), [&](const WrittenFormat& format) {
    return has_ending(name, format.ending);
  });
  if (found == kFormats.end()) return cannot_hold(name, "the name must end in .png, .exr, .hdr or .pfm");
  return found->encode;
}

std::string find_fault(const WriteOptions& options) {
  if (!std::isfinite(options.exposure) || options.exposure < 0)
    return "the exposure must be a factor of 0 or more";
  if (options.threads < 0) return "the number of threads must be 0 or more";
  return {};
}

// True where a PNG can hold the pixels as they are.
bool is_stored_depth(const Image& image, const WriteOptions& options) {
  using Depth = WriteOptions::Depth;
  if (options.exposure != 1 || image.type() == PixelType::f32) return false;
  return options.depth == Depth::automatic ||
         options.depth == (image.type() == PixelType::u8 ? Depth::bits8 : Depth::bits16);
}

Error memory_exhausted(const std::string& name) {
  return {Failure::cannot_write, Diagnostic{name, {}, "not enough memory to encode the picture"}};
}

}  // namespace

}  // namespace laterna::image

namespace laterna {

Result<void> write_image(const LayeredImage& picture, const std::filesystem::path& file,
                         const WriteOptions& options) {
  const std::string name = file.string();
  return without_exceptions(image::memory_exhausted(name), [&]() -> Result<void> {
    const Result<image::Encode> encode = image::find_encoder(name);
    if (!encode) return tl::unexpected(encode.error());
    if (std::string fault = image::find_fault(options); !fault.empty()) {
      return image::cannot_hold(name, std::move(fault));
    }
    if (std::string fault = image::find_picture_fault(picture); !fault.empty()) {
      return image::cannot_hold(name, std::move(fault));
    }
    const Result<image::EncodedBytes> bytes = (*encode)(picture, options, name);
    if (!bytes) return tl::unexpected(bytes.error());
    return write_file(file, *bytes);
  });
}

Result<void> write_image(const Image& picture, const std::filesystem::path& file,
                         const WriteOptions& options) {
  const std::string name = file.string();
  return without_exceptions(image::memory_exhausted(name), [&]() -> Result<void> {
    if (picture.empty()) return image::cannot_hold(name, "the picture is empty");
    if (!image::is_png(name) || !image::is_stored_depth(picture, options)) {
      return write_image(image::layers_from_image(picture, ChannelValues::linear), file, options);
    }
    if (std::string fault = image::find_fault(options); !fault.empty()) {
      return image::cannot_hold(name, std::move(fault));
    }
    return write_file(file, image::encode_png(picture, options.threads));
  });
}

bool keeps_layers(const std::filesystem::path& file) { return image::has_ending(file.string(), ".exr"); }

Result<void> check_image_output(const std::filesystem::path& file) {
  const Result<image::Encode> encode = image::find_encoder(file.string());
  if (!encode) return tl::unexpected(encode.error());
  std::error_code ignored;
  // Opening a pipe would tell its reader that the picture is at its end.
  const bool is_special = std::filesystem::exists(file, ignored) &&
                          !std::filesystem::is_regular_file(file, ignored) &&
                          !std::filesystem::is_directory(file, ignored);
  if (file == "-" || is_special) return {};
  const Result<OutputFile> output = OutputFile::create(file);
  if (!output) return tl::unexpected(output.error());
  return {};
}

}  // namespace laterna
