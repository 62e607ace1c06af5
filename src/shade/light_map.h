// Light that was baked, at surface points.
#pragma once

#include "shade/illumination.h"
#include "shade/surface_points.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// What a surface reflects of the irradiance that its light map holds, as a matt surface does: added to `radiance`. In the
/// model `pbr` what glTF's dielectric mirrors toward the light, f0, is missing, as it is where light comes along the view.
/// The surface has a light map, and `points` are those of `samples`.
using AddLightMap = void (*)(const PointSource& source, const ReflectionSettings& settings,
                             const frame::LightMapBinding& light_map, const shadow::SurfaceSamples& samples,
                             const SurfacePoints& points, Radiance& radiance);
AddLightMap add_light_map_for(InstructionSet set);

}  // namespace laterna::shade
