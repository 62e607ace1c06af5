// What those who bake should know beforehand.
#pragma once

#include "laterna/scene.h"

namespace laterna::bake {

/// Adds a warning for every material whose light map will not show what one might expect: metal shows none, and the point of
/// a relief is lit as the flat surface above it.
void warn_of_what_is_not_baked(Scene& scene);

}  // namespace laterna::bake
