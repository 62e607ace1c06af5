#include "shade/fresnel.h"

#include <cmath>

namespace laterna::shade {

double fresnel_reflectance(double cosine, double ior) {
  // Snell: sin of the refracted ray is that of the arriving one, divided by the index.
  const double squared = 1 - (1 - cosine * cosine) / (ior * ior);
  if (squared < 0) return 1;  // total reflection
  const double refracted = std::sqrt(squared);
  if (cosine + refracted <= 0) return 0;  // grazing what is no boundary: ior 1
  const double s = (cosine - ior * refracted) / (cosine + ior * refracted);
  const double p = (refracted - ior * cosine) / (refracted + ior * cosine);
  return 0.5 * (s * s + p * p);
}

double schlick_weight(double cosine) {
  const double m = 1 - cosine, m2 = m * m;
  return m2 * m2 * m;
}

}  // namespace laterna::shade
