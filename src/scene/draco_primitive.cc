#include "scene/draco_primitive.h"

#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "scene/gltf_accessors.h"

namespace laterna::gltf {
namespace {

std::optional<ComponentType> component_type_of(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return ComponentType::i8;
    case draco::DT_UINT8:
      return ComponentType::u8;
    case draco::DT_INT16:
      return ComponentType::i16;
    case draco::DT_UINT16:
      return ComponentType::u16;
    case draco::DT_UINT32:
      return ComponentType::u32;
    case draco::DT_FLOAT32:
      return ComponentType::f32;
    default:
      return std::nullopt;
  }
}

// The library holds its sequential method to the size of the data, but takes memory for as many triangles as an
// Edgebreaker header claims. Its symbols take a bit per triangle, or less where they repeat; no mesh comes near this.
constexpr std::uint64_t kMostTrianglesPerByte = 1000;

// The number of triangles in an Edgebreaker header; 0 for another method, and where the library will see for itself that
// the header is broken. `buffer` is a copy: reading it does not move the decoder's.
std::uint64_t claimed_triangles(draco::DecoderBuffer buffer) {
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) return 0;
  if (header.encoder_method != draco::MESH_EDGEBREAKER_ENCODING) return 0;
  const auto version =
      static_cast<std::uint16_t>(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
  buffer.set_bitstream_version(version);
  if (version >= DRACO_BITSTREAM_VERSION(1, 3) && (header.flags & METADATA_FLAG_MASK) != 0) {
    draco::GeometryMetadata metadata;
    if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) return 0;
  }
  std::uint8_t traversal = 0;
  if (!buffer.Decode(&traversal)) return 0;
  const auto read = [&](std::uint32_t& number) {  // fixed width before bitstream 2.0
    return version < DRACO_BITSTREAM_VERSION(2, 0) ? buffer.Decode(&number)
                                                   : draco::DecodeVarint(&number, &buffer);
  };
  std::uint32_t new_vertices = 0, vertices = 0, triangles = 0;
  if (version < DRACO_BITSTREAM_VERSION(2, 2) && !read(new_vertices)) return 0;
  if (!read(vertices) || !read(triangles)) return 0;
  return std::max<std::uint64_t>(triangles, vertices / 3);
}

}  // namespace

tl::expected<DracoMesh, std::string> DracoMesh::decode(std::span<const std::byte> compressed) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(compressed.data()), compressed.size());
  try {
    const std::uint64_t claimed = claimed_triangles(buffer);
    if (claimed > compressed.size() * kMostTrianglesPerByte) {
      return tl::unexpected(
          fmt::format("the compressed mesh claims {} triangles, which cannot come out of {} bytes", claimed,
                      compressed.size()));
    }
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
      return tl::unexpected(
          fmt::format("the compressed mesh is corrupt (Draco: {})", decoded.status().error_msg()));
    }
    DracoMesh mesh(std::shared_ptr<const draco::Mesh>(std::move(decoded).value()));
    for (std::uint32_t f = 0; f < mesh.mesh_->num_faces(); ++f) {
      for (const draco::PointIndex& point : mesh.mesh_->face(draco::FaceIndex(f))) {
        if (point.value() >= mesh.mesh_->num_points())
          return tl::unexpected<std::string>("the compressed mesh holds indices out of range");
      }
    }
    return mesh;
  } catch (const std::exception& problem) {  // claims of absurd sizes end as failed allocations
    return tl::unexpected(fmt::format("the compressed mesh cannot be decoded ({})", problem.what()));
  }
}

std::size_t DracoMesh::vertex_count() const { return mesh_->num_points(); }

std::vector<std::uint32_t> DracoMesh::indices() const {
  std::vector<std::uint32_t> indices;
  indices.reserve(std::size_t{mesh_->num_faces()} * 3);
  for (std::uint32_t f = 0; f < mesh_->num_faces(); ++f) {
    for (const draco::PointIndex& point : mesh_->face(draco::FaceIndex(f))) indices.push_back(point.value());
  }
  return indices;
}

tl::expected<std::vector<float>, std::string> DracoMesh::attribute(std::uint64_t unique_id,
                                                                   std::size_t components,
                                                                   bool normalized) const {
  const draco::PointAttribute* attribute =
      unique_id > std::numeric_limits<std::uint32_t>::max()
          ? nullptr
          : mesh_->GetAttributeByUniqueId(static_cast<std::uint32_t>(unique_id));
  if (attribute == nullptr)
    return tl::unexpected(fmt::format("the compressed mesh has no attribute {}", unique_id));
  const std::optional<ComponentType> type = component_type_of(attribute->data_type());
  const auto stored_components = static_cast<std::size_t>(attribute->num_components());
  if (!type || stored_components != components) {
    return tl::unexpected(fmt::format("attribute {} of the compressed mesh has {} components of type {}",
                                      unique_id, stored_components,
                                      static_cast<int>(attribute->data_type())));
  }
  if (!attribute->is_mapping_identity() && attribute->indices_map_size() < vertex_count()) {
    return tl::unexpected(fmt::format("attribute {} of the compressed mesh lacks values", unique_id));
  }
  std::vector<float> values(vertex_count() * components);
  for (std::uint32_t point = 0; point < mesh_->num_points(); ++point) {
    const draco::AttributeValueIndex entry = attribute->mapped_index(draco::PointIndex(point));
    if (entry.value() >= attribute->size())
      return tl::unexpected<std::string>("the compressed mesh holds values out of range");
    const auto* from = reinterpret_cast<const std::byte*>(attribute->GetAddress(entry));
    for (std::size_t c = 0; c < components; ++c) {
      const float value = to_float(from + c * size_of(*type), *type, normalized);
      if (!std::isfinite(value)) {
        return tl::unexpected(
            fmt::format("vertex {} of attribute {} is not a finite number", point, unique_id));
      }
      values[point * components + c] = value;
    }
  }
  return values;
}

}  // namespace laterna::gltf
