// Where photographs count less, so that no seam shows where one ends.
#pragma once

#include "image/mip_chain.h"
#include "shadow/depth_map.h"

namespace laterna::render {

/// Longest side of a depth map from which feathers are made.
inline constexpr int kFeatherMapSide = 768;

/// From 0 at the sides of the photograph, at the rims of what stands before something else (`depth` is what the photograph
/// sees) and at its mask, smoothly to 1 at `width`, a share of the longer side. One texel per texel of the depth map.
image::MipChain make_feather(const shadow::DepthMap& depth, const image::MipChain& picture, double width);

}  // namespace laterna::render
