#include "shade/environment_light.h"

#include "base/elementary.h"

namespace laterna::shade {

EnvironmentLight::EnvironmentLight(const Environment& environment, const image::EnvironmentMap& map,
                                   const SplitSum& table, const std::optional<PhongHighlight>& highlight)
    : mirrored(&map.mirrored),
      split_sum(&table),
      intensity(static_cast<float>(environment.intensity)),
      is_visible(environment.visible),
      distance(environment.distance),
      radius_squared(static_cast<float>(environment.radius * environment.radius)) {
  const image::HarmonicCoefficients& irradiance =
      environment.irradiance ? *environment.irradiance : map.irradiance;
  for (int channel = 0; channel < 3; ++channel) {
    for (std::size_t i = 0; i < 9; ++i)
      matt[channel][i] = static_cast<float>(irradiance[i][channel] * environment.intensity / kPi);
  }
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      // The inverse of a rotation is its transpose; glm's columns come first.
      environment_from_world[row][column] =
          static_cast<float>(environment.world_from_environment[row][column]);
    }
    center_ws[row] = static_cast<float>(environment.center_ws[row]);
    box_low_ws[row] = static_cast<float>(environment.box_low_ws[row]);
    box_high_ws[row] = static_cast<float>(environment.box_high_ws[row]);
  }
  // The width of Blinn's lobe, shininess = 2/α² − 2, as everywhere in the phong model.
  if (highlight) highlight_roughness = static_cast<float>(power(2 / (highlight->shininess + 2.0), 0.25));
}

}  // namespace laterna::shade
