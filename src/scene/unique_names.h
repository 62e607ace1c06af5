// Cameras and lights are called by name, so no two may have the same.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace laterna {

class UniqueNames {
 public:
  /// `wanted`, or the first of "wanted.2", "wanted.3", … that is free; taken from then on.
  std::string take(const std::string& wanted);
  [[nodiscard]] bool is_taken(const std::string& name) const { return taken_.contains(name); }

 private:
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, std::size_t>
      last_number_;  // so that a thousand equal names take no million tries
};

}  // namespace laterna
