#include "laterna/turntable.h"

#include <cmath>

#include "base/elementary.h"

namespace laterna {

View turned_about(const View& view, const glm::dvec3& centre_ws, double turns) {
  const double part = turns - std::floor(turns);
  if (part == 0) return view;
  const double c = cosine(2 * kPi * part), s = sine(2 * kPi * part);
  const glm::dmat3 turn({c, 0, -s}, {0, 1, 0}, {s, 0, c});
  View turned = view;
  turned.pose.position_ws = centre_ws + turn * (view.pose.position_ws - centre_ws);
  turned.pose.world_from_view_rotation = turn * view.pose.world_from_view_rotation;
  return turned;
}

}  // namespace laterna
