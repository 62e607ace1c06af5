// The ending of a file's name, which decides the format of a picture that is written.
#pragma once

#include <algorithm>
#include <string_view>

#include "base/lower_case.h"

namespace laterna::image {

/// True when `name` ends with `ending`, which is in lower case; the name's own ASCII letters may be of either
/// case.
inline bool has_ending(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() &&
         std::equal(ending.begin(), ending.end(), name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                    [&](char expected, char found) { return expected == lower_case(found); });
}

}  // namespace laterna::image
