#include "studio.h"

#include <algorithm>
#include <cmath>

#include "laterna/environment.h"

namespace laterna::app {

Image sky_of(const std::function<glm::vec3(const glm::dvec3&)>& radiance) {
  Image sky(2 * kSkyHeight, kSkyHeight, 3, PixelType::f32, Transfer::linear);
  const auto values = sky.values<float>();
  std::size_t next = 0;
  for (int y = 0; y < kSkyHeight; ++y) {
    for (int x = 0; x < 2 * kSkyHeight; ++x) {
      const glm::dvec2 position((x + 0.5) / (2 * kSkyHeight), (y + 0.5) / kSkyHeight);
      const glm::vec3 colour = radiance(*direction_from_image(EnvironmentChart::latlong, position));
      for (int k = 0; k < 3; ++k) values[next++] = colour[k];
    }
  }
  return sky;
}

glm::vec3 studio(const glm::dvec3& d) {
  const double t = 1 / std::max(std::abs(d.x), std::max(std::abs(d.y), std::abs(d.z)));
  const glm::dvec3 wall = d * t;
  const auto within = [](double value, double from, double to) { return value > from && value < to; };
  if (wall.y <= -0.999) return glm::vec3((static_cast<int>((wall.x + 1) * 6) & 1) != 0 ? 0.10F : 0.16F);
  if (wall.y >= 0.999)
    return within(wall.x, -0.4, 0.4) && within(wall.z, -0.4, 0.4) ? glm::vec3(5) : glm::vec3(0.35F);
  if (wall.x <= -0.999 && within(wall.y, -0.1, 0.7) && within(wall.z, -0.6, 0.5))
    return within(wall.z, -0.08, -0.02) || within(wall.y, 0.27, 0.33) ? glm::vec3(0.1F)
                                                                      : glm::vec3(6, 6.5F, 7);
  if (wall.x >= 0.999 && within(wall.z, -0.6, -0.4)) return {4, 0.4F, 0.3F};
  if (wall.x >= 0.999 && within(wall.z, -0.2, 0.0)) return {0.3F, 0.5F, 4};
  return glm::vec3(0.30F) + 0.08F * glm::vec3(wall);
}

}  // namespace laterna::app
