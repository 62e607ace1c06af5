// The outer shell of a glTF file: plain JSON, or GLB's header and chunks.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scene/byte_source.h"

namespace laterna::gltf {

struct Container {
  OwnedSpan json_bytes;
  std::string_view json;                   ///< into json_bytes, without padding
  std::optional<ByteSource> binary_chunk;  ///< GLB's BIN
};

/// Tells GLB from JSON by its first four bytes. Every cut of a GLB is an error.
Result<Container> open_container(const ByteSource& source, const std::string& file);

}  // namespace laterna::gltf
