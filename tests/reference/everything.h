// A small scene that uses everything at once, for tests of sameness.
#pragma once

#include <gtest/gtest.h>

#include "laterna/render.h"
#include "laterna/scene.h"

namespace laterna::reference {

/// Textures with mips, cut-outs, blended surfaces one over another, a normal map, metal, emission, an unlit surface,
/// vertex colours, instances, objects that cast or receive no shadow; every type of light, fading, slide border,
/// beam profile, shadow filter and bias.
Scene everything();
View everything_view(int width, int height);

/// Every layer there is; that of the passes belongs to Passes::multi.
std::vector<Layer> all_layers(Passes passes = Passes::single);

/// Whether two pictures have the same channels with the same bits (NaN equals itself); if not, says where.
::testing::AssertionResult same_bits(const LayeredImage& a, const LayeredImage& b);

}  // namespace laterna::reference
