// Measured lamps: luminous intensity by direction, as IES LM-63 and EULUMDAT files hold it. docs/lamps.md tells which
// way round a lamp is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "laterna/result.h"
#include "laterna/view.h"

namespace laterna {

/// How two angles name a direction (CIE 121; LM-63). In the light's own space, which looks down −Z:
///   type_c  vertical γ from −Z, horizontal C around it: (sin γ cos C, sin γ sin C, −cos γ)
///   type_b  vertical V around the ±Y axis, horizontal H toward it: (cos H sin V, −sin H, −cos H cos V)
///   type_a  vertical V toward the ±X axis, horizontal H around it: (sin V, −cos V sin H, −cos V cos H)
/// Both angles are 0 straight along the light, as glTF's EXT_lights_ies has it.
enum class PhotometricType : std::uint8_t { type_c, type_b, type_a };

/// Candela on a grid of angles, interpolated linearly in both; dark outside the grid.
struct LightDistribution {
  std::string name;       ///< for messages: the file
  std::string format;     ///< "IESNA:LM-63-2002", "EULUMDAT", …
  std::string luminaire;  ///< what the file calls the lamp; may be empty
  PhotometricType type = PhotometricType::type_c;
  /// Degrees, ascending. Type C: within [0, 180]; A and B: within [−90, 90].
  std::vector<double> vertical_deg;
  /// Degrees, ascending, symmetries written out. Type C: from at most 0 to at least 360; A and B: within [−90, 90].
  std::vector<double> horizontal_deg;
  /// Of horizontal angle h and vertical angle v at [h · vertical_deg.size() + v]; all multipliers are in.
  std::vector<double> candela;
  /// What all lamps together are rated at; none: absolute photometry. `candela` does not depend on it.
  std::optional<double> rated_lumens;
  double watts = 0;         ///< as the file says; 0: unknown
  glm::dvec3 opening_m{0};  ///< luminous opening along X, Y and Z in metres; negative: round (LM-63)
  /// TILT of LM-63: degrees and factors by which a lamp that is tilted gives another flux. Kept, not applied.
  std::vector<std::array<double, 2>> tilt;

  [[nodiscard]] double at(std::size_t horizontal, std::size_t vertical) const {
    return candela[horizontal * vertical_deg.size() + vertical];
  }
};

/// Angles of a lamp file: each list at most this long, and at most this many candela values.
inline constexpr std::size_t kMaxLampAngles = 10000, kMaxLampValues = std::size_t{1} << 22U;
/// Degrees between neighbouring angles, at least.
inline constexpr double kLeastLampStep = 1e-3;

/// Reads an IES LM-63 file (1986, 1991, 1995, 2002, 2019) or a EULUMDAT one, whichever it is. Errors name the line.
Result<LightDistribution> read_lamp_file(const std::filesystem::path& file);
/// The same from memory: `name` stands in messages, a file that TILT names is looked for in `folder`.
Result<LightDistribution> read_lamp(std::span<const std::byte> bytes, const std::string& name,
                                    const std::filesystem::path& folder);

/// What is wrong with a distribution: angles that do not ascend, candela that are no finite numbers from 0. Empty when
/// nothing is.
std::string find_fault(const LightDistribution& distribution);

/// Unit vector in the light's space: X right, Y up, −Z along the light.
glm::dvec3 lamp_direction(PhotometricType type, double vertical_deg, double horizontal_deg);
/// Intensity toward a direction of the light's space, of any length but 0. Bilinear in the file's angles.
double candela_toward(const LightDistribution& distribution, const glm::dvec3& direction_ls);
/// Lumens: the intensity, as candela_toward() interpolates it, integrated over all directions, in closed form cell by
/// cell.
double luminous_flux(const LightDistribution& distribution);

/// Degrees from the light's axis beyond which it is dark, at most 180; may be more than needed for types A and B.
double angle_from_axis(const LightDistribution& distribution);

/// A section through the beam, a full turn.
struct LampSection {
  double peak_cd = 0;
  /// Full angles between the outermost directions that have at least 50 % and 10 % of the lamp's peak, up to 90° from
  /// the axis (where the peak lies behind, from the opposite of it); none: this section stays below.
  std::optional<double> beam_angle_deg, field_angle_deg;
};
struct LampSummary {
  double flux_lm = 0, peak_cd = 0;
  double peak_vertical_deg = 0, peak_horizontal_deg = 0;
  /// The light's X–Z plane (C0–C180), and its Y–Z plane (C90–C270).
  std::array<LampSection, 2> sections;
};
LampSummary summarise(const LightDistribution& distribution);

/// A beam of equal intensity within a cone: flux = I · 2π (1 − cos α). 1000 lm within 20° are 2639 cd.
double candela_of_cone(double lumens, Angle half_angle);
double lumens_of_cone(double candela, Angle half_angle);

}  // namespace laterna
