// Where projectors' pictures land, told by info and inspect.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "laterna/thrown_picture.h"

namespace laterna::app {

/// Metres, millimetres and lux; what is not known is null.
nlohmann::json json_of(const ThrownPicture& thrown);
/// One line: "2.000 x 1.125 m at 3.000 m, square-on; white is 1333 lx; pixels of 1.04 x 1.04 mm".
std::string text_of(const ThrownPicture& thrown);

}  // namespace laterna::app
