// Any bytes as a glTF or GLB file: read or refused, and what was read is sound.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "scene/gltf_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* first = reinterpret_cast<const std::byte*>(data);
  const auto bytes = std::make_shared<const std::vector<std::byte>>(first, first + size);
  // No file is called so: what the input refers to is missing, and nothing outside it is read.
  const auto scene = laterna::read_gltf(laterna::ByteSource::in_memory(bytes), "input", "/nonexistent/folder");
  if (!scene) {
    if (scene.error().diagnostics.empty()) std::abort();  // every refusal says why
    return 0;
  }
  laterna::validate(*scene);
  laterna::world_from_nodes(*scene);
  return 0;
}
