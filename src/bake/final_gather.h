// The last bounce, which goes to each luxel: blocks of patches cannot be seen then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "bake/bright_luxels.h"
#include "bake/light_sharing.h"
#include "bake/luxel_patches.h"
#include "bake/luxel_rays.h"
#include "bake/luxel_tree.h"
#include "bake/part_files.h"
#include "bake/part_work.h"

namespace laterna::bake {

/// What luxels send out: by place what they give off before any bounce, and by patch what falls on them by bounces.
struct SentLight {
  std::span<const glm::vec3> exitance;
  std::span<const glm::vec3> patch_irradiance;
};

/// Every luxel sends out few rays. What its neighbours find counts for it as well, as far as they share (light_sharing); where these are
/// few, in corners and on small things, it sends out more, so that `rays` or more stand behind each luxel.
///
/// How far luxels share, and so how many rays each sends out, is found by rays of their own, whose light does not count: would a luxel
/// that met something near by chance keep its light to itself, while those that missed it share what they have, light would be lost.
class FinalGather {
 public:
  /// All must outlive this.
  FinalGather(const LuxelTree& tree, const LuxelRays& look, const BrightLuxels& bright,
              const Patches& patches, SentLight light, int rays);

  /// Steps of progress of irradiance().
  [[nodiscard]] static std::size_t steps(std::size_t luxels);
  /// By place; of no use where work has been cancelled.
  [[nodiscard]] std::vector<glm::vec3> irradiance(const PartWork& work, const PartFiles& files);

 private:
  // What a luxel's own rays have found.
  struct Found {
    glm::vec3 irradiance{0};
    // 1 / m, of what bright luxels bring: where most light comes from what is near, it changes within a part of that distance.
    // They are sums, and hardly know luck: it is in the whole alone that they are held against.
    float nearness = 0;
  };

  // The mean of 1 / distance, 1 / m.
  [[nodiscard]] float probe(std::uint32_t place) const;
  [[nodiscard]] Found gather(std::uint32_t place, int rays, LuxelRays::Scratch& scratch) const;
  [[nodiscard]] std::vector<float> count_rays(const PartWork& work, const LightSharing& sharing) const;
  // Calls use(place of another luxel, its part in what is found for this one).
  template <class Use>
  void for_parts(std::uint32_t place, const LightSharing& sharing, std::span<const float> all, Use use) const;
  [[nodiscard]] int rays_at(std::uint32_t place, const LightSharing& sharing,
                            std::span<const float> all) const;
  void find(const PartWork& work, const PartFiles& files);
  void share(const PartWork& work, const LightSharing& sharing, std::vector<glm::vec3>& shared) const;

  const LuxelTree& tree_;
  const LuxelRays& look_;
  const BrightLuxels& bright_;
  const Patches& patches_;
  SentLight light_;
  int rays_, probes_, fewest_rays_;
  // By place.
  std::vector<float> nearness_;
  std::vector<Found> found_;
};

}  // namespace laterna::bake
