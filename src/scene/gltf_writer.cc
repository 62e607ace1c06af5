#include "scene/gltf_writer.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/output_file.h"
#include "base/without_exceptions.h"
#include "image/file_ending.h"
#include "scene/gltf_animation_writer.h"
#include "scene/gltf_camera_writer.h"
#include "scene/gltf_environment_writer.h"
#include "scene/gltf_light_writer.h"
#include "scene/gltf_material_writer.h"
#include "scene/gltf_mesh_writer.h"
#include "scene/gltf_node_writer.h"
#include "scene/uri.h"

namespace laterna {
namespace {

using gltf::Document;
using Bytes = std::vector<std::byte>;

bool is_binary(const std::filesystem::path& file) { return image::has_ending(file.string(), ".glb"); }

tl::unexpected<Error> failure(Failure kind, const std::filesystem::path& file, std::string message) {
  return tl::unexpected(Error(kind, Diagnostic{file.string(), {}, std::move(message)}));
}

Result<void> check_ending(const std::filesystem::path& file) {
  if (is_binary(file) || image::has_ending(file.string(), ".gltf")) return {};
  return failure(Failure::bad_usage, file, "scenes are written as glTF: the name must end in .glb or .gltf");
}

void append(Bytes& bytes, std::span<const std::byte> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

void append_u32(Bytes& bytes, std::size_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i) & 0xFFU));
}

constexpr std::size_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;
constexpr std::size_t kHeader = 12, kChunkHeader = 8;

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

// Chunks are padded to a multiple of four, JSON with spaces, bytes with zeros.
Result<Bytes> glb(const Document& document, const std::filesystem::path& file) {
  std::string json = document.text({});
  json.resize(padded(json.size()), ' ');
  const std::size_t binary = padded(document.binary().size());
  const std::size_t size = kHeader + kChunkHeader + json.size() + (binary == 0 ? 0 : kChunkHeader + binary);
  if (size > std::numeric_limits<std::uint32_t>::max())
    return failure(Failure::bad_usage, file, "a .glb holds at most 4 GB: write a .gltf");
  Bytes bytes;
  bytes.reserve(size);
  for (const std::size_t word : {kMagic, kVersion, size, json.size(), kJsonChunk}) append_u32(bytes, word);
  append(bytes, std::as_bytes(std::span(json)));
  if (binary == 0) return bytes;
  append_u32(bytes, binary);
  append_u32(bytes, kBinChunk);
  append(bytes, document.binary());
  bytes.resize(size);
  return bytes;
}

// What a file does not hold, told by where it stands in the scene.
void warn_of_rest(const Scene& scene, Document& document) {
  if (!scene.photographs.empty())
    document.warn("photographs", "glTF has no photographs: add them again with `laterna photo`");
  if (std::ranges::any_of(scene.materials, [](const Material& m) { return !m.layers.empty(); }))
    document.warn("surfaces", "layers on surfaces are not carried: keep the rig that has them");
}

Result<GltfFiles> make(const Scene& scene, const std::filesystem::path& file,
                       const SceneWriteOptions& options) {
  if (const Result<void> checked = check_ending(file); !checked) return tl::unexpected(checked.error());
  if (std::vector<Diagnostic> faults = validate(scene); !faults.empty())
    return tl::unexpected(Error(Failure::bad_usage, std::move(faults)));
  const bool embeds = options.embeds || is_binary(file);
  Document document;
  gltf::Surroundings surroundings(file, embeds);
  gltf::PictureWriter pictures(scene, surroundings, document);
  if (const auto written = gltf::write_materials(scene, pictures, document); !written)
    return tl::unexpected(written.error());
  const std::vector<int> meshes = gltf::write_meshes(scene, document);
  gltf::write_cameras(scene, document);
  gltf::LightWriter lights(scene, pictures, surroundings, document);
  if (const auto written = lights.write(); !written) return tl::unexpected(written.error());
  if (const auto written = gltf::write_nodes(scene, meshes, lights, document); !written)
    return tl::unexpected(written.error());
  gltf::write_skins(scene, document);
  gltf::write_animations(scene, lights.indices(), document);
  if (const auto written = gltf::write_environment(scene, pictures, document); !written)
    return tl::unexpected(written.error());
  warn_of_rest(scene, document);

  GltfFiles made;
  Bytes own;
  if (is_binary(file)) {
    Result<Bytes> bytes = glb(document, file);
    if (!bytes) return tl::unexpected(std::move(bytes.error()));
    own = std::move(*bytes);
  } else {
    std::string buffer = data_uri("application/octet-stream", {});
    if (embeds) {
      buffer = data_uri("application/octet-stream", document.binary());
    } else if (!document.binary().empty()) {
      buffer = surroundings.add("bin", document.binary());
    }
    std::string text = document.text(buffer);
    text += '\n';
    append(own, std::as_bytes(std::span(text)));
  }
  made.files = surroundings.take_files();
  made.files.push_back({file, std::move(own)});
  made.warnings = std::move(document.warnings());
  return made;
}

}  // namespace

Result<GltfFiles> make_gltf(const Scene& scene, const std::filesystem::path& file,
                            const SceneWriteOptions& options) {
  return without_exceptions(
      Error(Failure::cannot_write, Diagnostic{file.string(), {}, "not enough memory to write the scene"}),
      [&] { return make(scene, file, options); });
}

Result<std::vector<Diagnostic>> write_scene(const Scene& scene, const std::filesystem::path& file,
                                            const SceneWriteOptions& options) {
  Result<GltfFiles> made = make_gltf(scene, file, options);
  if (!made) return tl::unexpected(std::move(made.error()));
  for (const gltf::BesideFile& each : made->files) {
    if (const Result<void> written = write_file(each.path, each.bytes); !written)
      return tl::unexpected(written.error());
  }
  return std::move(made->warnings);
}

Result<void> check_scene_output(const std::filesystem::path& file) {
  if (Result<void> checked = check_ending(file); !checked) return checked;
  const Result<OutputFile> output = OutputFile::create(file);
  if (!output) return tl::unexpected(output.error());
  return {};
}

}  // namespace laterna
