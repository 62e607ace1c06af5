#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "laterna/mirrors.h"

namespace laterna {
namespace {

constexpr double kGravity = 9.80665;  // m/s²

}  // namespace

double phase_at(const Wave& wave, double seconds) {
  const double speed = wave.speed.value_or(std::sqrt(kGravity * wave.length / (2 * kPi)));
  const double turns = speed * seconds / wave.length;
  const double phase = wave.phase - 2 * kPi * (turns - std::floor(turns));
  return phase < -kMaxWavePhase ? std::max(phase + 2 * kPi, -kMaxWavePhase) : phase;
}

}  // namespace laterna
