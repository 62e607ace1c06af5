// Fewer vertices for the same triangles: equal ones become one, unused ones go.
#pragma once

#include "laterna/scene.h"

namespace laterna {

/// Joins vertices that agree bit for bit in every attribute, so that a mesh whose file gives every face its
/// own corners is smooth and small. The order of first use is kept; indices are made where there are none.
void join_identical_vertices(Primitive& primitive);

/// Drops vertices that no index names. Exporters let many primitives share one long list of vertices; kept whole, it
/// would be there once for each of them. Their order is kept.
void drop_unused_vertices(Primitive& primitive);

}  // namespace laterna
