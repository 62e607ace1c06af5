// OpenEXR: every channel under its name. Nothing of the machine, the time or the number of threads is in the
// file.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <new>

#include "image/encoder.h"
#include "image/exr_threads.h"
#include "image/parallel_rows.h"

namespace laterna::image {
namespace {

constexpr std::size_t kLongestName = 255;

// From here on a value rounds to infinity in half precision.
constexpr float kBeyondHalf = 65520;

class MemoryStream : public Imf::OStream {
 public:
  explicit MemoryStream(std::string_view name) : OStream(std::string(name).c_str()) {}

  void write(const char from[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (position_ + size > bytes_.size()) bytes_.resize(position_ + size);
    std::memcpy(bytes_.data() + position_, from, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  EncodedBytes take() { return std::move(bytes_); }

 private:
  EncodedBytes bytes_;
  std::uint64_t position_ = 0;
};

// Colours are fine in half precision; data is not.
bool is_data(std::string_view name) {
  constexpr std::array<std::string_view, 8> kLayers = {"P.",   "N.",          "uv.",        "id.",
                                                       "lux.", "visibility.", "luminance.", "pixel_density."};
  return name == "Z" || std::any_of(kLayers.begin(), kLayers.end(),
                                    [&](std::string_view layer) { return name.starts_with(layer); });
}

bool fits_half(const Channel& channel) {
  return std::none_of(channel.values.begin(), channel.values.end(),
                      [](float value) { return std::isfinite(value) && std::abs(value) >= kBeyondHalf; });
}

// A channel in the precision it is written in. One that holds finite values beyond half precision stays
// single.
struct StoredChannel {
  const Channel* source;
  std::vector<half> halves;  // empty: as it is

  StoredChannel(const Channel& channel, const LayeredImage& image, WriteOptions::Depth depth,
                const TaskPool& pool)
      : source(&channel) {
    using Depth = WriteOptions::Depth;
    if (depth == Depth::single || (depth == Depth::automatic && is_data(channel.name))) return;
    if (!fits_half(channel)) return;
    halves.resize(channel.values.size());
    const auto width = static_cast<std::size_t>(image.width);
    for_each_row_block(pool, image.height, [&](int first, int last, int) {
      for (std::size_t i = static_cast<std::size_t>(first) * width;
           i < static_cast<std::size_t>(last) * width; ++i) {
        halves[i] = half(channel.values[i]);
      }
    });
  }

  [[nodiscard]] Imf::PixelType type() const { return halves.empty() ? Imf::FLOAT : Imf::HALF; }
  [[nodiscard]] const void* data() const {
    return halves.empty() ? static_cast<const void*>(source->values.data()) : halves.data();
  }
  [[nodiscard]] std::size_t value_size() const { return halves.empty() ? sizeof(float) : sizeof(half); }
};

// The format's own attributes, beyond those that every header has.
bool is_reserved(const Imf::Header& header, const std::string& key) {
  constexpr std::array<std::string_view, 8> kOptional = {"name",    "type",  "version", "chunkCount",
                                                         "preview", "tiles", "view",    "maxSamplesPerPixel"};
  return header.find(key) != header.end() ||
         std::find(kOptional.begin(), kOptional.end(), key) != kOptional.end();
}

std::string find_fault(const LayeredImage& image, const Imf::Header& header) {
  for (const Channel& channel : image.channels) {
    if (channel.name.size() > kLongestName) return "a channel's name is longer than 255 bytes";
  }
  for (const auto& [key, value] : image.metadata) {
    if (key.empty() || key.size() > kLongestName) return "a metadata key must have 1 to 255 bytes";
    if (is_reserved(header, key)) return "the metadata key \"" + key + "\" is one of OpenEXR's own";
  }
  return {};
}

EncodedBytes encode(const LayeredImage& image, Imf::Header& header, const WriteOptions& options,
                    std::string_view name) {
  const TaskPool pool(options.threads);
  std::vector<StoredChannel> stored;
  stored.reserve(image.channels.size());
  Imf::FrameBuffer frame;
  for (const Channel& channel : image.channels) {
    const StoredChannel& made = stored.emplace_back(channel, image, options.depth, pool);
    header.channels().insert(channel.name, Imf::Channel(made.type()));
    frame.insert(channel.name,
                 Imf::Slice::Make(made.type(), made.data(), header.dataWindow(), made.value_size(),
                                  made.value_size() * static_cast<std::size_t>(image.width)));
  }
  for (const auto& [key, value] : image.metadata) header.insert(key, Imf::StringAttribute(value));
  MemoryStream stream(name);
  {
    Imf::OutputFile file(stream, header, exr_threads(options.threads));
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  }  // its end writes the table of rows
  return stream.take();
}

}  // namespace

Result<EncodedBytes> encode_exr(const LayeredImage& image, const WriteOptions& options,
                                std::string_view name) {
  using Depth = WriteOptions::Depth;
  if (options.depth == Depth::bits8 || options.depth == Depth::bits16) {
    return cannot_hold(name, "an OpenEXR file holds half or single precision, no 8- or 16-bit values");
  }
  try {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    if (std::string fault = find_fault(image, header); !fault.empty())
      return cannot_hold(name, std::move(fault));
    return encode(image, header, options, name);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& fault) {
    return cannot_hold(name, fault.what());
  }
}

}  // namespace laterna::image
