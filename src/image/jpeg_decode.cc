#include <turbojpeg.h>

#include <memory>

#include "image/decoder.h"

namespace laterna::image {
namespace {

// Huffman-coded blocks of 64 pixels take at least a bit: 512 pixels per byte. Arithmetic coding can go beyond, though no
// picture that shows anything comes near this.
constexpr std::int64_t kMostPixelsPerByte = 4096;

// The accurate transform gives the same pixels with every instruction set. Many-scan files, made to waste
// time, stop.
constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS;

struct DestroyDecompressor {
  void operator()(void* decompressor) const { tjDestroy(decompressor); }
};
using Decompressor = std::unique_ptr<void, DestroyDecompressor>;

const unsigned char* data(const EncodedPicture& encoded) {
  return reinterpret_cast<const unsigned char*>(encoded.bytes.data());
}

tl::unexpected<Error> fault(const EncodedPicture& encoded, const Decompressor& decompressor) {
  return unreadable(encoded, {}, tjGetErrorStr2(decompressor.get()));
}

// Bytes between two segments do no harm to the pixels and are common. Every other warning means that pixels
// are missing and were filled with grey.
bool is_harmless_warning(const Decompressor& decompressor) {
  const std::string_view message = tjGetErrorStr2(decompressor.get());
  return tjGetErrorCode(decompressor.get()) == TJERR_WARNING &&
         message.find("extraneous bytes before marker") != std::string_view::npos;
}

bool decompress(const EncodedPicture& encoded, const Decompressor& decompressor, Image& image, int flags) {
  return tjDecompress2(decompressor.get(), data(encoded), encoded.bytes.size(),
                       reinterpret_cast<unsigned char*>(image.bytes().data()), image.width(), 0,
                       image.height(), image.channels() == 1 ? TJPF_GRAY : TJPF_RGB, flags) == 0;
}

bool recognises(const EncodedPicture& encoded) { return begins_with(encoded.bytes, "\xff\xd8\xff"); }

Result<ImageHeader> read_header(const EncodedPicture& encoded) {
  const Decompressor decompressor(tjInitDecompress());
  ImageHeader header;
  int subsampling = 0, colour_space = 0;
  if (tjDecompressHeader3(decompressor.get(), data(encoded), encoded.bytes.size(), &header.width,
                          &header.height, &subsampling, &colour_space) != 0) {
    return fault(encoded, decompressor);
  }
  // Not an error to the library: a file may hold tables for other files.
  if (header.width == 0 && header.height == 0) {
    return unreadable(encoded, {}, "the file ends before its picture begins");
  }
  if (colour_space == TJCS_CMYK || colour_space == TJCS_YCCK) {
    return unreadable(encoded, {},
                      "expected grey or RGB colour, found CMYK: its inks are not known, convert it to RGB");
  }
  header.channels = colour_space == TJCS_GRAY ? 1 : 3;
  return header;
}

Result<Image> decode(const EncodedPicture& encoded, const ImageHeader& header) {
  const Decompressor decompressor(tjInitDecompress());
  Image image(header.width, header.height, header.channels, PixelType::u8, Transfer::srgb);
  if (decompress(encoded, decompressor, image, kFlags | TJFLAG_STOPONWARNING)) return image;
  if (!is_harmless_warning(decompressor)) return fault(encoded, decompressor);
  // Again, past the warning; a later one that does harm is reported now.
  if (decompress(encoded, decompressor, image, kFlags) || is_harmless_warning(decompressor)) return image;
  return fault(encoded, decompressor);
}

}  // namespace

const Decoder kJpegDecoder = {"JPEG", kMostPixelsPerByte, recognises, read_header, decode};

}  // namespace laterna::image
