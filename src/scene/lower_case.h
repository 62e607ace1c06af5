// Names of files, compared without regard to case.
#pragma once

#include <string>

namespace laterna {

/// `text` with its ASCII letters in lower case, whatever the locale.
inline std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

}  // namespace laterna
