#include "image/exr_decode.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <functional>
#include <new>
#include <stdexcept>
#include <vector>

#include "image/exr_attributes.h"
#include "image/exr_threads.h"

namespace laterna::image {
namespace {

// Four channels at the limit of pixels; files with more channels must be smaller.
constexpr std::int64_t kMostValues = 4 * kMaxImagePixels;

// How much smaller than its values a file can be: zlib's best ratio, after 32-bit values have lost a byte
// (PXR24), or after 64 half values have become one of each kind of coefficient (DWA). The other methods stay
// far below.
constexpr std::int64_t kLargestRatio = 1032 * 4 / 3, kLargestDwaRatio = 1032 * 32;

class MemoryStream : public Imf::IStream {
 public:
  explicit MemoryStream(const EncodedPicture& encoded)
      : IStream(std::string(encoded.name).c_str()), bytes_(encoded.bytes) {}

  bool read(char to[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (count < 0 || position_ > bytes_.size() || size > bytes_.size() - position_) {
      throw std::runtime_error("the file ends before the picture is complete");
    }
    std::memcpy(to, bytes_.data() + position_, size);
    position_ += size;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t position_ = 0;
};

// A window of pixels; both ends are inside it.
struct Window {
  std::int64_t left, top, right, bottom;

  explicit Window(const Imath::Box2i& box)
      : left(box.min.x), top(box.min.y), right(box.max.x), bottom(box.max.y) {}
  [[nodiscard]] std::int64_t width() const { return right - left + 1; }
  [[nodiscard]] std::int64_t height() const { return bottom - top + 1; }
  bool operator==(const Window&) const = default;
};

std::string size_text(const Window& window) {
  return std::to_string(window.width()) + " x " + std::to_string(window.height());
}

// OpenEXR takes memory for whole tiles.
bool has_large_tiles(const Imf::Header& header) {
  constexpr std::uint64_t kMostTilePixels = std::uint64_t{1} << 24;
  if (!header.hasTileDescription()) return false;
  return std::uint64_t{header.tileDescription().xSize} * header.tileDescription().ySize > kMostTilePixels;
}

std::string find_fault_of_size(const EncodedPicture& encoded, const Imf::Header& header) {
  const Window data(header.dataWindow()), display(header.displayWindow());
  const std::int64_t pixels = std::max(data.width() * data.height(), display.width() * display.height());
  const std::int64_t side = std::max({data.width(), data.height(), display.width(), display.height()});
  std::int64_t channels = 0, bytes_per_pixel = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    ++channels;
    bytes_per_pixel += i.channel().type == Imf::HALF ? 2 : 4;
  }
  const std::string size = "the data window is " + size_text(data) + ", the display window " +
                           size_text(display) + ", with " + std::to_string(channels) + " channels: ";
  if (side > kMaxImageSide || pixels > kMaxImagePixels || pixels * channels > kMostValues) {
    return size + "more than is read";
  }
  const bool is_dwa =
      header.compression() == Imf::DWAA_COMPRESSION || header.compression() == Imf::DWAB_COMPRESSION;
  const std::int64_t least_size =
      data.width() * data.height() * bytes_per_pixel / (is_dwa ? kLargestDwaRatio : kLargestRatio);
  if (least_size > static_cast<std::int64_t>(encoded.bytes.size())) {
    return size + "more than a file of " + std::to_string(encoded.bytes.size()) + " bytes can hold";
  }
  return {};
}

// The header of the first part, once it is known to be one that is read.
Result<Imf::Header> read_first_part(const EncodedPicture& encoded, const Imf::MultiPartInputFile& file) {
  Imf::Header header = file.header(0);
  if (header.hasType() && Imf::isDeepData(header.type())) {
    return unreadable(encoded, {}, "expected one value per pixel, found a deep picture");
  }
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    if (i.channel().xSampling != 1 || i.channel().ySampling != 1) {
      return unreadable(encoded, "channel " + std::string(i.name()),
                        "a channel of lower resolution (luminance-chroma) is not read");
    }
  }
  if (has_large_tiles(header)) return unreadable(encoded, {}, "tiles of more than 2^24 pixels are not read");
  if (std::string fault = find_fault_of_size(encoded, header); !fault.empty()) {
    return unreadable(encoded, {}, std::move(fault));
  }
  return header;
}

// A channel's values on the display window: data outside of it is dropped, places without data are 0.
std::vector<float> place(const std::vector<float>& values, const Window& data, const Window& display) {
  std::vector<float> placed(static_cast<std::size_t>(display.width() * display.height()));
  const std::int64_t left = std::max(data.left, display.left), right = std::min(data.right, display.right);
  const std::int64_t top = std::max(data.top, display.top), bottom = std::min(data.bottom, display.bottom);
  for (std::int64_t y = top; y <= bottom && left <= right; ++y) {
    const auto from = values.begin() + (y - data.top) * data.width() + (left - data.left);
    std::copy(from, from + (right - left + 1),
              placed.begin() + (y - display.top) * display.width() + left - display.left);
  }
  return placed;
}

using Selection = std::function<bool(const std::string& name)>;

void read_pixels(Imf::MultiPartInputFile& file, const Imf::Header& header, LayeredImage& image) {
  const Window data(header.dataWindow()), display(header.displayWindow());
  Imf::FrameBuffer frame;
  for (Channel& channel : image.channels) {
    channel.values.resize(static_cast<std::size_t>(data.width() * data.height()));
    frame.insert(channel.name,
                 Imf::Slice::Make(Imf::FLOAT, channel.values.data(), header.dataWindow(), sizeof(float),
                                  sizeof(float) * static_cast<std::size_t>(data.width())));
  }
  Imf::InputPart part(file, 0);
  part.setFrameBuffer(frame);
  part.readPixels(header.dataWindow().min.y, header.dataWindow().max.y);
  if (data == display) return;
  for (Channel& channel : image.channels) channel.values = place(channel.values, data, display);
}

Result<LayeredImage> read_layers(const EncodedPicture& encoded, const Selection& is_wanted) {
  if (auto checked = check_exr_attributes(encoded); !checked) return tl::unexpected(checked.error());
  MemoryStream stream(encoded);
  Imf::MultiPartInputFile file(stream, exr_threads(0));
  const Result<Imf::Header> header = read_first_part(encoded, file);
  if (!header) return tl::unexpected(header.error());
  const Window display(header->displayWindow());
  LayeredImage image;
  image.width = static_cast<int>(display.width());
  image.height = static_cast<int>(display.height());
  for (auto i = header->channels().begin(); i != header->channels().end(); ++i) {
    if (is_wanted(i.name())) image.channels.push_back({i.name(), {}});
  }
  read_pixels(file, *header, image);
  for (auto i = header->begin(); i != header->end(); ++i) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute());
    const std::string_view key = i.name();
    // "name" and "type" describe the part within the file.
    if (text != nullptr && key != "name" && key != "type") image.metadata[i.name()] = text->value();
  }
  return image;
}

// OpenEXR begins its messages with what it was doing and the file's name in quotes, which ours have already.
std::string reason(std::string_view message) {
  constexpr std::string_view kEndOfName = "\". ";
  const std::size_t end = message.find(kEndOfName);
  return std::string(end == std::string_view::npos ? message : message.substr(end + kEndOfName.size()));
}

// OpenEXR reports by exceptions; none leaves this room.
template <class Read>
auto caught(const EncodedPicture& encoded, Read read) -> decltype(read()) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    return unreadable(encoded, {}, "not enough memory for the picture");
  } catch (const std::exception& fault) {
    return unreadable(encoded, {}, reason(fault.what()));
  }
}

// The channels that make a picture: RGB[A] or, without them, Y[A].
Result<std::vector<std::string>> picture_channels(const EncodedPicture& encoded,
                                                  const Imf::ChannelList& channels) {
  const auto has = [&](const char* name) { return channels.findChannel(name) != nullptr; };
  std::vector<std::string> names;
  if (has("R") && has("G") && has("B")) {
    names = {"R", "G", "B"};
  } else if (has("Y")) {
    names = {"Y"};
  } else {
    std::string found;
    for (auto i = channels.begin(); i != channels.end(); ++i)
      found += std::string(found.empty() ? "" : " ") + i.name();
    return unreadable(encoded, {},
                      "expected channels R, G, B or Y, found " + (found.empty() ? "none" : found));
  }
  if (has("A")) names.emplace_back("A");
  return names;
}

// OpenEXR's colours are multiplied by alpha; a picture's are not.
Image interleave(const LayeredImage& layers, const std::vector<std::string>& names) {
  Image image(layers.width, layers.height, static_cast<int>(names.size()), PixelType::f32, Transfer::linear);
  const std::span<float> values = image.values<float>();
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::vector<float>& from = layers.find(names[c])->values;
    for (std::size_t i = 0; i < from.size(); ++i) values[i * names.size() + c] = from[i];
  }
  if (!image.has_alpha()) return image;
  for (std::size_t i = 0; i < values.size(); i += names.size()) {
    const float alpha = values[i + names.size() - 1];
    if (!(alpha > 0) || alpha == 1) continue;
    for (std::size_t c = 0; c + 1 < names.size(); ++c) values[i + c] /= alpha;
  }
  return image;
}

bool recognises(const EncodedPicture& encoded) { return begins_with(encoded.bytes, "v/1\x01"); }

Result<ImageHeader> read_header(const EncodedPicture& encoded) {
  return caught(encoded, [&]() -> Result<ImageHeader> {
    if (auto checked = check_exr_attributes(encoded); !checked) return tl::unexpected(checked.error());
    MemoryStream stream(encoded);
    const Imf::MultiPartInputFile file(stream, 0);
    const Result<Imf::Header> header = read_first_part(encoded, file);
    if (!header) return tl::unexpected(header.error());
    const Result<std::vector<std::string>> names = picture_channels(encoded, header->channels());
    if (!names) return tl::unexpected(names.error());
    const Window display(header->displayWindow());
    return ImageHeader{.format = {},
                       .width = static_cast<int>(display.width()),
                       .height = static_cast<int>(display.height()),
                       .channels = static_cast<int>(names->size()),
                       .type = PixelType::f32};
  });
}

Result<Image> decode(const EncodedPicture& encoded, const ImageHeader& header) {
  const bool is_grey = header.channels <= 2;
  const bool has_alpha = header.channels % 2 == 0;
  std::vector<std::string> names =
      is_grey ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  if (has_alpha) names.emplace_back("A");
  const Result<LayeredImage> layers = caught(encoded, [&] {
    return read_layers(encoded, [&](const std::string& name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    });
  });
  if (!layers) return tl::unexpected(layers.error());
  return interleave(*layers, names);
}

}  // namespace

Result<LayeredImage> decode_exr_layers(const EncodedPicture& encoded) {
  return caught(encoded, [&] { return read_layers(encoded, [](const std::string&) { return true; }); });
}

const Decoder kExrDecoder = {"OpenEXR", 0, recognises, read_header, decode};

}  // namespace laterna::image
