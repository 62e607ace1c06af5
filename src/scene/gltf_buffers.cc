#include "scene/gltf_buffers.h"

#include <fmt/format.h>

#include <utility>

#include "scene/gltf_extension.h"
#include "scene/uri.h"

namespace laterna::gltf {
namespace {

constexpr std::string_view kMeshopt = "EXT_meshopt_compression";

// A buffer for programs that cannot decompress. The extension tells others not to load it: its file may be missing.
bool is_fallback(const JsonValue& buffer) {
  const JsonValue* extension = find_extension(buffer, kMeshopt);
  const JsonValue* mark = extension == nullptr ? nullptr : extension->find("fallback");
  return mark != nullptr && mark->boolean;
}

}  // namespace

Buffers::Buffers(const JsonDocument& json, const Container& container, std::filesystem::path folder,
                 FaultList& faults)
    : json_(json), container_(container), folder_(std::move(folder)), faults_(faults) {
  JsonObject root(json, json.root(), faults);
  if (const JsonValue* list = root.array("buffers")) {
    for (const JsonValue& value : list->children) buffers_.push_back(read_buffer(value, buffers_.size()));
  }
  for (const Buffer& buffer : buffers_) {
    if (buffer.source) most_decoded_bytes_ += buffer.source->size() * kMaxMeshoptRatio;
  }
  if (const JsonValue* list = root.array("bufferViews")) {
    views_.reserve(list->children.size());
    for (const JsonValue& value : list->children) views_.push_back(read_view(value));
  }
}

Buffers::Buffer Buffers::read_buffer(const JsonValue& value, std::size_t index) {
  JsonObject object(json_, value, faults_);
  Buffer buffer;
  buffer.is_faulty = true;
  object.require("byteLength");
  const std::optional<std::uint64_t> length = object.whole("byteLength", 1);
  if (is_fallback(value)) {
    buffer.is_fallback = true;
    buffer.is_faulty = !length;
    return buffer;
  }
  if (object.has("uri")) {
    const std::optional<std::string> uri = object.string("uri");
    if (!uri) return buffer;
    auto source = open_uri(*uri);
    if (!source) {
      object.error("uri", source.error());
      return buffer;
    }
    buffer.source = std::move(*source);
  } else if (index == 0) {
    buffer.source = container_.binary_chunk;  // others without a source stand in for compressed data
  }
  if (!length) return buffer;
  if (buffer.source && *length > buffer.source->size()) {
    object.error("byteLength",
                 fmt::format("says {} bytes, but there are only {}", *length, buffer.source->size()));
    return buffer;
  }
  if (buffer.source) buffer.source = buffer.source->slice(0, *length);
  buffer.is_faulty = false;
  return buffer;
}

tl::expected<ByteSource, std::string> Buffers::open_uri(const std::string& uri) {
  if (is_data_uri(uri)) {
    auto decoded = decode_data_uri(uri);
    if (!decoded) return tl::unexpected(decoded.error());
    return ByteSource::in_memory(std::make_shared<const std::vector<std::byte>>(std::move(*decoded)));
  }
  const auto path = resolve_file(folder_, uri);
  if (!path) return tl::unexpected(path.error());
  return ByteSource::open(*path);
}

// The bytes that "buffer", "byteOffset" and "byteLength" of an object name.
std::optional<ByteSource> Buffers::slice(JsonObject& object) {
  if (!object.require("buffer") || !object.require("byteLength")) return std::nullopt;
  const int index = object.index("buffer", buffers_.size(), "buffers");
  const std::optional<std::uint64_t> offset = object.has("byteOffset") ? object.whole("byteOffset") : 0;
  const std::optional<std::uint64_t> length = object.whole("byteLength", 1);
  if (index < 0 || !offset || !length) return std::nullopt;
  const Buffer& buffer = buffers_[static_cast<std::size_t>(index)];
  if (buffer.is_faulty) return std::nullopt;
  if (!buffer.source) {
    object.error("buffer", fmt::format("buffers[{}] has no data: {}", index,
                                       buffer.is_fallback ? "it is a fallback for what is read compressed"
                                                          : "neither a uri nor a chunk of a GLB"));
    return std::nullopt;
  }
  const std::uint64_t size = buffer.source->size();
  if (*offset > size || *length > size - *offset) {
    object.error("byteLength", fmt::format("bytes {} to {} lie beyond the {} bytes of buffers[{}]", *offset,
                                           *offset + *length, size, index));
    return std::nullopt;
  }
  return buffer.source->slice(*offset, *length);
}

Buffers::View Buffers::read_view(const JsonValue& value) {
  JsonObject object(json_, value, faults_);
  View view;
  view.json = &value;
  if (const std::optional<std::uint64_t> stride = object.whole("byteStride", 4, 252)) {
    if (*stride % 4 != 0)
      object.error("byteStride", fmt::format("expected a multiple of 4, got {}", *stride));
    view.stride = *stride;
  }
  if (const JsonValue* extension = find_extension(value, kMeshopt)) {
    view.is_faulty = !read_compression(*extension, view);
    const std::uint64_t length = object.whole("byteLength", 1).value_or(0);
    if (!view.is_faulty && length != view.size) {
      object.error("byteLength", fmt::format("expected {} (count · byteStride of {}), got {}", view.size,
                                             kMeshopt, length));
      view.is_faulty = true;
    }
  } else if (std::optional<ByteSource> bytes = slice(object)) {
    view.source = std::move(*bytes);
    view.size = view.source.size();
    if (const JsonValue* offset = value.find("byteOffset"))
      view.offset = static_cast<std::uint64_t>(offset->number);
  } else {
    view.is_faulty = true;
  }
  if (view.is_faulty) view.size = 0;
  return view;
}

bool Buffers::read_compression(const JsonValue& extension, View& view) {
  JsonObject object(json_, extension, faults_);
  const bool is_complete = object.require_all({"byteStride", "count", "mode"});
  MeshoptLayout layout;
  const auto count = object.whole("count", 1), stride = object.whole("byteStride", 1);
  const auto mode = object.choice<MeshoptMode>("mode", {{"ATTRIBUTES", MeshoptMode::attributes},
                                                        {"TRIANGLES", MeshoptMode::triangles},
                                                        {"INDICES", MeshoptMode::indices}});
  const auto filter = object.choice<MeshoptFilter>("filter", {{"NONE", MeshoptFilter::none},
                                                              {"OCTAHEDRAL", MeshoptFilter::octahedral},
                                                              {"QUATERNION", MeshoptFilter::quaternion},
                                                              {"EXPONENTIAL", MeshoptFilter::exponential}});
  std::optional<ByteSource> compressed = slice(object);
  if (!is_complete || !count || !stride || !mode || !compressed || (object.has("filter") && !filter))
    return false;
  layout = {*mode, filter.value_or(MeshoptFilter::none), *count, *stride};
  if (std::string fault = find_fault(layout, compressed->size()); !fault.empty()) {
    object.error({}, std::move(fault));
    return false;
  }
  view.source = std::move(*compressed);
  view.compressed = layout;
  view.size = layout.count * layout.stride;
  // Several views may name the same compressed bytes; sound files have no reason to.
  if (view.size > most_decoded_bytes_) {
    object.error({}, "the compressed views of the file hold more than its buffers can");
    return false;
  }
  most_decoded_bytes_ -= view.size;
  if (view.stride == 0 && layout.mode == MeshoptMode::attributes) view.stride = layout.stride;
  return true;
}

// Decoded bytes take the compressed ones' place.
bool Buffers::decode(View& view) {
  const auto compressed = view.source.read(0, view.source.size());
  auto decoded =
      compressed ? decode_meshopt(compressed->bytes, *view.compressed) : tl::unexpected(compressed.error());
  if (!decoded) {
    faults_.error(json_.place(*view.json) + ".extensions.EXT_meshopt_compression", decoded.error());
    return false;
  }
  view.source = ByteSource::in_memory(std::make_shared<const std::vector<std::byte>>(std::move(*decoded)));
  view.compressed.reset();
  return true;
}

std::optional<OwnedSpan> Buffers::read(int index, std::uint64_t offset, std::uint64_t size) {
  View& view = views_[static_cast<std::size_t>(index)];
  if (!view.is_faulty && view.compressed) view.is_faulty = !decode(view);
  if (view.is_faulty) return std::nullopt;
  auto bytes = view.source.read(offset, size);
  if (bytes) return std::move(*bytes);
  faults_.error(json_.place(*view.json), bytes.error());
  view.is_faulty = true;
  return std::nullopt;
}

}  // namespace laterna::gltf
