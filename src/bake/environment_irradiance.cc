#include "bake/environment_irradiance.h"

#include <array>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace laterna::bake {

EnvironmentIrradiance::EnvironmentIrradiance(const Environment& environment,
                                             const image::HarmonicCoefficients& irradiance)
    : coefficients_(irradiance), environment_from_world_(glm::transpose(environment.world_from_environment)) {
  for (glm::dvec3& coefficient : coefficients_) coefficient *= environment.intensity;
}

glm::vec3 EnvironmentIrradiance::on(const glm::vec3& normal_ws) const {
  const std::array<double, 9> harmonics =
      image::spherical_harmonics(environment_from_world_ * glm::dvec3(normal_ws));
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < harmonics.size(); ++i) sum += coefficients_[i] * harmonics[i];
  return glm::max(glm::vec3(sum), 0.0F);
}

}  // namespace laterna::bake
