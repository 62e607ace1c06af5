// accessors[] of a glTF file: every range is checked before a byte is touched, then elements are read as
// floats or as indices, whatever they are stored as.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf_buffers.h"

namespace laterna::gltf {

enum class ComponentType : std::uint16_t {
  i8 = 5120,
  u8 = 5121,
  i16 = 5122,
  u16 = 5123,
  u32 = 5125,
  f32 = 5126
};

std::size_t size_of(ComponentType type);

/// One component as glTF's normalised integers or plain numbers become floats.
float to_float(const std::byte* component, ComponentType type, bool normalized);

class Accessors {
 public:
  /// More elements than any scene that fits in memory has; a few such counts still multiply without overflow.
  static constexpr std::uint64_t kMaxElements = std::uint64_t{1} << 30;
  /// Elements that no stored bytes vouch for (accessors without a buffer view), in all reads together: a file
  /// of a few bytes must not fill the memory.
  static constexpr std::uint64_t kMaxZeroElements = std::uint64_t{1} << 22;

  Accessors(const JsonDocument& json, Buffers& buffers, FaultList& faults);

  [[nodiscard]] std::size_t size() const { return accessors_.size(); }
  [[nodiscard]] std::uint64_t element_count(int accessor) const { return at(accessor).count; }
  [[nodiscard]] ComponentType component_type(int accessor) const { return at(accessor).component_type; }
  [[nodiscard]] bool is_normalized(int accessor) const { return at(accessor).normalized; }
  [[nodiscard]] int components(int accessor) const { return at(accessor).components; }
  /// "accessors[3]"
  [[nodiscard]] std::string place(int accessor) const { return json_.place(*at(accessor).json); }

  /// Elements of Vector (glm::vec2, vec3, vec4), all finite. Nothing when the accessor is faulty or a value
  /// is not finite; reported. `place` is where a wrong number of components is reported.
  template <class Vector>
  std::optional<std::vector<Vector>> read(int accessor, const std::string& place);

  /// RGB or RGBA; alpha is 1 where there is none. Integers are fractions even where the file forgets to say
  /// so.
  std::optional<std::vector<glm::vec4>> read_colors(int accessor, const std::string& place);

  /// All components one after the other, of elements with `components` each (1 to 4, 16), read alike: normalised integers are
  /// fractions. `place` is where another number of components is reported.
  std::optional<std::vector<float>> read_numbers(int accessor, int components, const std::string& place);

  /// Unsigned integers. `place` is where a type that is no index type is reported.
  std::optional<std::vector<std::uint32_t>> read_indices(int accessor, const std::string& place);

 private:
  struct Sparse {
    std::uint64_t count = 0;
    int index_view = -1, value_view = -1;
    std::uint64_t index_offset = 0, value_offset = 0;
    ComponentType index_type = ComponentType::u32;
  };
  struct Accessor {
    const JsonValue* json = nullptr;
    int view = -1;
    std::uint64_t offset = 0, count = 0;
    ComponentType component_type = ComponentType::f32;
    int components = 1;
    std::size_t element_size = 4;  // with the padding of small matrices' columns
    bool normalized = false;
    std::optional<Sparse> sparse;
    bool is_faulty = false;
  };

  [[nodiscard]] const Accessor& at(int accessor) const {
    return accessors_[static_cast<std::size_t>(accessor)];
  }
  Accessor parse(const JsonValue& value);
  bool parse_type(JsonObject& object, Accessor& accessor);
  std::optional<ComponentType> parse_component_type(JsonObject& object);
  std::optional<Sparse> parse_sparse(const JsonValue& value, const Accessor& accessor);
  bool range_fits(JsonObject& object, int view, std::uint64_t offset, std::uint64_t count,
                  std::size_t component_size, std::size_t element_size, std::uint64_t stride);
  bool take_zero_elements(const Accessor& accessor);
  [[nodiscard]] std::uint64_t stride_of(const Accessor& accessor) const;
  std::optional<OwnedSpan> read_elements(const Accessor& accessor);
  std::optional<OwnedSpan> read_sparse_values(const Accessor& accessor);
  bool read_floats(const Accessor& accessor, bool normalized, std::span<float> values);
  std::optional<std::vector<std::uint32_t>> read_sparse_indices(const Accessor& accessor);
  bool add_sparse(const Accessor& accessor, bool normalized, std::span<float> values);
  bool all_finite(const Accessor& accessor, std::span<const float> values);
  bool has_components(int accessor, int expected, const std::string& place);

  const JsonDocument& json_;
  Buffers& buffers_;
  FaultList& faults_;
  std::vector<Accessor> accessors_;
  std::uint64_t zero_elements_ = 0;
};

}  // namespace laterna::gltf
