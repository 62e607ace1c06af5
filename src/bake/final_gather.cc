#include "bake/final_gather.h"

#include <algorithm>
#include <cmath>

namespace laterna::bake {
namespace {

// Rays that each luxel sends out before it is known what it shares: this part of all, and no fewer than these.
constexpr int kFirstPart = 8, kFewest = 16;
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
      first_rays_(std::min(rays, std::max(kFewest, rays / kFirstPart))) {}

std::size_t FinalGather::steps(std::size_t luxels) { return 3 * PartWork::batches_of(luxels); }

FinalGather::Found FinalGather::gather(std::uint32_t place, int rays, LuxelRays::Scratch& scratch) const {
  const auto sum_of = [](const glm::vec3& light) { return light.x + light.y + light.z; };
  Found found;
  float per_distance = 0;  // of light
  for (int ray = 0; ray < rays; ++ray) {
    const Sight sight = look_.look(place, ray, rays, scratch);
    found.nearness += 1 / sight.distance;
    if (sight.place == kNoLuxel) continue;
    glm::vec3 light =
        tree_.luxels()[sight.place].reflectance * light_.patch_irradiance[patches_.of(sight.place)];
    if (bright_.is_left_to_rays(place, sight.place)) light += light_.exitance[sight.place];
    light *= sight.tint;
    found.irradiance += light;
    per_distance += sum_of(light) / sight.distance;
  }
  const float part = 1 / static_cast<float>(rays);
  found.nearness *= part;
  found.irradiance *= part;
  const float effort = std::sqrt(static_cast<float>(rays) / static_cast<float>(rays_));
  const BrightLuxels::Brought brought = bright_.brought_to(place, effort, look_, scratch);
  found.irradiance += brought.irradiance;
  per_distance = per_distance * part + brought.per_distance;
  // Where most light comes from what is near, it changes within a part of that distance.
  if (per_distance > 0) found.nearness = std::max(found.nearness, per_distance / sum_of(found.irradiance));
  return found;
}

// Where none of the rays of a leaf's luxels, which lie side by side, has found any light, as inside of things.
std::vector<bool> FinalGather::find_dark() const {
  std::vector<bool> is_dark(found_.size());
  const auto brings_nothing = [](const Found& found) { return found.irradiance == glm::vec3(0); };
  for (const LuxelNode& node : tree_.nodes()) {
    if (!node.is_leaf()) continue;
    const auto first = found_.begin() + node.first, last = found_.begin() + node.last;
    if (std::all_of(first, last, brings_nothing))
      std::fill(is_dark.begin() + node.first, is_dark.begin() + node.last, true);
  }
  return is_dark;
}

void FinalGather::find(const PartWork& work, const PartFiles& files) {
  const std::size_t count = tree_.luxels().size();
  const auto send = [&](std::size_t place, int rays, LuxelRays::Scratch& scratch) {
    found_[place] = gather(static_cast<std::uint32_t>(place), rays, scratch);
    sent_[place] = static_cast<std::uint32_t>(rays);
  };
  const auto values = [&](std::size_t first, std::size_t last) {
    return PartFiles::Values{std::as_writable_bytes(std::span(found_).subspan(first, last - first)),
                             std::as_writable_bytes(std::span(sent_).subspan(first, last - first))};
  };
  work.run_in_parts(
      files, "found", count, kBatchesPerPart,
      [&](std::size_t place, LuxelRays::Scratch& scratch) { send(place, first_rays_, scratch); }, values);
  if (work.is_cancelled()) return;
  const std::vector<bool> is_dark = find_dark();
  std::vector<float> nearness(count);
  std::ranges::transform(found_, nearness.begin(), &Found::nearness);
  sharing_.emplace(tree_, nearness);
  work.run_in_parts(
      files, "lit", count, kBatchesPerPart,
      [&](std::size_t place, LuxelRays::Scratch& scratch) {
        if (is_dark[place]) return;
        float others = 0;
        sharing_->for_others(static_cast<std::uint32_t>(place),
                             [&](std::uint32_t, float weight) { others += weight; });
        const int missing = rays_ - static_cast<int>(others * static_cast<float>(first_rays_));
        if (missing > first_rays_) send(place, missing, scratch);
      },
      values);
}

std::vector<glm::vec3> FinalGather::irradiance(const PartWork& work, const PartFiles& files) {
  found_.resize(tree_.luxels().size());
  sent_.resize(found_.size());
  std::vector<glm::vec3> shared(found_.size());
  find(work, files);
  if (work.is_cancelled()) return shared;
  work.run(0, shared.size(), [&](std::size_t place, LuxelRays::Scratch&) {
    auto all = static_cast<float>(sent_[place]);
    glm::vec3 sum = found_[place].irradiance * all;
    sharing_->for_others(static_cast<std::uint32_t>(place), [&](std::uint32_t other, float weight) {
      const float counts = weight * static_cast<float>(sent_[other]);
      sum += found_[other].irradiance * counts;
      all += counts;
    });
    shared[place] = sum / all;
  });
  return shared;
}

}  // namespace laterna::bake
