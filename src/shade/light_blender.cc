#include "shade/light_blender.h"

namespace laterna::shade {

using shadow::kGroupSize;

void add(Radiance& sum, const Radiance& part, std::size_t groups) {
  for (std::size_t i = 0; i < groups * kGroupSize; ++i) {
    sum.r[i] += part.r[i];
    sum.g[i] += part.g[i];
    sum.b[i] += part.b[i];
  }
}

LightBlender::LightBlender(InstructionSet set)
    : blend_light_(blend_light_for(set)),
      earlier_(std::make_unique<Radiance>()),
      change_(std::make_unique<Radiance>()),
      open_(std::make_unique<Radiance>()),
      unhindered_(std::make_unique<shadow::Arrival>()) {
  unhindered_->alpha.fill(1);
}

// In the lights' order, so that the sum is the one that a single pass has come to.
void LightBlender::start(const shadow::SurfaceSamples& samples, std::span<const ColorTarget> planes) {
  for (shadow::SampleArray<float>* values : {&earlier_->r, &earlier_->g, &earlier_->b}) values->fill(0);
  for (std::size_t plane = 1; plane < planes.size(); ++plane) {
    for_each_sample(samples, samples.active, [&](std::size_t i) {
      const std::uint32_t pixel = samples.pixel[i];
      earlier_->r[i] += planes[plane].r[pixel];
      earlier_->g[i] += planes[plane].g[pixel];
      earlier_->b[i] += planes[plane].b[pixel];
    });
  }
}

void LightBlender::add(std::size_t groups) { shade::add(*earlier_, *change_, groups); }

void LightBlender::blend(BlendMode mode, std::size_t groups) {
  blend_light_(mode, groups, *open_, *change_, *earlier_, *change_);
}

}  // namespace laterna::shade
