// Any bytes as a glTF or GLB file: read or refused, and what was read is sound and can be written.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "scene/gltf_reader.h"
#include "scene/gltf_writer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* first = reinterpret_cast<const std::byte*>(data);
  const auto bytes = std::make_shared<const std::vector<std::byte>>(first, first + size);
  // No file is called so: what the input refers to is missing, and nothing outside it is read.
  const auto scene =
      laterna::read_gltf(laterna::ByteSource::in_memory(bytes), "input", "/nonexistent/folder");
  if (!scene) {
    if (scene.error().diagnostics.empty()) std::abort();  // every refusal says why
    return 0;
  }
  // A sound file may still show more than is rendered, or too far away; only then are there no places.
  if (!laterna::validate(*scene).empty()) return 0;
  laterna::world_from_nodes(*scene);
  // What can be written (its pictures are pictures) is read again.
  const auto written = laterna::make_gltf(*scene, "/nonexistent/written.glb", {});
  if (!written) return 0;
  const auto copy = std::make_shared<const std::vector<std::byte>>(written->files.back().bytes);
  const auto again = laterna::read_gltf(laterna::ByteSource::in_memory(copy), "written", "/nonexistent");
  if (!again) {
    std::fputs((to_string(again.error()) + "\n").c_str(), stderr);
    std::abort();
  }
  return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t largest_size);

namespace {

constexpr std::size_t kJsonAt = 20, kChunkHeaderSize = 8;

std::uint32_t load_u32(const std::uint8_t* from) {
  return from[0] | std::uint32_t{from[1]} << 8 | std::uint32_t{from[2]} << 16 | std::uint32_t{from[3]} << 24;
}

void store_u32(std::uint8_t* to, std::size_t value) {
  for (int i = 0; i < 4; ++i) to[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

// A sound GLB of two chunks, as far as lengths go.
bool is_glb(const std::uint8_t* data, std::size_t size) {
  constexpr std::uint8_t kMagic[] = {'g', 'l', 'T', 'F'};
  if (size < kJsonAt + kChunkHeaderSize || !std::equal(kMagic, kMagic + 4, data)) return false;
  return load_u32(data + 12) <= size - kJsonAt - kChunkHeaderSize;
}

}  // namespace

// A GLB is cut in two: either its JSON or its binary chunk is changed, and the lengths are put right, without
// which nothing but their checks would be tested.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t largest_size,
                                               unsigned seed) {
  constexpr unsigned kOneInSo = 16;
  if (!is_glb(data, size) || largest_size <= size || seed % kOneInSo == 0) {
    return LLVMFuzzerMutate(data, size, largest_size);
  }
  const std::size_t json_size = load_u32(data + 12), binary_at = kJsonAt + json_size + kChunkHeaderSize;
  const bool changes_json = seed / kOneInSo % 2 == 0;
  const std::size_t part_at = changes_json ? kJsonAt : binary_at;
  const std::size_t part_size = changes_json ? json_size : size - binary_at;
  std::vector<std::uint8_t> part(data + part_at, data + part_at + part_size);
  part.resize(part_size + largest_size - size);
  part.resize(LLVMFuzzerMutate(part.data(), part_size, part.size()));
  const std::vector<std::uint8_t> rest(data + part_at + part_size, data + size);
  std::copy(part.begin(), part.end(), data + part_at);
  std::copy(rest.begin(), rest.end(), data + part_at + part.size());
  size = part_at + part.size() + rest.size();
  const std::size_t new_json_size = changes_json ? part.size() : json_size;
  store_u32(data + 8, size);
  store_u32(data + 12, new_json_size);
  store_u32(data + kJsonAt + new_json_size, size - kJsonAt - new_json_size - kChunkHeaderSize);
  return size;
}
