// buffers[] and bufferViews[] of a glTF file: bytes of the GLB, of files beside it, of data URIs; compressed
// views are decoded when first asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/byte_source.h"
#include "scene/fault_list.h"
#include "scene/gltf_container.h"
#include "scene/json_document.h"
#include "scene/json_object.h"
#include "scene/meshopt_buffers.h"

namespace laterna::gltf {

class Buffers {
 public:
  /// Faults go to `faults`; later calls are safe after any fault.
  Buffers(const JsonDocument& json, const Container& container, std::filesystem::path folder,
          FaultList& faults);

  [[nodiscard]] std::size_t view_count() const { return views_.size(); }
  /// Size in bytes, decoded. 0 when the view is faulty.
  [[nodiscard]] std::uint64_t size(int view) const { return views_[static_cast<std::size_t>(view)].size; }
  /// bufferViews[].byteStride; 0 when elements follow each other closely.
  [[nodiscard]] std::uint64_t stride(int view) const { return views_[static_cast<std::size_t>(view)].stride; }
  /// Where the view begins in its buffer; 0 for compressed views, which begin anew.
  [[nodiscard]] std::uint64_t offset(int view) const { return views_[static_cast<std::size_t>(view)].offset; }
  /// Bytes of a view; the part must lie within size(). Nothing when the view is faulty or cannot be read;
  /// reported.
  std::optional<OwnedSpan> read(int view, std::uint64_t offset, std::uint64_t size);
  std::optional<OwnedSpan> read(int view) { return read(view, 0, size(view)); }

 private:
  struct Buffer {
    std::optional<ByteSource> source;  // none: a fallback, or nothing that anyone may read
    bool is_fallback = false;
    bool is_faulty = false;  // and has been reported
  };
  struct View {
    const JsonValue* json = nullptr;
    ByteSource source;  // compressed bytes where `compressed` is set
    std::uint64_t size = 0, stride = 0, offset = 0;
    std::optional<MeshoptLayout> compressed;
    bool is_faulty = false;
  };

  [[nodiscard]] Buffer read_buffer(const JsonValue& value, std::size_t index);
  tl::expected<ByteSource, std::string> open_uri(const std::string& uri);
  View read_view(const JsonValue& value);
  bool read_compression(const JsonValue& extension, View& view);
  std::optional<ByteSource> slice(JsonObject& object);
  bool decode(View& view);

  const JsonDocument& json_;
  const Container& container_;
  std::filesystem::path folder_;
  FaultList& faults_;
  std::vector<Buffer> buffers_;
  std::vector<View> views_;
  std::uint64_t most_decoded_bytes_ = 0;  // that the remaining compressed views may still hold
};

}  // namespace laterna::gltf
