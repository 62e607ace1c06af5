// Relief textures: heights on a surface, so that light, slides and shadows fall on them as on a displaced mesh.
#pragma once

#include "laterna/scene.h"

namespace laterna {

/// Deepest relief, in metres.
inline constexpr double kMaxReliefDepth = 1e4;
/// Most samples of a relief's picture: 8192 × 8192.
inline constexpr std::int64_t kMaxReliefSamples = std::int64_t{1} << 26;

/// What a relief's picture holds.
enum class ReliefKind : std::uint8_t {
  height,  ///< 1 (white) lies in the polygon's plane, 0 at its full depth
  depth,   ///< the other way round
};

/// A texture with depth (Oliveira, Bishop and McAllister, Relief texture mapping, 2000), pushed into the front of the
/// polygon that bears it: heights are never above the polygon's plane. Found along each ray of sight, so that position,
/// depth, slides and shadows are those of the point that is seen. Surfaces that blend bear none. docs/relief.md
struct Relief {
  /// Linear; its first channel, from 0 to 1. Between the middles of its texels heights run bilinearly, whatever the filters
  /// of its sampler say.
  Texture texture;
  double depth = 0.01;  ///< metres, in the world: a node's scale plays no part; 0 … kMaxReliefDepth, 0: flat
  ReliefKind kind = ReliefKind::height;
  bool self_shadow = true;  ///< its heights shade one another, in light that casts shadows
  /// Where a ray of sight leaves the rectangle of texture coordinates that the mesh's surface spans before it meets the
  /// relief, there is nothing: the outline then shows the relief.
  bool cut_edges = false;
};

}  // namespace laterna
