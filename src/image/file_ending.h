// The ending of a file's name, which decides the format of a picture that is written.
#pragma once

#include <algorithm>
#include <string_view>

namespace laterna::image {

/// True when `name` ends with `ending`, which is in lower case; the name's own ASCII letters may be of either
/// case.
inline bool has_ending(std::string_view name, std::string_view ending) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return name.size() >= ending.size() &&
         std::equal(ending.begin(), ending.end(), name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                    [&](char expected, char found) { return expected == lower(found); });
}

}  // namespace laterna::image
