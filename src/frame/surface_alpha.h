// The alpha of a surface at one point, for rays. N points at a time: surface_alpha-inl.h, the same numbers.
#pragma once

#include "frame/frame.h"

namespace laterna::frame {

/// Base colour's alpha at the point of triangle `id` with weights b and c of its second and third corner: factor,
/// vertex colour and the full-size texture, bilinearly filtered.
float alpha_at(const Frame& frame, TriangleId id, float b, float c);
/// Whether a cut-out has a hole there; false for any other surface.
bool is_hole(const Frame& frame, TriangleId id, float b, float c);

}  // namespace laterna::frame
