#include "scene/unread_shadow_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

namespace laterna {
namespace {

using T = ShadowTechnique;
using Settings = ShadowSettings;

const Settings kDefault;

struct Member {
  std::string_view name;
  std::initializer_list<T> readers;
  bool (*is_set)(const Settings& settings);  // to something else than the default
};

constexpr std::initializer_list<T> kMaps = {T::map, T::pcss, T::cascades};
constexpr std::initializer_list<T> kMapsAndMoments = {T::map, T::pcss, T::variance, T::cascades};
constexpr std::initializer_list<T> kDrawn = {T::silhouette, T::map, T::pcss, T::variance, T::cascades};
constexpr std::initializer_list<T> kFiltered = {T::silhouette, T::map, T::pcss, T::cascades};
constexpr std::initializer_list<T> kMap = {T::map};
constexpr std::initializer_list<T> kGround = {T::ground};
constexpr std::initializer_list<T> kSilhouette = {T::silhouette};
constexpr std::initializer_list<T> kVariance = {T::variance};
constexpr std::initializer_list<T> kCascades = {T::cascades};

// Not "resolution": whatever the technique, it is the size of the light's depth map and the yardstick of `laterna accuracy`.
// "warp" is refused beside other techniques; the settings of darkness serve all.
constexpr Member kMembers[] = {
    {"filter", kFiltered, [](const Settings& s) { return s.filter != kDefault.filter; }},
    {"kernel", kMaps, [](const Settings& s) { return s.kernel != kDefault.kernel; }},
    {"constant_bias", kMapsAndMoments, [](const Settings& s) { return s.constant_bias.has_value(); }},
    {"slope_bias", kMapsAndMoments, [](const Settings& s) { return s.slope_bias.has_value(); }},
    {"caster_faces", kDrawn, [](const Settings& s) { return s.caster_faces != kDefault.caster_faces; }},
    {"outside", kMapsAndMoments,
     [](const Settings& s) { return s.outside_is_lit != kDefault.outside_is_lit; }},
    {"depth", kMapsAndMoments, [](const Settings& s) { return s.depth != kDefault.depth; }},
    {"layout", kMap, [](const Settings& s) { return s.layout != kDefault.layout; }},
    {"soft_edge", kMaps, [](const Settings& s) { return s.soft_edge != kDefault.soft_edge; }},
    {"moments", kVariance, [](const Settings& s) { return s.moments != kDefault.moments; }},
    {"bleeding_reduction", kVariance,
     [](const Settings& s) { return s.bleeding_reduction != kDefault.bleeding_reduction; }},
    {"blur", kVariance, [](const Settings& s) { return s.blur != kDefault.blur; }},
    {"planes", kGround, [](const Settings& s) { return !s.planes.empty(); }},
    {"smooth", kSilhouette, [](const Settings& s) { return s.smooth != kDefault.smooth; }},
    {"smooth_kernel", kSilhouette,
     [](const Settings& s) { return s.smooth_kernel != kDefault.smooth_kernel; }},
    {"order", kSilhouette, [](const Settings& s) { return s.orders_objects != kDefault.orders_objects; }},
    {"cull", kSilhouette, [](const Settings& s) { return s.culls_occluders != kDefault.culls_occluders; }},
    {"cascades", kCascades, [](const Settings& s) { return s.cascades != kDefault.cascades; }},
    {"split_lambda", kCascades, [](const Settings& s) { return s.split_lambda != kDefault.split_lambda; }},
    {"cascade_distance", kCascades,
     [](const Settings& s) { return s.cascade_distance != kDefault.cascade_distance; }},
};

std::string_view name_of(T technique) {
  for (const TechniqueDescription& known : list_techniques()) {
    if (known.technique == technique) return known.name;
  }
  return {};
}

std::string list_of(std::initializer_list<T> techniques) {
  std::string list;
  std::size_t left = techniques.size();
  for (const T technique : techniques) {
    list += fmt::format("\"{}\"", name_of(technique));
    --left;
    if (left > 0) list += left == 1 ? " and " : ", ";
  }
  return list;
}

}  // namespace

void warn_of_unread_settings(JsonObject& shadow, const ShadowSettings& settings) {
  if (!settings.technique || *settings.technique == T::none) return;
  for (const Member& member : kMembers) {
    const bool is_read = std::ranges::find(member.readers, *settings.technique) != member.readers.end();
    if (is_read || !shadow.has(member.name) || !member.is_set(settings)) continue;
    shadow.warning(member.name, fmt::format("has no effect with \"technique\": \"{}\": it is read by {}",
                                            name_of(*settings.technique), list_of(member.readers)));
  }
}

}  // namespace laterna
