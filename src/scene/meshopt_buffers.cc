#include "scene/meshopt_buffers.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace laterna::gltf {
namespace {

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

template <class T>
void store(std::byte* to, T value) {
  std::memcpy(to, &value, sizeof(T));
}

// The extension's round(): halves away from zero. Hostile data may lie outside the target's range.
template <class T>
T rounded(float value) {
  constexpr auto most = static_cast<float>((1 << (8 * sizeof(T) - 1)) - 1);
  const float limited = std::min(std::max(value, -most), most);
  return static_cast<T>(static_cast<int>(limited + (limited >= 0 ? 0.5F : -0.5F)));
}

// "Filter 1: octahedral" of the extension's text, for signed components of 8 or 16 bits.
template <class T>
void decode_octahedral(std::byte* element) {
  constexpr auto most = static_cast<float>((1 << (8 * sizeof(T) - 1)) - 1);
  const float one = load<T>(element + 2 * sizeof(T));
  if (one == 0) {  // corrupt; a zero normal is replaced by the surface's later
    std::memset(element, 0, 3 * sizeof(T));
    return;
  }
  float x = load<T>(element) / one;
  float y = load<T>(element + sizeof(T)) / one;
  const float z = 1 - std::abs(x) - std::abs(y);
  const float fold = std::max(-z, 0.0F);
  x += x >= 0 ? -fold : fold;
  y += y >= 0 ? -fold : fold;
  const float length = std::sqrt(x * x + y * y + z * z);  // at least 1/√3
  store(element, rounded<T>(x / length * most));
  store(element + sizeof(T), rounded<T>(y / length * most));
  store(element + 2 * sizeof(T), rounded<T>(z / length * most));
}

// "Filter 2: quaternion": three components and which one was left out.
void decode_quaternion(std::byte* element) {
  constexpr float most = 32767;
  const int last = load<std::int16_t>(element + 6);
  const float scale = std::sqrt(0.5F) / static_cast<float>(last | 3);
  const float x = load<std::int16_t>(element) * scale;
  const float y = load<std::int16_t>(element + 2) * scale;
  const float z = load<std::int16_t>(element + 4) * scale;
  const float w = std::sqrt(std::max(0.0F, 1 - x * x - y * y - z * z));
  const auto largest = static_cast<std::size_t>(last & 3);
  const float components[4] = {w, x, y, z};
  for (std::size_t i = 0; i < 4; ++i) {
    store(element + 2 * ((largest + i) % 4), rounded<std::int16_t>(components[i] * most));
  }
}

// "Filter 3: exponential": m · 2^e with 8 bits of exponent above 24 bits of mantissa.
void decode_exponential(std::byte* number) {
  const auto bits = load<std::uint32_t>(number);
  const auto exponent = static_cast<std::int8_t>(bits >> 24);
  const std::int32_t mantissa = static_cast<std::int32_t>(bits << 8) >> 8;
  store(number, std::ldexp(static_cast<float>(mantissa), exponent));
}

void apply_filter(std::span<std::byte> decoded, const MeshoptLayout& layout) {
  const std::size_t step = layout.filter == MeshoptFilter::exponential ? 4 : layout.stride;
  for (std::size_t at = 0; at < decoded.size(); at += step) {
    std::byte* element = decoded.data() + at;
    switch (layout.filter) {
      case MeshoptFilter::none:
        return;
      case MeshoptFilter::octahedral:
        layout.stride == 4 ? decode_octahedral<std::int8_t>(element)
                           : decode_octahedral<std::int16_t>(element);
        break;
      case MeshoptFilter::quaternion:
        decode_quaternion(element);
        break;
      case MeshoptFilter::exponential:
        decode_exponential(element);
        break;
    }
  }
}

std::string find_stride_fault(const MeshoptLayout& layout) {
  const std::uint64_t stride = layout.stride;
  if (layout.mode != MeshoptMode::attributes) {
    if (stride != 2 && stride != 4)
      return fmt::format("byteStride must be 2 or 4 for indices, got {}", stride);
    if (layout.filter != MeshoptFilter::none) return "a filter is only allowed with mode \"ATTRIBUTES\"";
    return {};
  }
  if (stride == 0 || stride > 256 || stride % 4 != 0) {
    return fmt::format("byteStride must be a multiple of 4 up to 256, got {}", stride);
  }
  if (layout.filter == MeshoptFilter::octahedral && stride != 4 && stride != 8) {
    return fmt::format("byteStride must be 4 or 8 with filter \"OCTAHEDRAL\", got {}", stride);
  }
  if (layout.filter == MeshoptFilter::quaternion && stride != 8) {
    return fmt::format("byteStride must be 8 with filter \"QUATERNION\", got {}", stride);
  }
  return {};
}

}  // namespace

std::string find_fault(const MeshoptLayout& layout, std::size_t compressed_size) {
  if (std::string fault = find_stride_fault(layout); !fault.empty()) return fault;
  const std::uint64_t size = compressed_size;
  std::uint64_t most = 0;
  switch (layout.mode) {
    case MeshoptMode::attributes:
      most = size * kMaxMeshoptRatio / layout.stride;
      break;
    case MeshoptMode::triangles:
      most = size * 3;
      break;  // at least a byte per triangle
    case MeshoptMode::indices:
      most = size;
      break;  // at least a byte per index
  }
  if (layout.mode == MeshoptMode::triangles && layout.count % 3 != 0) {
    return fmt::format("count must be a multiple of 3 with mode \"TRIANGLES\", got {}", layout.count);
  }
  if (layout.count > most) {
    return fmt::format("{} elements cannot come out of {} compressed bytes", layout.count, compressed_size);
  }
  return {};
}

tl::expected<std::vector<std::byte>, std::string> decode_meshopt(std::span<const std::byte> compressed,
                                                                 const MeshoptLayout& layout) {
  std::vector<std::byte> decoded(layout.count * layout.stride);
  const auto* source = reinterpret_cast<const unsigned char*>(compressed.data());
  int status = 0;
  switch (layout.mode) {
    case MeshoptMode::attributes:
      status =
          meshopt_decodeVertexBuffer(decoded.data(), layout.count, layout.stride, source, compressed.size());
      break;
    case MeshoptMode::triangles:
      status =
          meshopt_decodeIndexBuffer(decoded.data(), layout.count, layout.stride, source, compressed.size());
      break;
    case MeshoptMode::indices:
      status =
          meshopt_decodeIndexSequence(decoded.data(), layout.count, layout.stride, source, compressed.size());
      break;
  }
  if (status != 0)
    return tl::unexpected(fmt::format("the compressed data are corrupt (meshoptimizer: {})", status));
  apply_filter(decoded, layout);
  return decoded;
}

}  // namespace laterna::gltf
