#include "base/sample_sequence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace laterna {
namespace {

// Powers of the plastic number spread points over a square (Roberts, The unreasonable effectiveness of quasirandom
// sequences, 2018): fields by the one, what goes with them by the other.
constexpr double kPlasticStep = 0.75487766624669276, kPlasticStepSquared = 0.56984029099805327;

// Fractions of ∛39 and √11: of pairs of roots whose figure of merit is high, by itself and with the above (how far h₁ a + h₂ b
// is from whole numbers for small h), the one that fills squares most evenly at 4 to 1000 points.
constexpr double kPixelStepX = 0.39121144301416644, kPixelStepY = 0.31662479035539981;

// Fractions of √7: of roots, one that fills squares evenly with each of the above.
constexpr double kInstantStep = 0.64575131106459072;

double step_of(SampleDimension dimension) {
  switch (dimension) {
    case SampleDimension::pixel_x:
      return kPixelStepX;
    case SampleDimension::pixel_y:
      return kPixelStepY;
    case SampleDimension::instant:
      return kInstantStep;
    case SampleDimension::source:
      break;
  }
  return kPlasticStep;
}

}  // namespace

double sample_number(SampleIndex sample, SampleDimension dimension) {
  const double x = 0.5 + sample.index * step_of(dimension);
  return x - std::floor(x);
}

LatticePoint lattice_point(SampleIndex sample) {
  constexpr double kGoldenStep = 0.61803398874989485;
  const double turns = sample.index * kGoldenStep;
  return {(sample.index + 0.5) / sample.count, turns - std::floor(turns)};
}

int sample_field(SampleIndex sample) {
  int step = std::max(1, static_cast<int>(kPlasticStepSquared * sample.count));
  while (std::gcd(step, sample.count) != 1) ++step;
  return static_cast<int>(static_cast<std::int64_t>(sample.index) * step % sample.count);
}

}  // namespace laterna
