// What an environment throws on matt surfaces.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "image/environment_map.h"
#include "laterna/scene.h"

namespace laterna::bake {

class EnvironmentIrradiance {
 public:
  /// `irradiance`: of the environment's picture.
  EnvironmentIrradiance(const Environment& environment, const image::HarmonicCoefficients& irradiance);

  /// On a surface of this unit normal, never less than 0, as far as nine spherical harmonics tell it apart: Ramamoorthi &
  /// Hanrahan 2001, An efficient representation for irradiance environment maps, equation 5.
  [[nodiscard]] glm::vec3 on(const glm::vec3& normal_ws) const;

 private:
  image::HarmonicCoefficients coefficients_;  // times the intensity
  glm::dmat3 environment_from_world_;
};

}  // namespace laterna::bake
