// Scenes as they are at one instant, for files and programs that are to show no other.
#pragma once

#include <vector>

#include "laterna/scene.h"

namespace laterna {

/// Whether anything in the scene may look different at another time: it has clips, films, or waves that run.
bool changes_with_time(const Scene& scene);

/// Leaves the scene as it is at a time in seconds, whenever it is looked at then: what clips move stays where it then is, without
/// clips; films are the pictures that they then show; waves get the phase that they then have, and speed 0. A picture of it at
/// any time is, bit for bit, what the scene showed at `seconds`. The scene must be at rest, and is not changed where there is an
/// error.
///
/// Gives what is wrong with films without keeping them from being shown: they end early. Errors: bad_input for a scene that
/// validate() refuses and for a film whose frame cannot be read, bad_usage for a time beyond ±kMaxSceneTime.
Result<std::vector<Diagnostic>> make_still(Scene& scene, double seconds);

}  // namespace laterna
