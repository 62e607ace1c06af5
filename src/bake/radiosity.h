// Diffuse interreflection between luxels: the radiosity equation B = M + ρ E(B), after Goral, Torrance, Greenberg and
// Battaile, Modeling the interaction of light between diffuse surfaces, 1984. docs/radiosity.md says how it is solved.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "bake/luxel.h"
#include "bake/part_files.h"
#include "base/task_pool.h"
#include "frame/frame.h"
#include "laterna/radiosity.h"
#include "laterna/render.h"
#include "laterna/result.h"
#include "trace/ray_scene.h"

namespace laterna::bake {

/// What surfaces are given before any interreflection, one entry per luxel, channel by channel and linear.
struct LightSources {
  /// What lights throw on a luxel: lux in photometric scenes.
  std::span<const glm::vec3> direct_irradiance;
  /// What it gives off by itself (π times the radiance of an emissive material), in the same unit. Empty: nothing shines.
  std::span<const glm::vec3> exitance = {};
};

struct Interreflection {
  /// Per luxel: the irradiance from all that surfaces give off and reflect, without direct_irradiance.
  std::vector<glm::vec3> irradiance;
  int bounces = 0;              ///< that were worked out
  std::size_t patch_count = 0;  ///< groups of luxels between which the bounces were worked out
};

/// Luxels reflect onto each other what falls on them: ρ (E_direct + E_indirect) + exitance. Rays meet what casts shadows,
/// and what they meet gives off what the luxels near by on that side of it do; a side without luxels within reach is black,
/// and so is what lies beyond the scene. Blended surfaces tint what comes through (shadow/panes) and reflect nothing.
/// `rays` is made of `frame`. `parts`: what is worked out is kept in files as it comes, and taken from there. The result depends on neither threads nor instruction set.
/// Error: bad_usage for settings out of range and spans of differing lengths, bad_input with the luxel's number for luxels
/// and light that are not finite or out of range, cancelled.
Result<Interreflection> interreflect(const frame::Frame& frame, const trace::RayScene& rays,
                                     std::span<const Luxel> luxels, const LightSources& sources,
                                     const RadiositySettings& settings, const TaskPool& pool,
                                     const Progress& progress = {},
                                     const PartFiles& parts = PartFiles::none());

}  // namespace laterna::bake
