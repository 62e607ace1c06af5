// What surfaces show of the light that was baked into them.
#pragma once

#include <memory>

#include "shade/light_map.h"
#include "shade/lobe_shader.h"

namespace laterna::shade {

/// Buffers of one worker.
class LightMapShader {
 public:
  /// Both outlive the shader.
  LightMapShader(const PointSource& source, const ReflectionSettings& settings, InstructionSet set);

  /// Adds it to `radiance`, for samples of one surface that has a light map. `lobes`: null, or started with these samples.
  void add(const frame::Surface& surface, const shadow::SurfaceSamples& samples, const SurfacePoints& points,
           const LobeShader* lobes, Radiance& radiance) const;

 private:
  const PointSource& source_;
  const ReflectionSettings& settings_;
  FindBakedIrradiance find_baked_irradiance_;
  ReflectBaked reflect_baked_;
  std::unique_ptr<BakedIrradiance> irradiance_;
};

}  // namespace laterna::shade
