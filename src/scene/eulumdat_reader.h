// EULUMDAT (.ldt), as Stockmar described it in 1990: one value to a line, candela for 1000 lm of the lamps' flux.
#pragma once

#include <string>
#include <string_view>

#include "laterna/lamps.h"

namespace laterna {

/// `file` stands in messages.
Result<LightDistribution> read_eulumdat(std::string_view text, const std::string& file);

}  // namespace laterna
