#include "shade/cone_rays.h"

#include <cmath>
#include <cstddef>

#include "base/elementary.h"

namespace laterna::shade {

ConeRays cone_rays(SampleIndex sample) {
  constexpr double kGoldenAngle = 2.39996322972865332;
  const double share = sample_number(sample, SampleDimension::source);
  const double turn = 2 * kPi * (sample_number(sample, SampleDimension::instant) - 0.5);
  ConeRays rays;
  for (int i = 0; i < kConeRays; ++i) {
    const double radius = std::sqrt((i + share) / kConeRays), angle = kGoldenAngle * i + turn;
    rays[static_cast<std::size_t>(i)] = glm::vec2(radius * cosine(angle), radius * sine(angle));
  }
  return rays;
}

}  // namespace laterna::shade
