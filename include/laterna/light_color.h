// Colours of lamps: of black bodies by their temperature, and of the filters before them.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string_view>

namespace laterna {

inline constexpr double kLeastKelvin = 1000, kMostKelvin = 40000;

/// Linear Rec. 709 colour of a black body at a temperature in [kLeastKelvin, kMostKelvin] (held to it), of luminance 1,
/// so that a lamp's candela, lux or lumens stay what they are. Below about 1900 K black bodies are redder than Rec. 709 can
/// show: the negative blue is left out.
///
/// Planck's law times the CIE 1931 observer, summed at 380, 390, … 780 nm in double: chromaticities are those of finer
/// tables to 1e-4.
glm::vec3 color_of_temperature(double kelvin);

/// A filter that lighting people know by name.
struct Gel {
  std::string_view name;  ///< in rigs
  std::string_view meaning;
  /// Colour conversion: turns a lamp of the one temperature into one of the other; 0: does not.
  double from_kelvin = 0, to_kelvin = 0;
  double density = 0;  ///< of a neutral filter, which passes 10^−density
};
std::span<const Gel> list_gels();

/// What the gel passes of linear R, G and B, each in [0, 1]. Colour conversion: of all filters that do it, the clearest;
/// real ones absorb some more.
glm::vec3 transmission(const Gel& gel);

}  // namespace laterna
