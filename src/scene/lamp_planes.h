// Lamp files leave out what symmetry repeats. Here it is written out.
#pragma once

#include <string>
#include <vector>

#include "laterna/lamps.h"

namespace laterna {

/// What mirrors the planes that a file lists.
enum class LampSymmetry : std::uint8_t {
  none,        ///< they are all there
  full_turn,   ///< one plane is like all others
  about_c0,    ///< C and −C are alike
  about_c90,   ///< C and 180° − C are alike
  about_both,  ///< both
};

/// Puts a distribution together from the planes of a file: `planes_deg` with `columns` of candela for the vertical angles
/// that `lamp` has already. Type C: mirrored as told and closed to a full turn; types A and B: `about_c0` mirrors left
/// and right.
void set_planes(LightDistribution& lamp, LampSymmetry symmetry, const std::vector<double>& planes_deg,
                const std::vector<std::vector<double>>& columns);

}  // namespace laterna
