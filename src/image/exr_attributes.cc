#include "image/exr_attributes.h"

#include <algorithm>
#include <array>

#include "image/byte_reader.h"

namespace laterna::image {
namespace {

constexpr std::uint32_t kHasParts = 0x1000;

struct TypeSize {
  std::string_view type;
  std::uint32_t size;
};
constexpr std::array kTypeSizes = {
    TypeSize{"box2f", 16},      TypeSize{"box2i", 16},    TypeSize{"chromaticities", 32},
    TypeSize{"compression", 1}, TypeSize{"double", 8},    TypeSize{"deepImageState", 1},
    TypeSize{"envmap", 1},      TypeSize{"float", 4},     TypeSize{"int", 4},
    TypeSize{"keycode", 28},    TypeSize{"lineOrder", 1}, TypeSize{"m33d", 72},
    TypeSize{"m33f", 36},       TypeSize{"m44d", 128},    TypeSize{"m44f", 64},
    TypeSize{"rational", 8},    TypeSize{"tiledesc", 9},  TypeSize{"timecode", 8},
    TypeSize{"v2d", 16},        TypeSize{"v2f", 8},       TypeSize{"v2i", 8},
    TypeSize{"v3d", 24},        TypeSize{"v3f", 12},      TypeSize{"v3i", 12}};

// Text up to its zero byte; empty at the end of the file.
std::string read_text(ByteReader& in) {
  std::string text;
  while (const char c = static_cast<char>(in.u8())) text += c;
  return text;
}

// A list of channels ends with an empty name, whatever its size says. `claimed` where the file ends first.
std::size_t channel_list_size(ByteReader in, std::uint32_t claimed) {
  constexpr std::size_t kChannelSize = 16;  // type, linearity, sampling
  const std::size_t first = in.position();
  while (!read_text(in).empty()) in.skip(kChannelSize);
  return in.ran_out() ? claimed : in.position() - first;
}

// The size that an attribute of this type must have; `claimed` where any will do.
std::size_t expected_size(std::string_view type, std::uint32_t claimed, const ByteReader& in) {
  if (type == "chlist") return channel_list_size(in, claimed);
  const auto found =
      std::find_if(kTypeSizes.begin(), kTypeSizes.end(), [&](const TypeSize& t) { return t.type == type; });
  return found == kTypeSizes.end() ? claimed : found->size;
}

}  // namespace

// A header is a list of attributes (name, type, size, value) that ends with an empty name. A file of several
// parts has a list of headers, which ends with an empty header.
Result<void> check_exr_attributes(const EncodedPicture& encoded) {
  ByteReader in(encoded.bytes);
  in.skip(4);  // signature
  const bool has_parts = (in.u32_le() & kHasParts) != 0;
  for (bool begins_header = true; !in.ran_out();) {
    const std::string name = read_text(in);
    if (name.empty()) {
      if (!has_parts || begins_header) break;
      begins_header = true;
      continue;
    }
    begins_header = false;
    const std::string type = read_text(in);
    const std::size_t position = in.position();
    const std::uint32_t size = in.u32_le();
    const std::size_t expected = expected_size(type, size, in);
    if (in.ran_out()) break;
    if (size != expected || size > in.remaining()) {
      return unreadable(encoded, at_byte(position),
                        "attribute \"" + name + "\" of type " + type + " claims " + std::to_string(size) +
                            " bytes; " +
                            (size != expected ? "expected " + std::to_string(expected)
                                              : "the file has " + std::to_string(in.remaining()) + " more"));
    }
    in.skip(size);
  }
  if (in.ran_out()) return ends_early(encoded, "the header");
  return {};
}

}  // namespace laterna::image
