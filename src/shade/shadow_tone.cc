#include "shade/shadow_tone.h"

namespace laterna::shade {

using shadow::Arrival;
using shadow::kGroupSize;
using shadow::SampleArray;

ShadowTone::ShadowTone(const ShadowSettings& settings)
    : fill_(settings.fill), is_physical_(settings.opacity == 1 && settings.ambient == 0) {
  // 1 − opacity (1 − color) (1 − a), with a = ambient + (1 − ambient) α, is affine in α: what it is at α = 0 says it all.
  for (int i = 0; i < 3; ++i) {
    darkest_[static_cast<std::size_t>(i)] =
        1 - settings.opacity * (1 - settings.color[i]) * (1 - settings.ambient);
    is_physical_ = is_physical_ && settings.color[i] == 0;
  }
}

void ShadowTone::apply(const Arrival& arriving, std::size_t groups, Arrival& seen) const {
  const SampleArray<float>* from[] = {&arriving.alpha, &arriving.alpha, &arriving.alpha};
  if (arriving.is_tinted) {
    from[0] = &arriving.r;
    from[1] = &arriving.g;
    from[2] = &arriving.b;
  }
  SampleArray<float>* to[] = {&seen.r, &seen.g, &seen.b};
  seen.is_tinted = true;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const float darkest = darkest_[channel];
    for (std::size_t i = 0; i < groups * kGroupSize; ++i) {
      (*to[channel])[i] = darkest + (1 - darkest) * (*from[channel])[i];
    }
  }
}

}  // namespace laterna::shade
