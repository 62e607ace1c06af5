// Lamp files of the examples, from formulas.
#pragma once

#include <filesystem>

#include "laterna/result.h"

namespace laterna::examples {

/// A reflector downlight: a bright core, a ring where the reflector ends, and a soft rest. All round alike.
Result<void> write_downlight(const std::filesystem::path& file);

/// A lamp whose light goes to the side of C90, as for lighting walls. Alike on both sides of the C90–C270 plane.
Result<void> write_wall_washer(const std::filesystem::path& file);

}  // namespace laterna::examples
