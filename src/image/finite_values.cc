#include "image/finite_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace laterna::image {

std::optional<Diagnostic> find_not_finite(const Image& image, const std::string& name) {
  const std::span<const float> values = image.values<float>();
  const auto bad = std::find_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); });
  if (bad == values.end()) return std::nullopt;
  const auto pixel =
      static_cast<std::size_t>(bad - values.begin()) / static_cast<std::size_t>(image.channels());
  const auto width = static_cast<std::size_t>(image.width());
  return Diagnostic{name, fmt::format("pixel {}, {}", pixel % width, pixel / width),
                    fmt::format("expected finite numbers in a picture that is used, got {}", *bad)};
}

}  // namespace laterna::image
