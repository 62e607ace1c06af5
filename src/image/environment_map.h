// An environment made ready to light surfaces: as mirrors of every roughness show it, and what falls on matt ones.
#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "base/task_pool.h"
#include "image/environment_picture.h"
#include "image/octahedral_levels.h"
#include "image/prefilter.h"

namespace laterna::image {

/// Coefficients of the nine spherical harmonics of order up to 2, in the order and with the signs of Ramamoorthi &
/// Hanrahan 2001: L₀₀, L₁₋₁, L₁₀, L₁₁, L₂₋₂, L₂₋₁, L₂₀, L₂₁, L₂₂.
using HarmonicCoefficients = std::array<glm::dvec3, 9>;

/// Of a unit direction.
std::array<double, 9> spherical_harmonics(const glm::dvec3& direction);

struct EnvironmentMap {
  /// Level k is what surfaces of roughness k / (count − 1) mirror: the mean of radiance over the lobe of GGX, seen along
  /// the normal (N = V = R: Karis 2013, Real shading in Unreal Engine 4), by the reflected direction. Level 0 is the
  /// environment itself.
  OctahedralLevels mirrored;
  /// Irradiance: Σ coefficient · harmonic of the normal.
  HarmonicCoefficients irradiance{};
};

/// Roughness 0, 1/12, … 1.
inline constexpr std::size_t kMirrorLevels = 13;
/// Largest side of level 0.
inline constexpr int kLargestMirrorSide = 2048;
/// What the side of level 0 is for a source of so many texels.
int mirror_side(double texels);

/// Fractions done, from one thread at a time.
using FractionDone = std::function<void(double)>;

EnvironmentMap make_environment_map(const EnvironmentPicture& picture, const TaskPool& pool,
                                    InstructionSet set, const FractionDone& progress);
/// From pictures that are filtered already, for roughness 0 … 1 in equal steps.
EnvironmentMap make_environment_map(const std::vector<EnvironmentPicture>& filtered, const TaskPool& pool);

/// A_l L_lm of radiance in the octahedral chart.
HarmonicCoefficients find_irradiance(const OctahedralLevels& radiance);

/// Directions of GGX's lobe of a roughness about +Z with N = V = R, and what level of a pyramid of this many texels each
/// is read from so that its share of the lobe is averaged (Křivánek & Colbert 2008, Real-time shading with filtered
/// importance sampling). roughness in (0, 1].
std::vector<LobeSample> sample_lobe(double roughness, int count, int pyramid_side);

}  // namespace laterna::image
