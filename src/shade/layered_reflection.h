// Light at surfaces that have lobes beyond metallic-roughness: what reflect(), find_ambient() and reflect_environment() are
// for plain ones. docs/materials.md
#pragma once

#include "shade/earlier_view.h"
#include "shade/environment_light.h"
#include "shade/illumination.h"
#include "shade/light_map.h"
#include "shade/lobe_points.h"
#include "shade/sheen_albedo.h"

namespace laterna::shade {

/// A batch of samples on one surface that has lobes. `sheen`: of surfaces with sheen.
struct LayeredSurface {
  const frame::SurfaceLobes* lobes = nullptr;
  const SurfacePoints* points = nullptr;
  const LobePoints* lobe_points = nullptr;
  const SheenAlbedo* sheen = nullptr;
};

/// Also lights samples that the coat faces, though what lies beneath it does not.
using LightCoat = void (*)(const shadow::SurfaceSamples& samples, const LobePoints& lobes,
                           Irradiance& irradiance);
LightCoat light_coat_for(InstructionSet set);

using ReflectLayered = void (*)(const LayeredSurface& surface, std::size_t groups,
                                const Irradiance& irradiance, const shadow::Arrival& arrival, float fill,
                                bool add, Radiance& radiance);
ReflectLayered reflect_layered_for(InstructionSet set);

/// What of baked irradiance is scattered back: added to `radiance`. As reflect_baked() of a plain surface, so that what the
/// facets mirror of light along the view is missing; sheen and coat take what they take at the angle of sight.
using ReflectLayeredBaked = void (*)(const LayeredSurface& surface, std::size_t groups,
                                     const BakedIrradiance& irradiance, Radiance& radiance);
ReflectLayeredBaked reflect_layered_baked_for(InstructionSet set);

/// In place of `radiance`: ambient light that is scattered back, and what the surface emits through its coat.
using FindLayeredAmbient = void (*)(const ReflectionSettings& settings, const LayeredSurface& surface,
                                    std::size_t groups, Radiance& radiance);
FindLayeredAmbient find_layered_ambient_for(InstructionSet set);

using ReflectLayeredEnvironment = void (*)(const EnvironmentLight& light, const LayeredSurface& surface,
                                           const shadow::SurfaceSamples& samples, bool add,
                                           Radiance& radiance);
ReflectLayeredEnvironment reflect_layered_environment_for(InstructionSet set);

/// Adds what is seen through the surface.
using Transmit = void (*)(const EarlierView& behind, const SplitSum& split_sum, const LayeredSurface& surface,
                          const shadow::SurfaceSamples& samples, Radiance& radiance);
Transmit transmit_for(InstructionSet set);

}  // namespace laterna::shade
