// The light of a batch of samples where projectors do more than add to it (Light::blend).
#pragma once

#include <memory>
#include <span>

#include "shade/blend_layers.h"
#include "shade/scatter.h"
#include "shadow/shadow_technique.h"

namespace laterna::shade {

/// Buffers of one worker. Lights are taken in their order: what each gives by itself is written to `change()`, then add()
/// or blend() makes of it the difference that it makes to the sum of those before.
class LightBlender {
 public:
  explicit LightBlender(InstructionSet set);

  /// A batch. `planes`: of an earlier pass, what is behind these samples: ambient light, and each of the lights before;
  /// empty: there are none.
  void start(const shadow::SurfaceSamples& samples, std::span<const ColorTarget> planes);

  [[nodiscard]] Radiance& change() { return *change_; }
  /// To be filled in for blend(): what the light would give with nothing before its lamp, all arriving.
  [[nodiscard]] Radiance& open() { return *open_; }
  [[nodiscard]] const shadow::Arrival& unhindered() const { return *unhindered_; }

  void add(std::size_t groups);
  void blend(BlendMode mode, std::size_t groups);

 private:
  BlendLight blend_light_;
  std::unique_ptr<Radiance> earlier_, change_, open_;
  std::unique_ptr<shadow::Arrival> unhindered_;
};

/// sum += part
void add(Radiance& sum, const Radiance& part, std::size_t groups);

}  // namespace laterna::shade
