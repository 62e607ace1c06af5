#include "scene/gltf_accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "scene/number_scans.h"

namespace laterna::gltf {
namespace {

constexpr std::string_view kTypeNames[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
constexpr int kTypeComponents[] = {1, 2, 3, 4, 4, 9, 16};

std::string_view type_name(int components) {
  return components <= 4 ? kTypeNames[components - 1] : components == 9 ? "MAT3" : "MAT4";
}

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

// Columns of matrices begin at multiples of four bytes.
std::size_t element_size_of(std::size_t type, std::size_t component_size) {
  const auto components = static_cast<std::size_t>(kTypeComponents[type]);
  if (type < 4) return components * component_size;
  const std::size_t rows = type - 2;
  return rows * ((rows * component_size + 3) / 4 * 4);
}

template <class Stored>
void convert(const std::byte* from, std::size_t stride, std::size_t count, std::size_t components,
             ComponentType type, bool normalized, float* to) {
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < components; ++c) {
      const std::byte* component = from + i * stride + c * sizeof(Stored);
      *to++ = normalized ? to_float(component, type, true) : static_cast<float>(load<Stored>(component));
    }
  }
}

// `from` must hold (count − 1) · stride + components · size bytes.
void convert_all(const std::byte* from, std::size_t stride, std::size_t count, std::size_t components,
                 ComponentType type, bool normalized, float* to) {
  switch (type) {
    case ComponentType::i8:
      return convert<std::int8_t>(from, stride, count, components, type, normalized, to);
    case ComponentType::u8:
      return convert<std::uint8_t>(from, stride, count, components, type, normalized, to);
    case ComponentType::i16:
      return convert<std::int16_t>(from, stride, count, components, type, normalized, to);
    case ComponentType::u16:
      return convert<std::uint16_t>(from, stride, count, components, type, normalized, to);
    case ComponentType::u32:
      return convert<std::uint32_t>(from, stride, count, components, type, normalized, to);
    case ComponentType::f32:
      break;
  }
  if (stride == components * sizeof(float)) {
    std::memcpy(to, from, count * stride);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(to + i * components, from + i * stride, components * sizeof(float));
  }
}

std::uint32_t load_index(const std::byte* from, ComponentType type) {
  switch (type) {
    case ComponentType::u8:
      return load<std::uint8_t>(from);
    case ComponentType::u16:
      return load<std::uint16_t>(from);
    default:
      return load<std::uint32_t>(from);
  }
}

bool is_index_type(ComponentType type) {
  return type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
}

}  // namespace

std::size_t size_of(ComponentType type) {
  switch (type) {
    case ComponentType::i8:
    case ComponentType::u8:
      return 1;
    case ComponentType::i16:
    case ComponentType::u16:
      return 2;
    case ComponentType::u32:
    case ComponentType::f32:
      break;
  }
  return 4;
}

float to_float(const std::byte* component, ComponentType type, bool normalized) {
  const auto fraction = [normalized](auto value, float most) {
    const auto number = static_cast<float>(value);
    return normalized ? std::max(number / most, -1.0F) : number;
  };
  switch (type) {
    case ComponentType::i8:
      return fraction(load<std::int8_t>(component), 127);
    case ComponentType::u8:
      return fraction(load<std::uint8_t>(component), 255);
    case ComponentType::i16:
      return fraction(load<std::int16_t>(component), 32767);
    case ComponentType::u16:
      return fraction(load<std::uint16_t>(component), 65535);
    case ComponentType::u32:
      return static_cast<float>(load<std::uint32_t>(component));
    case ComponentType::f32:
      break;
  }
  return load<float>(component);
}

Accessors::Accessors(const JsonDocument& json, Buffers& buffers, FaultList& faults)
    : json_(json), buffers_(buffers), faults_(faults) {
  JsonObject root(json, json.root(), faults);
  const JsonValue* list = root.array("accessors");
  if (list == nullptr) return;
  accessors_.reserve(list->children.size());
  for (const JsonValue& value : list->children) accessors_.push_back(parse(value));
}

std::optional<ComponentType> Accessors::parse_component_type(JsonObject& object) {
  const std::optional<std::uint64_t> code = object.whole("componentType");
  if (!code) return std::nullopt;
  if (*code >= 5120 && *code <= 5126 && *code != 5124) return static_cast<ComponentType>(*code);
  object.error("componentType", fmt::format("expected 5120, 5121, 5122, 5123, 5125 or 5126, got {}", *code));
  return std::nullopt;
}

bool Accessors::parse_type(JsonObject& object, Accessor& accessor) {
  const std::optional<ComponentType> component_type = parse_component_type(object);
  const auto type = object.choice<std::size_t>(
      "type", {{"SCALAR", 0}, {"VEC2", 1}, {"VEC3", 2}, {"VEC4", 3}, {"MAT2", 4}, {"MAT3", 5}, {"MAT4", 6}});
  if (!component_type || !type) return false;
  accessor.component_type = *component_type;
  accessor.components = kTypeComponents[*type];
  accessor.element_size = element_size_of(*type, size_of(*component_type));
  return true;
}

// Whether `count` elements lie inside the view. Offsets are below 2^54, counts below 2^31 and strides below
// 2^9, so that nothing here overflows 64 bits.
bool Accessors::range_fits(JsonObject& object, int view, std::uint64_t offset, std::uint64_t count,
                           std::size_t component_size, std::size_t element_size, std::uint64_t stride) {
  if ((buffers_.offset(view) + offset) % component_size != 0) {
    object.error("byteOffset",
                 fmt::format("{} (plus the view's {}) is no multiple of the component's size, {}", offset,
                             buffers_.offset(view), component_size));
    return false;
  }
  if (stride < element_size) {
    object.error("bufferView",
                 fmt::format("the byteStride of bufferViews[{}], {}, is less than one element's {} bytes",
                             view, stride, element_size));
    return false;
  }
  const std::uint64_t end = offset + (count - 1) * stride + element_size;
  if (end > buffers_.size(view)) {
    if (buffers_.size(view) > 0) {  // otherwise the view itself has been reported
      object.error("count", fmt::format("{} elements end at byte {}, but bufferViews[{}] has only {}", count,
                                        end, view, buffers_.size(view)));
    }
    return false;
  }
  return true;
}

Accessors::Accessor Accessors::parse(const JsonValue& value) {
  JsonObject object(json_, value, faults_);
  Accessor accessor;
  accessor.json = &value;
  accessor.is_faulty = true;
  const bool is_complete = object.require_all({"componentType", "count", "type"});
  const std::optional<std::uint64_t> count = object.whole("count", 1, kMaxElements);
  if (!parse_type(object, accessor) || !is_complete || !count) return accessor;
  accessor.count = *count;
  accessor.normalized = object.boolean("normalized").value_or(false);
  accessor.view = object.index("bufferView", buffers_.view_count(), "bufferViews");
  const std::optional<std::uint64_t> offset = object.has("byteOffset") ? object.whole("byteOffset") : 0;
  if (!offset) return accessor;
  accessor.offset = *offset;
  if (object.has("bufferView")) {
    if (accessor.view < 0) return accessor;
    if (!range_fits(object, accessor.view, accessor.offset, *count, size_of(accessor.component_type),
                    accessor.element_size, stride_of(accessor))) {
      return accessor;
    }
  }
  if (const JsonValue* sparse = object.object("sparse")) {
    accessor.sparse = parse_sparse(*sparse, accessor);
    if (!accessor.sparse) return accessor;
  }
  accessor.is_faulty = false;
  return accessor;
}

std::optional<Accessors::Sparse> Accessors::parse_sparse(const JsonValue& value, const Accessor& accessor) {
  JsonObject object(json_, value, faults_);
  if (!object.require_all({"count", "indices", "values"})) return std::nullopt;
  const std::optional<std::uint64_t> count = object.whole("count", 1, accessor.count);
  const JsonValue* index_value = object.object("indices");
  const JsonValue* value_value = object.object("values");
  if (!count || index_value == nullptr || value_value == nullptr) return std::nullopt;

  JsonObject indices(json_, *index_value, faults_), values(json_, *value_value, faults_);
  const bool has_indices = indices.require_all({"bufferView", "componentType"});
  const bool has_values = values.require("bufferView");
  Sparse sparse;
  sparse.count = *count;
  sparse.index_view = indices.index("bufferView", buffers_.view_count(), "bufferViews");
  const std::size_t errors_before = faults_.error_count();
  sparse.index_offset = indices.whole("byteOffset").value_or(0);
  sparse.value_view = values.index("bufferView", buffers_.view_count(), "bufferViews");
  sparse.value_offset = values.whole("byteOffset").value_or(0);
  if (faults_.error_count() != errors_before) return std::nullopt;
  const std::optional<ComponentType> type = parse_component_type(indices);
  if (!has_indices || !has_values || !type || sparse.index_view < 0 || sparse.value_view < 0)
    return std::nullopt;
  if (!is_index_type(*type)) {
    indices.error("componentType",
                  fmt::format("expected 5121, 5123 or 5125, got {}", static_cast<int>(*type)));
    return std::nullopt;
  }
  sparse.index_type = *type;
  const std::size_t index_size = size_of(*type);
  if (!range_fits(indices, sparse.index_view, sparse.index_offset, *count, index_size, index_size,
                  index_size) ||
      !range_fits(values, sparse.value_view, sparse.value_offset, *count, size_of(accessor.component_type),
                  accessor.element_size, accessor.element_size)) {
    return std::nullopt;
  }
  return sparse;
}

bool Accessors::take_zero_elements(const Accessor& accessor) {
  zero_elements_ += accessor.count;
  if (zero_elements_ <= kMaxZeroElements) return true;
  faults_.error(
      json_.place(*accessor.json, "count"),
      fmt::format("accessors without a bufferView hold more than {} elements in all", kMaxZeroElements));
  return false;
}

std::uint64_t Accessors::stride_of(const Accessor& accessor) const {
  const std::uint64_t stride = buffers_.stride(accessor.view);
  return stride == 0 ? accessor.element_size : stride;
}

std::optional<OwnedSpan> Accessors::read_elements(const Accessor& accessor) {
  const std::uint64_t size = (accessor.count - 1) * stride_of(accessor) + accessor.element_size;
  return buffers_.read(accessor.view, accessor.offset, size);
}

std::optional<OwnedSpan> Accessors::read_sparse_values(const Accessor& accessor) {
  const Sparse& sparse = *accessor.sparse;
  return buffers_.read(sparse.value_view, sparse.value_offset, sparse.count * accessor.element_size);
}

bool Accessors::read_floats(const Accessor& accessor, bool normalized, std::span<float> values) {
  const auto components = static_cast<std::size_t>(accessor.components);
  if (accessor.view >= 0) {
    const std::uint64_t stride = stride_of(accessor);
    const std::optional<OwnedSpan> bytes = read_elements(accessor);
    if (!bytes) return false;
    convert_all(bytes->bytes.data(), stride, accessor.count, components, accessor.component_type, normalized,
                values.data());
  }
  if (accessor.sparse && !add_sparse(accessor, normalized, values)) return false;
  return all_finite(accessor, values);
}

std::optional<std::vector<std::uint32_t>> Accessors::read_sparse_indices(const Accessor& accessor) {
  const Sparse& sparse = *accessor.sparse;
  const std::size_t index_size = size_of(sparse.index_type);
  const std::optional<OwnedSpan> bytes =
      buffers_.read(sparse.index_view, sparse.index_offset, sparse.count * index_size);
  if (!bytes) return std::nullopt;
  std::vector<std::uint32_t> targets(sparse.count);
  std::uint64_t least = 0;
  for (std::uint64_t i = 0; i < sparse.count; ++i) {
    targets[i] = load_index(bytes->bytes.data() + i * index_size, sparse.index_type);
    if (targets[i] >= accessor.count || targets[i] < least) {
      faults_.error(
          json_.place(*accessor.json) + ".sparse.indices",
          fmt::format("entry {} is {}: expected rising indices up to {}", i, targets[i], accessor.count - 1));
      return std::nullopt;
    }
    least = targets[i] + std::uint64_t{1};
  }
  return targets;
}

bool Accessors::add_sparse(const Accessor& accessor, bool normalized, std::span<float> values) {
  const std::optional<std::vector<std::uint32_t>> targets = read_sparse_indices(accessor);
  const std::optional<OwnedSpan> bytes = read_sparse_values(accessor);
  if (!targets || !bytes) return false;
  const auto components = static_cast<std::size_t>(accessor.components);
  const std::byte* from = bytes->bytes.data();
  for (std::size_t i = 0; i < targets->size(); ++i) {
    convert_all(from + i * accessor.element_size, accessor.element_size, 1, components,
                accessor.component_type, normalized, values.data() + (*targets)[i] * components);
  }
  return true;
}

bool Accessors::all_finite(const Accessor& accessor, std::span<const float> values) {
  const std::size_t at = first_not_finite(values);
  if (at == values.size()) return true;
  faults_.error(json_.place(*accessor.json),
                fmt::format("element {} holds {}: expected finite numbers",
                            at / static_cast<std::size_t>(accessor.components), values[at]));
  return false;
}

bool Accessors::has_components(int accessor, int expected, const std::string& place) {
  if (at(accessor).components == expected) return true;
  faults_.error(place, fmt::format("expected {}, got accessors[{}] of type {}", type_name(expected), accessor,
                                   type_name(at(accessor).components)));
  return false;
}

template <class Vector>
std::optional<std::vector<Vector>> Accessors::read(int index, const std::string& place) {
  static_assert(sizeof(Vector) == Vector::length() * sizeof(float));
  const Accessor& accessor = at(index);
  if (accessor.is_faulty || !has_components(index, Vector::length(), place)) return std::nullopt;
  if (accessor.view < 0 && !take_zero_elements(accessor)) return std::nullopt;
  std::vector<Vector> vectors(accessor.count);
  const std::span<float> floats(&vectors[0].x, accessor.count * static_cast<std::size_t>(Vector::length()));
  if (!read_floats(accessor, accessor.normalized, floats)) return std::nullopt;
  return vectors;
}

template std::optional<std::vector<glm::vec2>> Accessors::read(int, const std::string&);
template std::optional<std::vector<glm::vec3>> Accessors::read(int, const std::string&);
template std::optional<std::vector<glm::vec4>> Accessors::read(int, const std::string&);

std::optional<std::vector<glm::vec4>> Accessors::read_colors(int index, const std::string& place) {
  const Accessor& accessor = at(index);
  if (accessor.is_faulty) return std::nullopt;
  if (accessor.components != 3 && !has_components(index, 4, place)) return std::nullopt;
  if (accessor.view < 0 && !take_zero_elements(accessor)) return std::nullopt;
  const auto components = static_cast<std::size_t>(accessor.components);
  std::vector<float> values(accessor.count * components);
  if (!read_floats(accessor, true, values)) return std::nullopt;
  std::vector<glm::vec4> colors(accessor.count, glm::vec4(1));
  for (std::size_t i = 0; i < colors.size(); ++i) {
    for (std::size_t c = 0; c < components; ++c) colors[i][static_cast<int>(c)] = values[i * components + c];
  }
  return colors;
}

std::optional<std::vector<float>> Accessors::read_numbers(int index, int components,
                                                          const std::string& place) {
  const Accessor& accessor = at(index);
  if (accessor.is_faulty || !has_components(index, components, place)) return std::nullopt;
  if (accessor.view < 0 && !take_zero_elements(accessor)) return std::nullopt;
  std::vector<float> values(accessor.count * static_cast<std::size_t>(components));
  if (!read_floats(accessor, accessor.normalized, values)) return std::nullopt;
  return values;
}

std::optional<std::vector<std::uint32_t>> Accessors::read_indices(int index, const std::string& place) {
  const Accessor& accessor = at(index);
  if (accessor.is_faulty || !has_components(index, 1, place)) return std::nullopt;
  if (!is_index_type(accessor.component_type)) {
    faults_.error(place, fmt::format("expected unsigned integers, got accessors[{}] with componentType {}",
                                     index, static_cast<int>(accessor.component_type)));
    return std::nullopt;
  }
  if (accessor.view < 0 && !take_zero_elements(accessor)) return std::nullopt;
  std::vector<std::uint32_t> indices(accessor.count);
  if (accessor.view >= 0) {
    const std::optional<OwnedSpan> bytes = read_elements(accessor);
    if (!bytes) return std::nullopt;
    const std::uint64_t stride = stride_of(accessor);
    const std::byte* from = bytes->bytes.data();
    if (accessor.component_type == ComponentType::u32 && stride == sizeof(std::uint32_t)) {
      std::memcpy(indices.data(), from, indices.size() * sizeof(std::uint32_t));
    } else {
      for (std::size_t i = 0; i < indices.size(); ++i) {
        indices[i] = load_index(from + i * stride, accessor.component_type);
      }
    }
  }
  if (!accessor.sparse) return indices;
  const std::optional<std::vector<std::uint32_t>> targets = read_sparse_indices(accessor);
  const std::optional<OwnedSpan> bytes = read_sparse_values(accessor);
  if (!targets || !bytes) return std::nullopt;
  for (std::size_t i = 0; i < targets->size(); ++i) {
    indices[(*targets)[i]] =
        load_index(bytes->bytes.data() + i * accessor.element_size, accessor.component_type);
  }
  return indices;
}

}  // namespace laterna::gltf
