// What this library was built with.
#pragma once

#include <string>
#include <vector>

namespace laterna {

/// "0.1.0"
std::string version();

struct Component {
  std::string name, version;
};
/// The libraries it was built with, with their versions.
std::vector<Component> components();

}  // namespace laterna
