#include "scene/lamp_planes.h"

#include <algorithm>
#include <cmath>

namespace laterna {
namespace {

struct Plane {
  double angle_deg;
  std::size_t column;
};

double within_turn(double angle_deg) {
  const double rest = std::fmod(angle_deg, 360.0);
  return rest < 0 ? rest + 360 : rest;
}

void mirror(std::vector<Plane>& planes, double twice_the_axis_deg) {
  for (std::size_t i = 0, count = planes.size(); i < count; ++i)
    planes.push_back({twice_the_axis_deg - planes[i].angle_deg, planes[i].column});
}

// In order, each angle once: of a plane and its mirror image in the same place, the plane.
void sort_planes(std::vector<Plane>& planes) {
  std::stable_sort(planes.begin(), planes.end(),
                   [](const Plane& a, const Plane& b) { return a.angle_deg < b.angle_deg; });
  const auto is_same = [](const Plane& a, const Plane& b) {
    return b.angle_deg - a.angle_deg < 0.5 * kLeastLampStep;
  };
  planes.erase(std::unique(planes.begin(), planes.end(), is_same), planes.end());
}

void close_turn(std::vector<Plane>& planes) {
  for (Plane& plane : planes) plane.angle_deg = within_turn(plane.angle_deg);
  sort_planes(planes);
  // 359.9999 is 0 as well.
  if (planes.size() > 1 && planes.back().angle_deg - 360 > planes.front().angle_deg - 0.5 * kLeastLampStep)
    planes.pop_back();
  const Plane first = planes.front(), last = planes.back();
  planes.push_back({first.angle_deg + 360, first.column});
  if (first.angle_deg > 0) planes.insert(planes.begin(), {last.angle_deg - 360, last.column});
}

}  // namespace

void set_planes(LightDistribution& lamp, LampSymmetry symmetry, const std::vector<double>& planes_deg,
                const std::vector<std::vector<double>>& columns) {
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < planes_deg.size(); ++i) planes.push_back({planes_deg[i], i});
  if (symmetry == LampSymmetry::full_turn) planes = {{0, 0}};
  if (symmetry == LampSymmetry::about_c90 || symmetry == LampSymmetry::about_both) mirror(planes, 180);
  if (symmetry == LampSymmetry::about_c0 || symmetry == LampSymmetry::about_both) mirror(planes, 0);
  if (lamp.type == PhotometricType::type_c) {
    close_turn(planes);
  } else {
    sort_planes(planes);
  }
  lamp.horizontal_deg.clear();
  lamp.candela.clear();
  lamp.candela.reserve(planes.size() * lamp.vertical_deg.size());
  for (const Plane& plane : planes) {
    lamp.horizontal_deg.push_back(plane.angle_deg);
    lamp.candela.insert(lamp.candela.end(), columns[plane.column].begin(), columns[plane.column].end());
  }
}

}  // namespace laterna
