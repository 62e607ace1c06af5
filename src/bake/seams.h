// Where surfaces are cut open for their light maps: the same light on both sides.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "frame/frame.h"
#include "frame/triangle_neighbours.h"
#include "laterna/image.h"

namespace laterna::bake {

/// A point of an edge that two triangles share, whose places in the page lie apart: what is read there by bilinear look-up on one
/// side less what is read on the other is Σ weight · luxel.
struct SeamPoint {
  std::array<std::uint32_t, 8> luxel{};  ///< in the page, row by row
  std::array<float, 8> weight{};
};

/// Of the triangles of a page, about two to a luxel along each seam. Edges at which shading normals part are none: there the
/// light changes with them; nor are bends of more than 45°. `materials`: whether triangles of a material are on the page.
std::vector<SeamPoint> find_seams(const frame::Frame& frame, const frame::TriangleNeighbours& neighbours,
                                  const std::vector<bool>& materials, glm::ivec2 size);

/// Changes the luxels beside seams as little as it takes for both sides to read alike, by least squares: Iwanicki 2013,
/// Lighting technology of The Last of Us. The pictures of the page are of floats, three channels; nothing becomes less than 0.
void join_seams(std::span<const SeamPoint> seams, std::span<Image* const> pictures);

}  // namespace laterna::bake
