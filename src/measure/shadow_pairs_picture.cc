#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "base/refuse.h"
#include "base/task_pool.h"
#include "laterna/measure.h"
#include "light/silhouette_plan.h"
#include "measure/painted_surfaces.h"

namespace laterna {
namespace {

struct NamedPair {
  std::uint32_t occluder = 0, receiver = 0;  // as the frame counts objects
  bool is_ordered = false;
};

// What a light's silhouettes are drawn for.
struct PairsOfLight {
  std::vector<std::string> names;  // of all objects
  std::size_t objects = 0;         // that cast or receive
  std::vector<NamedPair> pairs;    // by occluder, then receiver
};

PairsOfLight list_pairs(const light::SilhouettePlan& plan, const frame::Frame& frame) {
  PairsOfLight found;
  found.names = frame.object_names;
  found.objects = static_cast<std::size_t>(
      std::count_if(plan.objects.begin(), plan.objects.end(),
                    [](const light::SilhouetteObject& o) { return o.casts || o.receives; }));
  for (std::uint32_t receiver = 0; receiver < plan.lookups.size(); ++receiver) {
    for (const light::SilhouetteLookup& lookup : plan.lookups[receiver])
      found.pairs.push_back({plan.occluders[lookup.occluder].object, receiver, lookup.is_ordered});
  }
  std::stable_sort(found.pairs.begin(), found.pairs.end(),
                   [](const NamedPair& a, const NamedPair& b) { return a.occluder < b.occluder; });
  return found;
}

// Planned as for a picture, on a frame of its own: the renderer keeps its frame to itself.
Result<PairsOfLight> find_pairs(const Renderer& renderer, const RenderSettings& settings,
                                const std::string& name) {
  const Scene& scene = renderer.scene();
  const TaskPool pool(renderer.threads());
  Result<frame::TextureLibrary> textures = frame::TextureLibrary::load(scene, pool);
  if (!textures) return tl::unexpected(std::move(textures.error()));
  const Result<frame::Frame> frame =
      frame::Frame::build(scene, std::make_shared<const frame::TextureLibrary>(std::move(*textures)),
                          frame::build_clusters(scene, pool), pool);
  if (!frame) return tl::unexpected(frame.error());
  const light::LightPlan plan = light::make_light_plan(*frame, {settings.shadows, {}, nullptr});
  for (const light::PlannedLight& planned : plan.lights) {
    if (planned.placed->light->name == name && planned.technique == ShadowTechnique::silhouette)
      return list_pairs(light::make_silhouette_plan(planned, *frame), *frame);
  }
  return refuse("light \"" + name + "\" has no projected silhouettes: its shadow technique is another one");
}

constexpr glm::dvec3 kInNoPair(0.15, 0.15, 0.15);

// Of a wheel of hues, 0…1.
const char* name_of_hue(double hue) {
  constexpr std::array<const char*, 12> kNames = {"red",   "orange",    "yellow",  "lime",
                                                  "green", "turquoise", "cyan",    "azure",
                                                  "blue",  "violet",    "magenta", "rose"};
  return kNames.at(static_cast<std::size_t>(std::floor(hue * 12 + 0.5)) % kNames.size());
}

glm::dvec3 color_of_hue(double hue) {
  const glm::dvec3 wheel(std::abs(6 * hue - 3) - 1, 2 - std::abs(6 * hue - 2), 2 - std::abs(6 * hue - 4));
  return 0.05 + 0.85 * glm::clamp(wheel, 0.0, 1.0);
}

// Hues of the objects that are in a pair, as far apart as may be however many there are: steps of the golden ratio.
class ObjectHues {
 public:
  explicit ObjectHues(const PairsOfLight& found) : hue_(found.names.size(), kNone) {
    for (const NamedPair& pair : found.pairs) hue_[pair.occluder] = hue_[pair.receiver] = 0;
    constexpr double kGoldenRatio = 0.6180339887498949;
    double hue = 0;
    for (double& own : hue_) {
      if (own == kNone) continue;
      own = hue;
      hue += kGoldenRatio;
      hue -= std::floor(hue);
    }
  }

  [[nodiscard]] glm::dvec3 color(std::uint32_t object) const {
    return hue_[object] == kNone ? kInNoPair : color_of_hue(hue_[object]);
  }
  [[nodiscard]] const char* name(std::uint32_t object) const { return name_of_hue(hue_[object]); }

 private:
  static constexpr double kNone = -1;
  std::vector<double> hue_;
};

// Every other stripe is the object's own, and those between its occluders' in turn.
glm::dvec3 stripe_color(const measure::SeenSurface& seen, const std::vector<std::uint32_t>& occluders,
                        const ObjectHues& hues) {
  constexpr int kStripe = 8;  // pixels along a row
  const int stripe = (seen.x + seen.y) / kStripe;
  if (occluders.empty() || stripe % 2 == 0) return hues.color(seen.object);
  return hues.color(occluders[static_cast<std::size_t>(stripe / 2) % occluders.size()]);
}

std::vector<std::string> describe_pairs(const PairsOfLight& found, const ObjectHues& hues) {
  constexpr std::size_t kMostLines = 40;
  std::vector<std::string> lines = {
      fmt::format("{} pairs of {} objects; an object is striped with the colours of those that may shade it, "
                  "grey is in no pair",
                  found.pairs.size(), found.objects)};
  for (const NamedPair& pair : found.pairs) {
    if (lines.size() > kMostLines) {
      lines.push_back(fmt::format("and {} pairs more", found.pairs.size() - kMostLines));
      break;
    }
    lines.push_back(fmt::format("\"{}\" ({}) may shade \"{}\" ({}){}", found.names[pair.occluder],
                                hues.name(pair.occluder), found.names[pair.receiver],
                                hues.name(pair.receiver),
                                pair.is_ordered ? "" : ": their distances from the light overlap"));
  }
  return lines;
}

}  // namespace

Result<ExplainedPicture> shadow_pairs_picture(const Renderer& renderer, const View& camera,
                                              const RenderSettings& settings, const std::string& light) {
  // Refuses what a picture would refuse, and lights that there are not.
  if (const auto checked = renderer.shadow_map_views(light, camera, settings); !checked)
    return tl::unexpected(checked.error());
  const Result<PairsOfLight> found = find_pairs(renderer, settings, light);
  if (!found) return tl::unexpected(found.error());
  if (found->objects < 2) {
    return refuse(fmt::format("a pair takes two objects that cast or receive shadows: the scene has {}",
                              found->objects == 0 ? "none" : "one"));
  }
  const ObjectHues hues(*found);
  std::vector<std::vector<std::uint32_t>> occluders(found->names.size());
  for (const NamedPair& pair : found->pairs) occluders[pair.receiver].push_back(pair.occluder);
  Result<LayeredImage> picture = measure::paint_surfaces(
      renderer, camera, settings,
      [&](const measure::SeenSurface& seen) { return stripe_color(seen, occluders[seen.object], hues); });
  if (!picture) return tl::unexpected(std::move(picture.error()));
  return ExplainedPicture{std::move(*picture), describe_pairs(*found, hues)};
}

}  // namespace laterna
