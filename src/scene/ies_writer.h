// Measured lamps to IES LM-63.
#pragma once

#include <string>

#include "laterna/lamps.h"

namespace laterna {

/// The text of a file of the 2002 edition, whose angles, candela, rating and opening read_lamp() reads again bit for bit.
/// Error: why LM-63 cannot hold the lamp.
tl::expected<std::string, std::string> write_ies(const LightDistribution& lamp);

}  // namespace laterna
