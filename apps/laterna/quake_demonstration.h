// What Quake's surface cache does for a baked scene, shown and counted.
#pragma once

#include <string>

#include "laterna/scene.h"

namespace laterna::app {

/// Writes three pictures of the first camera, or of an overview: the product as `file`, "room.png", and its factors as
/// "room.texture.png" and "room.light.png". Then takes a walk, of one metre to the side and back, and tells what was found in
/// the cache.
Result<void> demonstrate_quake(const Scene& baked, const std::string& file);

/// Whether demonstrate_quake() could write its pictures.
Result<void> check_quake_output(const std::string& file);

}  // namespace laterna::app
