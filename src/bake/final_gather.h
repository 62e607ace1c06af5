// The last bounce, which goes to each luxel: blocks of patches cannot be seen then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
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

/// Every luxel sends out few rays. What its neighbours have found counts for it as well, as far as they share (light_sharing); where
/// these are few, in corners and on small things, more rays are sent, so that `rays` of them or more stand behind each luxel; but for those whose first
/// rays, and those of the luxels beside them, have found no light at all.
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
    float nearness = 0;  // mean of 1 / distance, 1 / m
  };

  [[nodiscard]] Found gather(std::uint32_t place, int rays, LuxelRays::Scratch& scratch) const;
  [[nodiscard]] std::vector<bool> find_dark() const;
  void find(const PartWork& work, const PartFiles& files);

  const LuxelTree& tree_;
  const LuxelRays& look_;
  const BrightLuxels& bright_;
  const Patches& patches_;
  SentLight light_;
  int rays_, first_rays_;
  std::vector<Found> found_;         // by place
  std::vector<std::uint32_t> sent_;  // rays, by place
  std::optional<LightSharing> sharing_;
};

}  // namespace laterna::bake
