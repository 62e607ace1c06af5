#include "scene/gltf_container.h"

#include <fmt/format.h>

#include <cstdint>

namespace laterna::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN\0"
constexpr std::uint64_t kHeaderSize = 12, kChunkHeaderSize = 8;

std::uint32_t little_endian_u32(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

class ContainerReader {
 public:
  ContainerReader(const ByteSource& source, const std::string& file) : source_(source), file_(file) {}

  Result<Container> read() {
    if (source_.size() >= 4) {
      const auto magic = source_.read(0, 4);
      if (!magic) return fault(0, magic.error());
      if (little_endian_u32(magic->bytes, 0) == kMagic) return read_binary();
    }
    Container container;
    if (Result<void> kept = keep_json(container, 0, source_.size()); !kept)
      return tl::unexpected(kept.error());
    return container;
  }

 private:
  [[nodiscard]] tl::unexpected<Error> fault(std::uint64_t at, std::string message) const {
    return tl::unexpected(
        Error(Failure::bad_input, Diagnostic{file_, fmt::format("byte {}", at), std::move(message)}));
  }

  Result<void> keep_json(Container& container, std::uint64_t at, std::uint64_t size) {
    auto bytes = source_.read(at, size);
    if (!bytes) return fault(at, bytes.error());
    container.json_bytes = std::move(*bytes);
    container.json = {reinterpret_cast<const char*>(container.json_bytes.bytes.data()),
                      container.json_bytes.bytes.size()};
    // Exporters are known to pad the JSON chunk with NULs where the standard asks for spaces.
    while (!container.json.empty() && container.json.back() == '\0') container.json.remove_suffix(1);
    return {};
  }

  Result<Container> read_binary() {
    if (source_.size() < kHeaderSize) return fault(source_.size(), "the file ends inside the GLB header");
    const auto header = source_.read(0, kHeaderSize);
    if (!header) return fault(0, header.error());
    const std::uint32_t version = little_endian_u32(header->bytes, 4);
    if (version != 2) return fault(4, fmt::format("GLB version {} is not supported; expected 2", version));
    const std::uint64_t length = little_endian_u32(header->bytes, 8);
    if (length > source_.size()) {
      return fault(
          8, fmt::format("the GLB says it has {} bytes, but the file has only {}", length, source_.size()));
    }
    Container container;
    bool has_json = false;
    for (std::uint64_t at = kHeaderSize; at < length;) {
      if (length - at < kChunkHeaderSize) return fault(at, "the GLB ends inside a chunk header");
      const auto chunk = source_.read(at, kChunkHeaderSize);
      if (!chunk) return fault(at, chunk.error());
      const std::uint64_t size = little_endian_u32(chunk->bytes, 0);
      const std::uint32_t type = little_endian_u32(chunk->bytes, 4);
      const std::uint64_t content = at + kChunkHeaderSize;
      if (size > length - content) {
        return fault(
            at, fmt::format("the chunk says it has {} bytes, but only {} follow", size, length - content));
      }
      if (!has_json) {
        if (type != kJsonChunk) return fault(at + 4, "the first chunk of a GLB must be its JSON");
        if (Result<void> kept = keep_json(container, content, size); !kept)
          return tl::unexpected(kept.error());
        has_json = true;
      } else if (type == kBinChunk && !container.binary_chunk) {
        container.binary_chunk = source_.slice(content, size);
      }  // chunks of other types are for extensions, and skipped as the standard asks
      at = content + size;
    }
    if (!has_json) return fault(kHeaderSize, "the GLB has no JSON chunk");
    return container;
  }

  const ByteSource& source_;
  const std::string& file_;
};

}  // namespace

Result<Container> open_container(const ByteSource& source, const std::string& file) {
  return ContainerReader(source, file).read();
}

}  // namespace laterna::gltf
