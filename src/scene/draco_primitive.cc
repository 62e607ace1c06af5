#include "scene/draco_primitive.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

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

}  // namespace

tl::expected<DracoMesh, std::string> DracoMesh::decode(std::span<const std::byte> compressed) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(compressed.data()), compressed.size());
  try {
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
