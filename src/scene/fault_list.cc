#include "scene/fault_list.h"

#include <fmt/format.h>

namespace laterna {

void FaultList::error(std::string place, std::string message) {
  ++error_count_;
  if (errors_.size() < kMaxErrors) errors_.push_back({file_, std::move(place), std::move(message)});
}

void FaultList::warning(std::string place, std::string message) {
  if (warnings_.size() < kMaxErrors) warnings_.push_back({file_, std::move(place), std::move(message)});
}

std::vector<Diagnostic> FaultList::errors() const {
  std::vector<Diagnostic> all = errors_;
  if (error_count_ > errors_.size()) {
    all.push_back({file_, {}, fmt::format("and {} more faults", error_count_ - errors_.size())});
  }
  return all;
}

}  // namespace laterna
