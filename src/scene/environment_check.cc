#include "scene/environment_check.h"

#include <cmath>

#include "scene/scene_check.h"

namespace laterna {
namespace {

class EnvironmentCheck : SceneCheck {
 public:
  EnvironmentCheck(const Scene& scene, FaultList& faults) : SceneCheck(scene, faults) {}

  void run() { check_whole_scene(); }

 private:
  void check_environment(const Environment& environment);
  void check_environment_picture(const std::string& place, int picture, bool is_needed);
  void check_whole_scene();
};

void EnvironmentCheck::check_environment(const Environment& environment) {
  const std::string place = "environment";
  const bool has_picture = environment.picture >= 0;
  if (has_picture == !environment.specular_pictures.empty())
    fault(place, "expected either a picture or specular_pictures");
  check_environment_picture(place + ".picture", environment.picture, has_picture);
  for (std::size_t i = 0; i < environment.specular_pictures.size(); ++i) {
    for (const int face : environment.specular_pictures[i])
      check_environment_picture(item(place + ".specular_pictures", i), face, true);
  }
  if (environment.chart) check_enumerator(place + ".chart", *environment.chart, EnvironmentChart::octahedral);
  check_enumerator(place + ".distance", environment.distance, EnvironmentDistance::sphere);
  check_number(place + ".intensity", environment.intensity, 0, kMaxRadiance);
  if (environment.irradiance) {
    for (std::size_t i = 0; i < 9; ++i) {
      for (int k = 0; k < 3; ++k)
        check_number(item(place + ".irradiance", i), (*environment.irradiance)[i][k], -kMaxRadiance,
                     kMaxRadiance);
    }
  }
  const glm::dmat3& rotation = environment.world_from_environment;
  const glm::dmat3 product = glm::transpose(rotation) * rotation;
  constexpr double kTolerance = 1e-6;
  bool is_rotation = glm::determinant(rotation) > 0;
  for (int i = 0; i < 9; ++i) {
    const double off = product[i / 3][i % 3] - (i / 3 == i % 3 ? 1 : 0);
    is_rotation = is_rotation && std::abs(off) <= kTolerance;
  }
  if (!is_rotation) fault(place + ".world_from_environment", "its columns are no right-handed rotation");
  for (int k = 0; k < 3; ++k) {
    const double low = environment.box_low_ws[k], high = environment.box_high_ws[k];
    check_number(place + ".center_ws", environment.center_ws[k], -kMaxCoordinate, kMaxCoordinate);
    check_number(place + ".box_low_ws", low, -kMaxCoordinate, kMaxCoordinate);
    check_number(place + ".box_high_ws", high, -kMaxCoordinate, kMaxCoordinate);
    if (environment.distance == EnvironmentDistance::box && !(low < high))
      fault(place + ".box_high_ws", "expected corners greater than those of box_low_ws");
  }
  check_number(place + ".radius", environment.radius, 0, kMaxCoordinate);
}

void EnvironmentCheck::check_environment_picture(const std::string& place, int picture, bool is_needed) {
  check_reference(place, picture, scene_.pictures.size(), "pictures");
  const bool is_there = picture >= 0 && static_cast<std::size_t>(picture) < scene_.pictures.size();
  if (is_needed && picture == -1) fault(place, "expected a picture");
  if (is_there && scene_.pictures[static_cast<std::size_t>(picture)].film)
    fault(place, "an environment cannot be a film");
}

void EnvironmentCheck::check_whole_scene() {
  if (scene_.environment) check_environment(*scene_.environment);
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  check_color("ambient", scene_.ambient, kMaxRadiance);
  if (scene_.background) check_color("background", *scene_.background, kMaxRadiance);
  if (!scene_.phong) return;
  check_number("phong.specular", scene_.phong->specular, 0, kEndless);
  check_number("phong.shininess", scene_.phong->shininess, 0, kEndless);
}

}  // namespace

void check_surroundings(const Scene& scene, FaultList& faults) { EnvironmentCheck(scene, faults).run(); }

}  // namespace laterna
