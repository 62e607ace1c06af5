#include "shade/light_map_shader.h"

namespace laterna::shade {

LightMapShader::LightMapShader(const PointSource& source, const ReflectionSettings& settings,
                               InstructionSet set)
    : source_(source),
      settings_(settings),
      find_baked_irradiance_(find_baked_irradiance_for(set)),
      reflect_baked_(reflect_baked_for(set)),
      irradiance_(std::make_unique<BakedIrradiance>()) {}

void LightMapShader::add(const frame::Surface& surface, const shadow::SurfaceSamples& samples,
                         const SurfacePoints& points, const LobeShader* lobes, Radiance& radiance) const {
  find_baked_irradiance_(source_, surface, samples, *irradiance_);
  if (lobes != nullptr) return lobes->reflect_baked(*irradiance_, radiance);
  reflect_baked_(settings_, samples.group_count, points, *irradiance_, radiance);
}

}  // namespace laterna::shade
