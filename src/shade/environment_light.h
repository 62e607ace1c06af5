// Light from all around, at surface points and behind them.
#pragma once

#include <array>

#include "image/environment_map.h"
#include "laterna/scene.h"
#include "shade/illumination.h"
#include "shade/pixel_rays.h"
#include "shade/split_sum.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// An environment as kernels read it. The map and the table must outlive it.
struct EnvironmentLight {
  const image::OctahedralLevels* mirrored = nullptr;
  const SplitSum* split_sum = nullptr;
  float intensity = 1;
  float highlight_roughness = 0;  // of the phong model's highlight
  bool is_visible = true;
  /// What a white matt surface shows, Σ harmonic · coefficient: irradiance / π, times the intensity, by channel.
  float matt[3][9];
  float environment_from_world[3][3];  // rows
  EnvironmentDistance distance = EnvironmentDistance::infinite;
  float center_ws[3], box_low_ws[3], box_high_ws[3];
  float radius_squared = 1;

  EnvironmentLight(const Environment& environment, const image::EnvironmentMap& map,
                   const SplitSum& split_sum, const std::optional<PhongHighlight>& highlight);
};

/// What surfaces reflect of the environment: added to `radiance`, or in its place.
using ReflectEnvironment = void (*)(const EnvironmentLight& light, const ReflectionSettings& settings,
                                    const shadow::SurfaceSamples& samples, const SurfacePoints& points,
                                    bool add, Radiance& radiance);
ReflectEnvironment reflect_environment_for(InstructionSet set);

/// The environment itself along the rays of pixels (x, y) as RasterView counts them, 16 of each, aligned.
using ShowEnvironment = void (*)(const EnvironmentLight& light, const PixelRays& rays, const float* x,
                                 const float* y, float* r, float* g, float* b);
ShowEnvironment show_environment_for(InstructionSet set);

}  // namespace laterna::shade
