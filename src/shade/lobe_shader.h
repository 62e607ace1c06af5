// Shading of batches on surfaces that have lobes, beside what every batch goes through.
#pragma once

#include "shade/earlier_view.h"
#include "shade/environment_light.h"
#include "shade/layered_reflection.h"

namespace laterna::shade {

/// What it reads; what no surface of the scene needs is null.
struct LobeJob {
  const SplitSum* split_sum = nullptr;  ///< with transmission
  const SheenAlbedo* sheen = nullptr;   ///< with sheen
  const EarlierView* behind = nullptr;  ///< with transmission; null also while that view is drawn
};

/// Buffers of one worker.
class LobeShader {
 public:
  LobeShader(const PointSource& source, const LobeJob& job, InstructionSet set);

  /// All later calls are about these samples, whose points are known and whose surface has lobes, until the next.
  void start(const frame::Surface& surface, const shadow::SurfaceSamples& samples,
             const SurfacePoints& points);

  /// Ambient light, what is emitted, and what is seen through the surface, in place of `radiance`.
  void find_ambient(const ReflectionSettings& settings, Radiance& radiance) const;
  /// After find_irradiance(), before shadows are asked for.
  void widen(Irradiance& irradiance) const;
  /// As reflect().
  void reflect(const Irradiance& irradiance, const shadow::Arrival& arrival, float fill, bool add,
               Radiance& radiance) const;
  void reflect_baked(const BakedIrradiance& irradiance, Radiance& radiance) const;
  void reflect_environment(const EnvironmentLight& light, bool add, Radiance& radiance) const;

 private:
  PointSource source_;
  LobeJob job_;
  FindLobePoints find_lobe_points_;
  LightCoat light_coat_;
  ReflectLayered reflect_layered_;
  FindLayeredAmbient find_layered_ambient_;
  ReflectLayeredBaked reflect_layered_baked_;
  ReflectLayeredEnvironment reflect_layered_environment_;
  Transmit transmit_;
  LobePoints lobe_points_;
  LayeredSurface surface_;
  const shadow::SurfaceSamples* samples_ = nullptr;
};

}  // namespace laterna::shade
