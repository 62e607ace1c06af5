// The layout of a frame's triangles: clusters of up to 128 neighbouring triangles of one material, each with its own
// run of vertices, in world space. A cluster is the unit of culling, of work for a thread, and of what is looked up
// once per many pixels (material, object). Vertices on the border of two clusters are stored in both: for 128
// triangles that costs about a third more vertices, and buys transforms that run straight through memory, 8-bit
// indices and a transformed vertex buffer that stays in the first-level cache.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace laterna {

inline constexpr std::uint32_t kTrianglesPerCluster = 128;
inline constexpr std::uint32_t kTriangleBits = 7;
static_assert(kTrianglesPerCluster == 1U << kTriangleBits);
inline constexpr std::uint32_t kVerticesPerCluster = 256;  // local indices are 8 bits

/// A triangle of a frame: cluster << kTriangleBits | triangle within the cluster.
using TriangleId = std::uint32_t;
inline constexpr TriangleId kNoTriangle = 0xFFFFFFFFU;
inline constexpr std::uint32_t cluster_of(TriangleId id) { return id >> kTriangleBits; }

enum ClusterFlag : std::uint32_t {
  kDoubleSided = 1U << 0U,
  kAlphaMask = 1U << 1U,   // coverage is cut by the alpha of the base colour
  kAlphaBlend = 1U << 2U,  // drawn over what is behind it
  kCastsShadow = 1U << 3U,
  kReceivesShadow = 1U << 4U,
  kVisible = 1U << 5U,       // to cameras
  kTransmissive = 1U << 6U,  // light goes through it, and what lies behind is seen
  kRelief = 1U << 8U,        // cameras see it displaced
};

struct Cluster {
  std::uint32_t first_vertex = 0;
  std::uint16_t vertex_count = 0;    // ≤ kVerticesPerCluster
  std::uint16_t triangle_count = 0;  // ≤ kTrianglesPerCluster
  std::uint32_t flags = 0;           // ClusterFlag
  std::uint32_t material = 0;
  std::uint32_t object = 0;
  float low_ws[3] = {};  // bounds of the vertices
  float high_ws[3] = {};
};

/// Shadows are cast by opaque surfaces and cut-outs; blended and transmissive ones tint what comes through (shadow/panes).
inline constexpr std::uint32_t kPaneFlags = kAlphaBlend | kTransmissive;
inline bool is_opaque_caster(const Cluster& cluster) {
  return (cluster.flags & (kCastsShadow | kPaneFlags)) == kCastsShadow;
}
inline bool is_blended_caster(const Cluster& cluster) {
  return (cluster.flags & kCastsShadow) != 0 && (cluster.flags & kPaneFlags) != 0;
}

/// A view of arrays that a Frame owns.
struct TriangleClusters {
  const glm::vec3* positions_ws = nullptr;  // one per vertex, readable 16 entries beyond the last
  /// At [id]: three local vertex indices, a | b << 8 | c << 16, counter-clockwise seen from the front.
  const std::uint32_t* corners = nullptr;
  std::span<const Cluster> clusters;
};

}  // namespace laterna
