#include "scene/unique_names.h"

#include <fmt/format.h>

namespace laterna {

std::string UniqueNames::take(const std::string& wanted) {
  if (taken_.insert(wanted).second) return wanted;
  std::size_t& number = last_number_.try_emplace(wanted, 1).first->second;
  for (;;) {
    std::string name = fmt::format("{}.{}", wanted, ++number);
    if (taken_.insert(name).second) return name;
  }
}

}  // namespace laterna
