// What checks of a scene's parts share: how a fault is said, and the rules that any number, name or reference must meet.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "laterna/scene.h"
#include "scene/fault_list.h"
#include "scene/spelling.h"

namespace laterna {

/// "list[index]", as places of faults are written.
inline std::string item(std::string_view list, std::size_t index) {
  return fmt::format("{}[{}]", list, index);
}

/// A check of a part of a scene derives from it.
class SceneCheck {
 protected:
  SceneCheck(const Scene& scene, FaultList& faults) : scene_(scene), faults_(faults) {}

  void fault(std::string place, std::string message) { faults_.error(std::move(place), std::move(message)); }

  // Reports a value outside [low, high], or not finite.
  void check_number(const std::string& place, double value, double low, double high) {
    if (value >= low && value <= high && std::isfinite(value)) return;
    if (std::isinf(high)) {
      fault(place, fmt::format("expected a finite number of at least {}, got {}", low, value));
    } else {
      fault(place, fmt::format("expected a number from {} to {}, got {}", low, high, value));
    }
  }

  template <class Vector>
  void check_color(const std::string& place, const Vector& color, double high) {
    for (int i = 0; i < Vector::length(); ++i) {
      check_number(item(place, static_cast<std::size_t>(i)), color[i], 0, high);
    }
  }

  // Values that a cast may have put into an enumeration.
  template <class Enumeration>
  void check_enumerator(const std::string& place, Enumeration value, Enumeration last) {
    const auto number = static_cast<unsigned>(value);
    if (number > static_cast<unsigned>(last)) {
      fault(place, fmt::format("{} is no value of the enumeration, which ends at {}", number,
                               static_cast<unsigned>(last)));
    }
  }

  void check_reference(const std::string& place, int index, std::size_t count, std::string_view list) {
    if (index >= -1 && (index < 0 || static_cast<std::size_t>(index) < count)) return;
    fault(place, fmt::format("{} is no index into the {} {}, nor -1 for none", index, count, list));
  }

  template <class Named>
  void check_names(const std::vector<Named>& things, std::string_view list) {
    std::unordered_map<std::string_view, std::size_t> first;
    for (std::size_t i = 0; i < things.size(); ++i) {
      const auto [found, is_new] = first.try_emplace(things[i].name, i);
      if (!is_new) {
        fault(item(list, i) + ".name",
              fmt::format("{} is also the name of {}[{}]", in_quotes(things[i].name), list, found->second));
      }
    }
  }

  const Scene& scene_;
  FaultList& faults_;
};

}  // namespace laterna
