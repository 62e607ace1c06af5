// Light that was baked, at surface points.
#pragma once

#include "shade/illumination.h"
#include "shade/surface_points.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// Irradiance that light maps hold, in lux, by channel.
struct BakedIrradiance {
  shadow::SampleArray<float> r, g, b;
};

/// At the points of a surface that has a light map.
using FindBakedIrradiance = void (*)(const PointSource& source, const frame::Surface& surface,
                                     const shadow::SurfaceSamples& samples, BakedIrradiance& irradiance);
FindBakedIrradiance find_baked_irradiance_for(InstructionSet set);

/// What a matt surface reflects of irradiance from all around: added to `radiance`. In the model `pbr` what glTF's
/// dielectric mirrors toward the light, f0, is missing, as it is where light comes along the view.
using ReflectBaked = void (*)(const ReflectionSettings& settings, std::size_t groups,
                              const SurfacePoints& points, const BakedIrradiance& irradiance,
                              Radiance& radiance);
ReflectBaked reflect_baked_for(InstructionSet set);

}  // namespace laterna::shade
