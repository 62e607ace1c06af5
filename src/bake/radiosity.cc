#include "bake/radiosity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <span>
#include <string>
#include <string_view>

#include "bake/bright_luxels.h"
#include "bake/final_gather.h"
#include "bake/luxel_patches.h"
#include "bake/luxel_rays.h"
#include "bake/luxel_tree.h"
#include "bake/part_work.h"
#include "base/refuse.h"
#include "render/progress_report.h"

namespace laterna::bake {
namespace {

// A patch looks around from so many of its luxels.
constexpr int kViewpoints = 4;
constexpr int kMinRays = 16;
constexpr int kMaxRays = 65536;
constexpr int kMaxBounces = 1000;
constexpr std::size_t kMaxLuxels = 1U << 30U;
// So that no sum leaves single precision.
constexpr float kMaxLight = 1e15F;
constexpr float kMaxArea = 1e12F;
// Of a normal's squared length, of single precision and somebody else's rounding.
constexpr float kUnitError = 1e-3F;
// Kept as one file.
constexpr std::size_t kBatchesPerPart = 64;

glm::vec3 at_or_dark(std::span<const glm::vec3> light, std::size_t i) {
  return light.empty() ? glm::vec3(0) : light[i];
}

double sum_of(const glm::vec3& light) {
  return static_cast<double>(light.x) + static_cast<double>(light.y) + static_cast<double>(light.z);
}

class Solver {
 public:
  Solver(const frame::Frame& frame, const trace::RayScene& rays, std::span<const Luxel> luxels,
         const LightSources& sources, const RadiositySettings& settings, const TaskPool& pool,
         const Progress& progress, const PartFiles& parts)
      : settings_(settings),
        pool_(pool),
        seen_parts_(of_these(parts, luxels, sources).with({double(settings.rays)})),
        lit_parts_(seen_parts_.with({double(settings.bounces), double(settings.tolerance)})),
        tree_(frame, luxels),
        rays_(frame, rays, tree_, pool),
        patches_(luxels.size(), settings.rays),
        exitance_(initial_exitance(tree_, sources)),
        bright_(tree_, exitance_),
        // The last bounce goes to luxels.
        between_patches_(settings.bounces - (patches_.are_luxels() ? 0 : 1)),
        progress_(progress, (between_patches_ > 0 ? PartWork::batches_of(patches_.count()) : 0) +
                                (patches_.are_luxels() ? 0 : FinalGather::steps(luxels.size()))),
        work_(pool, progress_) {}

  Result<Interreflection> solve();

 private:
  // A ray's end, remembered: the luxel, and whether what it gives off before any bounce is left to rays.
  class End {
   public:
    End() = default;
    End(std::uint32_t place, bool is_counted) : word_(place << 1U | static_cast<std::uint32_t>(is_counted)) {}
    [[nodiscard]] std::uint32_t place() const { return word_ >> 1U; }
    [[nodiscard]] bool is_counted() const { return (word_ & 1U) != 0; }

   private:
    std::uint32_t word_ = kNoLuxel << 1U;
  };

  static PartFiles of_these(const PartFiles& parts, std::span<const Luxel> luxels,
                            const LightSources& sources);
  static std::vector<glm::vec3> initial_exitance(const LuxelTree& tree, const LightSources& sources);
  [[nodiscard]] int viewpoints_of(std::size_t patch) const {
    return static_cast<int>(std::min<std::size_t>(kViewpoints, patches_.size(patch)));
  }
  void look_around(std::size_t patch, LuxelRays::Scratch& scratch);
  [[nodiscard]] glm::vec3 gather(std::size_t patch) const;
  [[nodiscard]] glm::vec3 reflected(std::uint32_t place) const {
    return tree_.luxels()[place].reflectance * patch_irradiance_[patches_.of(place)];
  }
  void look_around_all();
  void bounce_between_patches();
  [[nodiscard]] bool adds_little(double change, double last_change) const;
  [[nodiscard]] std::vector<glm::vec3> irradiance_of_luxels();

  RadiositySettings settings_;
  const TaskPool& pool_;
  PartFiles seen_parts_, lit_parts_;
  LuxelTree tree_;
  LuxelRays rays_;
  Patches patches_;
  std::vector<glm::vec3> exitance_;  // by place, before any of the bounces
  BrightLuxels bright_;
  int between_patches_;
  render::ProgressReport progress_;
  PartWork work_;
  std::vector<End> ends_;           // `rays` of each patch
  std::vector<glm::vec3> tints_;    // of the same rays; empty where there are no panes
  std::vector<glm::vec3> brought_;  // by patch: by bright luxels, which do not change from bounce to bounce
  std::vector<glm::vec3> patch_irradiance_;
  std::vector<double> patch_areas_;
  int bounces_ = 0;
};

// What surfaces reflect, layers on them included, is in the luxels.
PartFiles Solver::of_these(const PartFiles& parts, std::span<const Luxel> luxels,
                           const LightSources& sources) {
  return parts.with(std::as_bytes(luxels))
      .with(std::as_bytes(sources.direct_irradiance))
      .with(std::as_bytes(sources.exitance));
}

std::vector<glm::vec3> Solver::initial_exitance(const LuxelTree& tree, const LightSources& sources) {
  std::vector<glm::vec3> exitance(tree.luxels().size());
  for (std::size_t place = 0; place < exitance.size(); ++place) {
    const std::size_t luxel = tree.order()[place];
    exitance[place] = at_or_dark(sources.exitance, luxel) +
                      tree.luxels()[place].reflectance * sources.direct_irradiance[luxel];
  }
  return exitance;
}

// Finds what the rays of a patch end on, once for all bounces: these are its row of form factors.
void Solver::look_around(std::size_t patch, LuxelRays::Scratch& scratch) {
  const int viewpoints = viewpoints_of(patch);
  const auto row = patch * static_cast<std::size_t>(patches_.rays());
  const auto viewpoint = [&](int number) {
    const std::size_t step = (2 * static_cast<std::size_t>(number) + 1) * patches_.size(patch);
    return static_cast<std::uint32_t>(patches_.first(patch) +
                                      step / (2 * static_cast<std::size_t>(viewpoints)));
  };
  glm::vec3 brought(0);
  for (int number = 0; number < viewpoints; ++number)
    brought +=
        bright_.brought_to(viewpoint(number), 1 / static_cast<float>(viewpoints), rays_, scratch).irradiance;
  brought_[patch] = brought / static_cast<float>(viewpoints);
  for (int ray = 0; ray < patches_.rays(); ++ray) {
    const int number = ray % viewpoints;
    const std::uint32_t from = viewpoint(number);
    const int rays_from_here = (patches_.rays() - number + viewpoints - 1) / viewpoints;
    const Sight sight = rays_.look(from, ray / viewpoints, rays_from_here, scratch);
    const auto i = row + static_cast<std::size_t>(ray);
    ends_[i] = End(sight.place, sight.place != kNoLuxel && bright_.is_left_to_rays(from, sight.place));
    if (!tints_.empty()) tints_[i] = sight.tint;
  }
}

glm::vec3 Solver::gather(std::size_t patch) const {
  const auto row = patch * static_cast<std::size_t>(patches_.rays());
  glm::vec3 sum(0);
  for (auto i = row; i < row + static_cast<std::size_t>(patches_.rays()); ++i) {
    const End end = ends_[i];
    if (end.place() == kNoLuxel) continue;
    const glm::vec3 light =
        (end.is_counted() ? exitance_[end.place()] : glm::vec3(0)) + reflected(end.place());
    sum += tints_.empty() ? light : light * tints_[i];
  }
  return brought_[patch] + sum / static_cast<float>(patches_.rays());
}

// What is still to come, if changes go on falling as these two did: change · q / (1 − q), q their quotient.
bool Solver::adds_little(double change, double last_change) const {
  double total = 0;
  for (std::size_t patch = 0; patch < patches_.count(); ++patch)
    total += sum_of(patch_irradiance_[patch]) * patch_areas_[patch];
  const double quotient = last_change > 0 ? change / last_change : 0;
  return quotient < 1 &&
         change * quotient / (1 - quotient) <= static_cast<double>(settings_.tolerance) * total;
}

void Solver::bounce_between_patches() {
  std::vector<glm::vec3> next(patches_.count());
  double last_change = 0;
  while (bounces_ < between_patches_ && !progress_.asks_to_stop()) {
    pool_.for_each(next.size(), [&](std::size_t patch, int) { next[patch] = gather(patch); });
    double change = 0;
    for (std::size_t patch = 0; patch < next.size(); ++patch)
      change += std::abs(sum_of(next[patch] - patch_irradiance_[patch])) * patch_areas_[patch];
    patch_irradiance_.swap(next);
    ++bounces_;
    if (bounces_ > 1 && adds_little(change, last_change)) return;
    last_change = change;
  }
}

std::vector<glm::vec3> Solver::irradiance_of_luxels() {
  std::vector<glm::vec3> irradiance(tree_.luxels().size());
  if (patches_.are_luxels()) {
    for (std::size_t place = 0; place < irradiance.size(); ++place)
      irradiance[tree_.order()[place]] = patch_irradiance_[place];
    return irradiance;
  }
  const std::vector<glm::vec3> by_place =
      FinalGather(tree_, rays_, bright_, patches_, {exitance_, patch_irradiance_}, settings_.rays)
          .irradiance(work_, lit_parts_);
  for (std::size_t place = 0; place < by_place.size(); ++place)
    irradiance[tree_.order()[place]] = by_place[place];
  ++bounces_;
  return irradiance;
}

void Solver::look_around_all() {
  const std::size_t rays = patches_.count() * static_cast<std::size_t>(patches_.rays());
  ends_.resize(rays);
  if (rays_.has_panes()) tints_.resize(rays);
  brought_.resize(patches_.count());
  patch_areas_.resize(patches_.count());
  for (std::uint32_t place = 0; place < tree_.luxels().size(); ++place)
    patch_areas_[patches_.of(place)] += static_cast<double>(tree_.luxels()[place].area);
  work_.run_in_parts(
      seen_parts_, "seen", patches_.count(), kBatchesPerPart,
      [&](std::size_t patch, LuxelRays::Scratch& scratch) { look_around(patch, scratch); },
      [&](std::size_t first, std::size_t last) {
        const auto rays_each = static_cast<std::size_t>(patches_.rays());
        PartFiles::Values values = {
            std::as_writable_bytes(std::span(brought_).subspan(first, last - first)),
            std::as_writable_bytes(std::span(ends_).subspan(first * rays_each, (last - first) * rays_each))};
        if (!tints_.empty())
          values.push_back(std::as_writable_bytes(
              std::span(tints_).subspan(first * rays_each, (last - first) * rays_each)));
        return values;
      });
}

Result<Interreflection> Solver::solve() {
  patch_irradiance_.resize(patches_.count(), glm::vec3(0));
  if (between_patches_ > 0) {
    look_around_all();
    bounce_between_patches();
  }
  Interreflection result;
  result.irradiance = irradiance_of_luxels();
  if (progress_.is_cancelled())
    return tl::unexpected(Error(Failure::cancelled, Diagnostic{{}, {}, "cancelled"}));
  result.bounces = bounces_;
  result.patch_count = patches_.count();
  return result;
}

Result<void> check_settings(const RadiositySettings& settings) {
  if (settings.rays < kMinRays || settings.rays > kMaxRays)
    return refuse(fmt::format("expected {} to {} rays, found {}", kMinRays, kMaxRays, settings.rays));
  if (settings.bounces < 0 || settings.bounces > kMaxBounces)
    return refuse(fmt::format("expected 0 to {} bounces, found {}", kMaxBounces, settings.bounces));
  if (!(settings.tolerance >= 0 && settings.tolerance <= 1))
    return refuse(fmt::format("expected a tolerance from 0 to 1, found {}", settings.tolerance));
  return {};
}

// Each channel from 0 to `most`, and a number.
bool is_within(const glm::vec3& channels, float most) {
  return glm::all(glm::greaterThanEqual(channels, glm::vec3(0))) &&
         glm::all(glm::lessThanEqual(channels, glm::vec3(most)));
}

std::string text_of(const glm::vec3& v) { return fmt::format("{}, {}, {}", v.x, v.y, v.z); }

// What is wrong with a luxel, or nothing.
std::string find_fault(const frame::Frame& frame, const Luxel& luxel) {
  if (!glm::all(glm::lessThanEqual(glm::abs(luxel.position_ws), glm::vec3(kMaxCoordinate))))
    return fmt::format("expected a position within {:g} m, found {}", kMaxCoordinate,
                       text_of(luxel.position_ws));
  if (!(std::abs(glm::dot(luxel.normal_ws, luxel.normal_ws) - 1) <= kUnitError))
    return fmt::format("expected a normal of length 1, found {}", text_of(luxel.normal_ws));
  if (!(luxel.area > 0 && luxel.area <= kMaxArea))
    return fmt::format("expected an area above 0 and up to {:g} m², found {}", kMaxArea, luxel.area);
  const std::uint32_t cluster = cluster_of(luxel.triangle);
  if (cluster >= frame.clusters.size() ||
      luxel.triangle % kTrianglesPerCluster >= frame.clusters[cluster].triangle_count)
    return fmt::format("expected a triangle of the frame, found id {}", luxel.triangle);
  if (!is_within(luxel.reflectance, 1))
    return fmt::format("expected a reflectance from 0 to 1, found {}", text_of(luxel.reflectance));
  return {};
}

std::string find_fault(const LightSources& sources, std::size_t luxel) {
  const glm::vec3& direct = sources.direct_irradiance[luxel];
  if (!is_within(direct, kMaxLight))
    return fmt::format("expected an irradiance from 0 to {:g}, found {}", kMaxLight, text_of(direct));
  const glm::vec3 own = at_or_dark(sources.exitance, luxel);
  if (!is_within(own, kMaxLight))
    return fmt::format("expected an exitance from 0 to {:g}, found {}", kMaxLight, text_of(own));
  return {};
}

Result<void> check_luxels(const frame::Frame& frame, std::span<const Luxel> luxels,
                          const LightSources& sources) {
  if (luxels.size() > kMaxLuxels)
    return refuse(fmt::format("expected up to {} luxels, found {}", kMaxLuxels, luxels.size()));
  if (sources.direct_irradiance.size() != luxels.size())
    return refuse(fmt::format("expected direct irradiance for {} luxels, found it for {}", luxels.size(),
                              sources.direct_irradiance.size()));
  if (!sources.exitance.empty() && sources.exitance.size() != luxels.size())
    return refuse(fmt::format("expected exitance for {} luxels or none, found it for {}", luxels.size(),
                              sources.exitance.size()));
  for (std::size_t i = 0; i < luxels.size(); ++i) {
    std::string fault = find_fault(frame, luxels[i]);
    if (fault.empty()) fault = find_fault(sources, i);
    if (fault.empty()) continue;
    return tl::unexpected(
        Error(Failure::bad_input, Diagnostic{{}, fmt::format("luxel {}", i), std::move(fault)}));
  }
  return {};
}

}  // namespace

Result<Interreflection> interreflect(const frame::Frame& frame, const trace::RayScene& rays,
                                     std::span<const Luxel> luxels, const LightSources& sources,
                                     const RadiositySettings& settings, const TaskPool& pool,
                                     const Progress& progress, const PartFiles& parts) {
  if (auto checked = check_settings(settings); !checked) return tl::unexpected(std::move(checked.error()));
  if (auto checked = check_luxels(frame, luxels, sources); !checked)
    return tl::unexpected(std::move(checked.error()));
  if (luxels.empty() || settings.bounces == 0)
    return Interreflection{std::vector(luxels.size(), glm::vec3(0)), 0, 0};
  return Solver(frame, rays, luxels, sources, settings, pool, progress, parts).solve();
}

}  // namespace laterna::bake
