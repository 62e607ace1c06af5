#include "reference/soft_truth.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "reference/picture_probes.h"
#include "reference/shapes.h"

namespace laterna::reference {
namespace {

// Numbers spread evenly over the unit cube: Roberts' steps in three dimensions.
glm::dvec3 even(int k) {
  constexpr double kStep = 1.22074408460575947536;
  const auto place = [k](double step) {
    const double turns = 0.5 + step * (k + 1);
    return turns - std::floor(turns);
  };
  return {place(1 / kStep), place(1 / (kStep * kStep)), place(1 / (kStep * kStep * kStep))};
}

// A point of a unit disc.
glm::dvec2 in_disc(const glm::dvec3& random) {
  const double radius = std::sqrt(random.x);
  const double angle = 6.283185307179586 * random.y;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

// A point of a unit ball so crowded toward its surface that from every side the ball looks like an even disc.
glm::dvec3 in_ball(const glm::dvec3& random) {
  const double z = 2 * random.x - 1;
  const double angle = 6.283185307179586 * random.y;
  // The radius is sin t, with density sin² t over a quarter turn.
  double low = 0;
  double high = 1.5707963267948966;
  for (int i = 0; i < 50; ++i) {
    const double t = 0.5 * (low + high);
    const double share = (t - 0.5 * std::sin(2 * t)) / 1.5707963267948966;
    (share < random.z ? low : high) = t;
  }
  const double around = std::sqrt(1 - z * z);
  return std::sin(low) * glm::dvec3(around * std::cos(angle), around * std::sin(angle), z);
}

// Moves a light's node to a point of its source.
void move(glm::dmat4& m, const Light& light, const glm::dvec3& random) {
  const LightSource& source = light.source;
  const glm::dvec3 right(m[0]);
  const glm::dvec3 up(m[1]);
  if (light.type == LightType::directional) {
    const double reach = std::tan(0.5 * source.angular_diameter.in_radians());
    const glm::dvec2 p = reach * in_disc(random);
    const glm::dvec3 back = glm::normalize(glm::dvec3(m[2]) + p.x * right + p.y * up);
    const glm::dvec3 turned_right = glm::normalize(glm::cross(up, back));
    m[0] = glm::dvec4(turned_right, 0);
    m[1] = glm::dvec4(glm::cross(back, turned_right), 0);
    m[2] = glm::dvec4(back, 0);
  } else if (source.radius > 0) {
    m[3] += glm::dvec4(source.radius * in_ball(random), 0);
  } else {
    m[3] += glm::dvec4((random.x - 0.5) * source.width * right + (random.y - 0.5) * source.height * up, 0);
  }
}

}  // namespace

std::vector<float> soft_truth(const Scene& scene, const View& camera, const RenderSettings& settings,
                              const std::string& name, int points) {
  const int node = find_light_node(scene, name);
  const Light& light =
      scene.lights[static_cast<std::size_t>(scene.nodes[static_cast<std::size_t>(node)].light)];
  Renderer renderer = make_renderer(scene);
  RenderSettings hard = settings;
  hard.shadows = ShadowTechnique::raytraced;
  hard.layers = {Layer::visibility};
  std::vector<double> sum(static_cast<std::size_t>(settings.width) *
                          static_cast<std::size_t>(settings.height));
  for (int k = 0; k < points; ++k) {
    glm::dmat4 place = scene.nodes[static_cast<std::size_t>(node)].parent_from_node;
    move(place, light, even(k));
    if (!renderer.set_transform(node, place)) throw std::runtime_error("the light cannot be moved");
    const LayeredImage image = render(renderer, camera, hard);
    const std::span<const float> alpha = values_of(image, "visibility." + name);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += alpha[i];
  }
  std::vector<float> mean;
  for (const double value : sum) mean.push_back(static_cast<float>(value / points));
  return mean;
}

}  // namespace laterna::reference
