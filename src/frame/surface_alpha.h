// The alpha of a surface at one point, for rays. N points at a time: surface_alpha-inl.h, the same numbers.
#pragma once

#include "frame/frame.h"

namespace laterna::frame {

/// Base colour's alpha at the point of triangle `id` with weights b and c of its second and third corner: factor,
/// vertex colour and the full-size texture, bilinearly filtered.
float alpha_at(const Frame& frame, TriangleId id, float b, float c);

/// The alpha below which a surface is a hole. Blended surfaces, where they are cut at all (shadows), are cut at a half.
float cutoff_of(const Surface& surface);

}  // namespace laterna::frame
