// Equal vertices become one.
#pragma once

#include "laterna/scene.h"

namespace laterna {

/// Joins vertices that agree bit for bit in every attribute, so that a mesh whose file gives every face its
/// own corners is smooth and small. The order of first use is kept; indices are made where there are none.
void join_identical_vertices(Primitive& primitive);

}  // namespace laterna
