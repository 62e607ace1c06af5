#include "shade/lobe_shader.h"

namespace laterna::shade {

LobeShader::LobeShader(const PointSource& source, const LobeJob& job, InstructionSet set)
    : source_(source),
      job_(job),
      find_lobe_points_(find_lobe_points_for(set)),
      light_coat_(light_coat_for(set)),
      reflect_layered_(reflect_layered_for(set)),
      find_layered_ambient_(find_layered_ambient_for(set)),
      reflect_layered_baked_(reflect_layered_baked_for(set)),
      reflect_layered_environment_(reflect_layered_environment_for(set)),
      transmit_(transmit_for(set)) {}

void LobeShader::start(const frame::Surface& surface, const shadow::SurfaceSamples& samples,
                       const SurfacePoints& points) {
  find_lobe_points_(source_, surface, samples, points, lobe_points_);
  surface_ = {surface.lobes.get(), &points, &lobe_points_, job_.sheen};
  samples_ = &samples;
}

void LobeShader::find_ambient(const ReflectionSettings& settings, Radiance& radiance) const {
  find_layered_ambient_(settings, surface_, samples_->group_count, radiance);
  if (surface_.lobes->has_transmission && job_.behind != nullptr)
    transmit_(*job_.behind, *job_.split_sum, surface_, *samples_, radiance);
}

void LobeShader::widen(Irradiance& irradiance) const {
  if (surface_.lobes->has_clearcoat) light_coat_(*samples_, lobe_points_, irradiance);
}

void LobeShader::reflect(const Irradiance& irradiance, const shadow::Arrival& arrival, float fill, bool add,
                         Radiance& radiance) const {
  reflect_layered_(surface_, samples_->group_count, irradiance, arrival, fill, add, radiance);
}

void LobeShader::reflect_baked(const BakedIrradiance& irradiance, Radiance& radiance) const {
  reflect_layered_baked_(surface_, samples_->group_count, irradiance, radiance);
}

void LobeShader::reflect_environment(const EnvironmentLight& light, bool add, Radiance& radiance) const {
  reflect_layered_environment_(light, surface_, *samples_, add, radiance);
}

}  // namespace laterna::shade
