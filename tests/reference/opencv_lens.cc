#include "reference/opencv_lens.h"

#include <cmath>

namespace laterna::reference {

glm::dvec2 project(const OpenCvLens& lens, glm::dvec2 ideal) {
  const double x = ideal.x, y = ideal.y;
  const double r2 = x * x + y * y, r4 = std::pow(r2, 2), r6 = std::pow(r2, 3);
  const double a1 = 2 * x * y, a2 = r2 + 2 * x * x, a3 = r2 + 2 * y * y;
  const double cdist = 1 + lens.k1 * r2 + lens.k2 * r4 + lens.k3 * r6;
  return {x * cdist + lens.p1 * a1 + lens.p2 * a2, y * cdist + lens.p1 * a3 + lens.p2 * a1};
}

glm::dvec2 unproject(const OpenCvLens& lens, glm::dvec2 seen) {
  glm::dvec2 ideal = seen;
  for (int i = 0; i < 500; ++i) {
    const double x = ideal.x, y = ideal.y, r2 = x * x + y * y;
    const double icdist = 1 / (1 + ((lens.k3 * r2 + lens.k2) * r2 + lens.k1) * r2);
    const double delta_x = 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x);
    const double delta_y = lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y;
    ideal = {(seen.x - delta_x) * icdist, (seen.y - delta_y) * icdist};
  }
  return ideal;
}

}  // namespace laterna::reference
