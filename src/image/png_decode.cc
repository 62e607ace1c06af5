#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <vector>

#include "image/decoder.h"
#include "image/png_plain.h"

namespace laterna::image {
namespace {

constexpr std::string_view kFormat = "PNG";

// One bit per pixel, and zlib's best ratio. Deeper pixels are held to the ratio once their depth is known.
constexpr std::int64_t kLargestRatio = 1032;
constexpr std::int64_t kMostPixelsPerByte = 8 * kLargestRatio;

// Only what decides the pixels is parsed: IHDR, PLTE, tRNS, IDAT, IEND.
constexpr char kIgnoredChunks[] =
    "bKGD\0"
    "cHRM\0"
    "eXIf\0"
    "gAMA\0"
    "hIST\0"
    "iCCP\0"
    "iTXt\0"
    "oFFs\0"
    "pCAL\0"
    "pHYs\0"
    "sBIT\0"
    "sCAL\0"
    "sPLT\0"
    "sRGB\0"
    "sTER\0"
    "tEXt\0"
    "tIME\0"
    "zTXt";

// libpng with its errors brought home: it reports them by longjmp, which must not cross a C++ object's
// lifetime, so every function that calls setjmp has no locals.
class PngFile {
 public:
  explicit PngFile(std::span<const std::byte> bytes) : bytes_(bytes) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;
  ~PngFile() { png_destroy_read_struct(&png_, &info_, nullptr); }

  // Reads up to the first IDAT and asks for whole bytes, RGB for palettes, and alpha for transparent colours.
  bool read_header() {
    if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, this, read_bytes);
    png_set_user_limits(png_, kMaxImageSide, kMaxImageSide);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER,
                                reinterpret_cast<png_const_bytep>(kIgnoredChunks), sizeof kIgnoredChunks / 5);
    png_read_info(png_, info_);
    packed_bytes_ =
        static_cast<std::int64_t>(png_get_rowbytes(png_, info_)) * png_get_image_height(png_, info_);
    png_set_expand(png_);
    if (std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  // Size of the pixels as the file has them, before compression.
  [[nodiscard]] std::int64_t packed_bytes() const { return packed_bytes_; }

  bool read_pixels(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  [[nodiscard]] ImageHeader header() const {
    return {.format = {},
            .width = static_cast<int>(png_get_image_width(png_, info_)),
            .height = static_cast<int>(png_get_image_height(png_, info_)),
            .channels = png_get_channels(png_, info_),
            .type = png_get_bit_depth(png_, info_) == 16 ? PixelType::u16 : PixelType::u8};
  }

  [[nodiscard]] tl::unexpected<Error> fault(const EncodedPicture& encoded) const {
    // libpng begins messages about a chunk with its name: "IDAT: CRC error".
    const std::string text = error_ + (warning_.empty() ? "" : " (" + warning_ + ")");
    const bool names_chunk = text.size() > 6 && text.compare(4, 2, ": ") == 0;
    if (names_chunk) return unreadable(encoded, "chunk " + text.substr(0, 4), text.substr(6));
    return unreadable(encoded, at_byte(position_), text.empty() ? "not enough memory" : text);
  }

 private:
  static PngFile& self(png_structp png) { return *static_cast<PngFile*>(png_get_error_ptr(png)); }

  static void on_error(png_structp png, png_const_charp message) {
    self(png).error_ = message;
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp png, png_const_charp message) { self(png).warning_ = message; }

  static void read_bytes(png_structp png, png_bytep to, std::size_t count) {
    PngFile& file = self(png);
    if (count > file.bytes_.size() - file.position_) {
      file.position_ = file.bytes_.size();
      png_error(png, "the file ends here, before the picture is complete");
    }
    std::memcpy(to, file.bytes_.data() + file.position_, count);
    file.position_ += count;
  }

  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
  std::int64_t packed_bytes_ = 0;
  std::string error_, warning_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

bool recognises(const EncodedPicture& encoded) { return begins_with(encoded.bytes, "\x89PNG"); }

Result<ImageHeader> read_header(const EncodedPicture& encoded) {
  PngFile file(encoded.bytes);
  if (!file.read_header()) return file.fault(encoded);
  return file.header();
}

Result<Image> decode(const EncodedPicture& encoded, const ImageHeader& header) {
  PngFile file(encoded.bytes);
  if (!file.read_header()) return file.fault(encoded);
  if (file.packed_bytes() / kLargestRatio > static_cast<std::int64_t>(encoded.bytes.size()))
    return claims_too_much(encoded, kFormat, header);
  Image image(header.width, header.height, header.channels, header.type, Transfer::srgb);
  if (read_plain_png(encoded.bytes, image)) return image;
  const std::size_t row_bytes = image.bytes().size() / static_cast<std::size_t>(header.height);
  std::vector<png_bytep> rows(static_cast<std::size_t>(header.height));
  for (std::size_t y = 0; y < rows.size(); ++y) {
    rows[y] = reinterpret_cast<png_bytep>(image.bytes().data() + y * row_bytes);
  }
  if (!file.read_pixels(rows.data())) return file.fault(encoded);
  return image;
}

}  // namespace

const Decoder kPngDecoder = {kFormat, kMostPixelsPerByte, recognises, read_header, decode};

}  // namespace laterna::image
