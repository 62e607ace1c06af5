// EXT_meshopt_compression: one compressed buffer view at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "laterna/result.h"

namespace laterna::gltf {

enum class MeshoptMode : std::uint8_t { attributes, triangles, indices };
enum class MeshoptFilter : std::uint8_t { none, octahedral, quaternion, exponential };

struct MeshoptLayout {
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;
  std::uint64_t count = 0;   ///< elements
  std::uint64_t stride = 0;  ///< bytes per element once decoded
};

/// Decoded bytes per compressed byte, at most. The vertex codec's densest block spends 4 bytes on 256 bytes of each
/// plane: 64 to 1; doubled, for its tail. The index codecs stay far below.
inline constexpr std::uint64_t kMaxMeshoptRatio = 128;

/// Why the layout is not one the extension allows, or that many elements cannot come from `compressed_size`
/// bytes; an empty string when it is fine. Nothing is allocated before this has passed.
std::string find_fault(const MeshoptLayout& layout, std::size_t compressed_size);

/// count · stride bytes. The layout must have passed find_fault. Error: the data are corrupt.
/// The filters are our own plain arithmetic: the library's use approximate reciprocals that differ between
/// processors.
tl::expected<std::vector<std::byte>, std::string> decode_meshopt(std::span<const std::byte> compressed,
                                                                 const MeshoptLayout& layout);

}  // namespace laterna::gltf
