// Flat mirrors and water: surfaces that show the scene as its mirrored image. docs/mirrors.md
#pragma once

#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace laterna {

/// One train of waves on water: its surface rises by amplitude · sin(2π (d · x / length − speed t / length) + phase), d the
/// unit direction within the surface, x the place in world space and t the scene time.
struct Wave {
  glm::dvec3 direction_ws{1, 0, 0};            ///< not zero; what of it lies within the surface counts
  double length = 1;                           ///< metres from crest to crest, kShortestWave …
  double amplitude = 0.01;                     ///< metres, not negative
  std::optional<double> speed = std::nullopt;  ///< metres per second; unset: √(g length / 2π), of deep water
  double phase = 0;                            ///< radians, ±kMaxWavePhase
};
/// Radians, within ±kMaxWavePhase: the phase that such a wave would have at time 0 to be there as this one is at `seconds`. With
/// speed 0 it is the wave's own, whatever the time.
double phase_at(const Wave& wave, double seconds);

/// What fills the space behind a mirror's front that is seen through: water. Light takes on its colour with the distance that
/// it goes there: attenuation_color^(distance / attenuation_distance), Beer and Lambert as KHR_materials_volume has it.
struct MirrorVolume {
  glm::vec3 attenuation_color{1};  ///< 0 … 1
  float attenuation_distance =
      std::numeric_limits<float>::infinity();  ///< metres, kLeastAttenuationDistance …
};

/// What makes a material a mirror. Every surface of it must be flat (kMirrorFlatness). The share F of what it mirrors is laid
/// over the surface: radiance = (1 − F) · surface + F · mirrored.
struct Mirror {
  /// F looking straight at it, 0 … 1, which grows as Schlick 1994 has it; with `ior`, a factor on what Fresnel's
  /// equations give.
  glm::vec3 reflectance{1};
  std::optional<float> ior;  ///< index of refraction, 1 … kMaxMirrorIor: water 1.333, glass 1.5
  /// 0 … 1, as that of materials: the image is blurred, the more the farther it is from the mirror.
  float roughness = 0;
  std::vector<Wave> waves;  ///< at most kMaxWaves
  /// Set: what lies behind is seen refracted, by `ior`, which must be set; so must the material's alpha mode, to blend.
  std::optional<MirrorVolume> volume;
  std::string file, place;  ///< where it is written, for messages; empty where it was made in code
};

inline constexpr float kMaxMirrorIor = 100;
inline constexpr std::size_t kMaxWaves = 64;
inline constexpr double kMaxWavePhase = 628.31853071795865;  ///< radians: a hundred turns
inline constexpr double kShortestWave = 1e-6;                ///< metres
inline constexpr double kLeastAttenuationDistance = 1e-6;    ///< metres
/// How far vertices may lie off the plane of a mirror, as a fraction of its longest side.
inline constexpr double kMirrorFlatness = 1e-3;
/// Most mirrors that a ray may meet one after the other (RenderSettings::mirror_depth).
inline constexpr int kMaxMirrorDepth = 8;
/// Mirrored and refracted pictures that one picture draws at most; beyond, the deepest are left out.
inline constexpr std::size_t kMaxMirrorPictures = 256;

}  // namespace laterna
