#include "bake/final_gather.h"

#include <algorithm>
#include <cmath>

namespace laterna::bake {
namespace {

// Of all rays, what each luxel sends out to find how far off things are, and what it sends out at least after that; and no fewer
// than so many.
constexpr int kProbePart = 16, kFewestProbes = 16;
constexpr int kLeastPart = 7, kFewest = 16;
// A luxel's own part in what is found for it, which its neighbours do not share, is to be half as noisy as the mean of all rays
// would be.
constexpr float kOwnWorth = 4;
// Kept as one file.
constexpr std::size_t kBatchesPerPart = 512;

}  // namespace

FinalGather::FinalGather(const LuxelTree& tree, const LuxelRays& look, const BrightLuxels& bright,
                         const Patches& patches, SentLight light, int rays)
    : tree_(tree),
      look_(look),
      bright_(bright),
      patches_(patches),
      light_(light),
      rays_(rays),
      probes_(std::max(kFewestProbes, rays / kProbePart)),
      fewest_rays_(std::min(rays, std::max(kFewest, rays / kLeastPart))) {}

std::size_t FinalGather::steps(std::size_t luxels) { return 5 * PartWork::batches_of(luxels); }

float FinalGather::probe(std::uint32_t place) const {
  float nearness = 0;
  for (int ray = 0; ray < probes_; ++ray) nearness += 1 / look_.probe(place, ray, probes_);
  return nearness / static_cast<float>(probes_);
}

FinalGather::Found FinalGather::gather(std::uint32_t place, int rays, LuxelRays::Scratch& scratch) const {
  Found found;
  for (int ray = 0; ray < rays; ++ray) {
    const Sight sight = look_.look(place, ray, rays, scratch);
    if (sight.place == kNoLuxel) continue;
    glm::vec3 light =
        tree_.luxels()[sight.place].reflectance * light_.patch_irradiance[patches_.of(sight.place)];
    if (bright_.is_left_to_rays(place, sight.place)) light += light_.exitance[sight.place];
    found.irradiance += light * sight.tint;
  }
  found.irradiance /= static_cast<float>(rays);
  const float effort = std::sqrt(static_cast<float>(rays) / static_cast<float>(rays_));
  const BrightLuxels::Brought brought = bright_.brought_to(place, effort, look_, scratch);
  found.irradiance += brought.irradiance;
  if (brought.per_distance > 0) found.nearness = brought.per_distance / sum_of(found.irradiance);
  return found;
}

// Rays that stand behind each luxel.
std::vector<float> FinalGather::count_rays(const PartWork& work, const LightSharing& sharing) const {
  std::vector<float> all(nearness_.size());
  work.run(0, all.size(), [&](std::size_t place, LuxelRays::Scratch&) {
    float sharers = 1;
    sharing.for_others(static_cast<std::uint32_t>(place),
                       [&](std::uint32_t, float weight) { sharers += weight; });
    all[place] = std::max(static_cast<float>(rays_), sharers * static_cast<float>(fewest_rays_));
  });
  return all;
}

// What goes from one luxel to another comes back, in flux: a luxel with few sharers would lose more to these than it gives them,
// were each of its sharers a part of its own mean alone.
template <class Use>
void FinalGather::for_parts(std::uint32_t place, const LightSharing& sharing, std::span<const float> all,
                            Use use) const {
  const float area = tree_.luxels()[place].area;
  sharing.for_others(place, [&](std::uint32_t other, float weight) {
    const float part = weight * static_cast<float>(fewest_rays_) / std::max(all[place], all[other]);
    use(other, part * std::min(1.0F, tree_.luxels()[other].area / area));
  });
}

int FinalGather::rays_at(std::uint32_t place, const LightSharing& sharing, std::span<const float> all) const {
  float own = 1;
  for_parts(place, sharing, all, [&](std::uint32_t, float part) { own -= part; });
  return std::clamp(static_cast<int>(std::ceil(kOwnWorth * static_cast<float>(rays_) * own * own)),
                    fewest_rays_, rays_);
}

void FinalGather::find(const PartWork& work, const PartFiles& files) {
  const std::size_t count = tree_.luxels().size();
  work.run_in_parts(
      files, "near", count, kBatchesPerPart,
      [&](std::size_t place, LuxelRays::Scratch&) {
        nearness_[place] = probe(static_cast<std::uint32_t>(place));
      },
      [&](std::size_t first, std::size_t last) {
        return PartFiles::Values{std::as_writable_bytes(std::span(nearness_).subspan(first, last - first))};
      });
  if (work.is_cancelled()) return;
  const LightSharing sharing(tree_, nearness_);
  const std::vector<float> all = count_rays(work, sharing);
  if (work.is_cancelled()) return;
  work.run_in_parts(
      files, "lit", count, kBatchesPerPart,
      [&](std::size_t i, LuxelRays::Scratch& scratch) {
        const auto place = static_cast<std::uint32_t>(i);
        found_[i] = gather(place, rays_at(place, sharing, all), scratch);
      },
      [&](std::size_t first, std::size_t last) {
        return PartFiles::Values{std::as_writable_bytes(std::span(found_).subspan(first, last - first))};
      });
}

std::vector<glm::vec3> FinalGather::irradiance(const PartWork& work, const PartFiles& files) {
  const std::size_t count = tree_.luxels().size();
  nearness_.resize(count);
  found_.resize(count);
  std::vector<glm::vec3> shared(count);
  find(work, files);
  if (work.is_cancelled()) return shared;
  for (std::size_t i = 0; i < count; ++i) nearness_[i] = std::max(nearness_[i], found_[i].nearness);
  share(work, LightSharing(tree_, nearness_), shared);
  return shared;
}

void FinalGather::share(const PartWork& work, const LightSharing& sharing,
                        std::vector<glm::vec3>& shared) const {
  const std::vector<float> all = count_rays(work, sharing);
  work.run(0, shared.size(), [&](std::size_t i, LuxelRays::Scratch&) {
    const auto place = static_cast<std::uint32_t>(i);
    const glm::vec3& own = found_[i].irradiance;
    glm::vec3 change(0);
    for_parts(place, sharing, all,
              [&](std::uint32_t other, float part) { change += (found_[other].irradiance - own) * part; });
    shared[i] = own + change;
  });
}

}  // namespace laterna::bake
