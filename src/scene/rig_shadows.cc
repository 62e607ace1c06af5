#include "scene/rig_shadows.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "scene/rig_ranges.h"
#include "scene/unread_shadow_settings.h"

namespace laterna {
namespace {

void read_technique(JsonObject& shadow, Light& light) {
  std::vector<std::pair<std::string_view, ShadowTechnique>> choices;
  for (const TechniqueDescription& t : list_techniques()) choices.emplace_back(t.name, t.technique);
  light.shadow.technique = shadow.choice<ShadowTechnique>("technique", choices);
  if (!light.shadow.technique) return;
  if (std::string fault = find_fault(*light.shadow.technique, light); !fault.empty()) {
    shadow.error("technique", std::move(fault));
  }
}

void read_filter(JsonObject& shadow, ShadowSettings& settings) {
  settings.filter =
      shadow
          .choice<ShadowFilter>("filter", {{"refined", ShadowFilter::refined},
                                           {"nearest", ShadowFilter::nearest},
                                           {"bilinear", ShadowFilter::bilinear},
                                           {"percentage_closer", ShadowFilter::percentage_closer},
                                           {"averaged_depths", ShadowFilter::averaged_depths}})
          .value_or(settings.filter);
  if (const std::optional<std::uint64_t> kernel = shadow.whole("kernel", kLeastKernel, kMostKernel)) {
    settings.kernel = static_cast<int>(*kernel);
    if (settings.filter != ShadowFilter::percentage_closer &&
        settings.filter != ShadowFilter::averaged_depths) {
      shadow.error("kernel",
                   fmt::format("has an effect only with \"filter\": {} or {} beside it",
                               shadow.quoted("percentage_closer"), shadow.quoted("averaged_depths")));
    }
  }
}

void read_map(JsonObject& shadow, ShadowSettings& settings) {
  settings.resolution = static_cast<int>(shadow.whole("resolution", 1, kMaxShadowResolution).value_or(0));
  read_filter(shadow, settings);
  settings.constant_bias = shadow.number("constant_bias", kCoordinate);
  settings.slope_bias = shadow.number("slope_bias", kCoordinate);
  settings.caster_faces = shadow
                              .choice<CasterFaces>("caster_faces", {{"both", CasterFaces::both},
                                                                    {"back_only", CasterFaces::back_only}})
                              .value_or(CasterFaces::both);
  settings.outside_is_lit =
      shadow.choice<bool>("outside", {{"lit", true}, {"shadowed", false}}).value_or(true);
}

void read_depth(JsonObject& shadow, Light& light) {
  light.shadow.depth =
      shadow.choice<ShadowDepth>("depth", {{"planar", ShadowDepth::planar}, {"radial", ShadowDepth::radial}})
          .value_or(ShadowDepth::planar);
  if (std::string fault = find_fault(light.shadow.depth, light); !fault.empty())
    shadow.error("depth", std::move(fault));
  light.shadow.soft_edge = shadow.number("soft_edge", kLength).value_or(0);
}

void read_variance(JsonObject& shadow, ShadowSettings& settings) {
  settings.moments = shadow
                         .choice<ShadowMoments>("moments", {{"variance", ShadowMoments::variance},
                                                            {"exponential", ShadowMoments::exponential}})
                         .value_or(settings.moments);
  if (const auto given = shadow.number("bleeding_reduction", kZeroToOne))
    settings.bleeding_reduction = static_cast<float>(*given);
  if (const auto given = shadow.number("blur", {0, kMaxShadowBlur, false, false}))
    settings.blur = static_cast<float>(*given);
}

// {"normal", "distance"} or {"normal", "point"}.
void read_plane(const JsonDocument& json, const JsonValue& value, FaultList& faults,
                ShadowSettings& settings) {
  JsonObject object(json, value, faults);
  if (!value.is_object()) return;
  ShadowPlane plane;
  object.require("normal");
  if (const auto n = object.numbers<3>("normal", kCoordinate)) {
    plane.normal = glm::dvec3((*n)[0], (*n)[1], (*n)[2]);
    if (glm::dot(plane.normal, plane.normal) < 1e-24) {
      object.error("normal", "expected a vector that is not zero");
      plane.normal = {0, 1, 0};
    }
  }
  const auto point = object.numbers<3>("point", kCoordinate);
  const auto distance = object.number("distance", kCoordinate);
  if (object.has("point") == object.has("distance"))
    object.error("", "expected exactly one of \"point\" and \"distance\" beside \"normal\"");
  // What is a unit vector already, to rounding, is kept: so a plane that has been written down is the same when read.
  constexpr double kRounding = 1e-15;
  if (std::abs(glm::dot(plane.normal, plane.normal) - 1) > kRounding)
    plane.normal = glm::normalize(plane.normal);
  if (point) plane.distance = glm::dot(plane.normal, glm::dvec3((*point)[0], (*point)[1], (*point)[2]));
  if (distance) plane.distance = *distance;
  object.report_unknown_members("a plane");
  settings.planes.push_back(plane);
}

void read_ground(const JsonDocument& json, JsonObject& shadow, FaultList& faults, ShadowSettings& settings) {
  const JsonValue* planes = shadow.array("planes");
  if (planes == nullptr) return;
  if (planes->children.empty()) shadow.error("planes", "is empty: leave it out for the scene's floor");
  for (const JsonValue& plane : planes->children) read_plane(json, plane, faults, settings);
}

void read_silhouette(JsonObject& shadow, ShadowSettings& settings) {
  settings.smooth = static_cast<int>(shadow.whole("smooth", 0, kMostSmoothing).value_or(0));
  if (const auto kernel = shadow.choice<SmoothKernel>(
          "smooth_kernel",
          {{"eight_neighbours", SmoothKernel::eight_neighbours}, {"binomial", SmoothKernel::binomial}})) {
    settings.smooth_kernel = *kernel;
    if (settings.smooth == 0)
      shadow.error("smooth_kernel", "has an effect only with \"smooth\": 1 or more beside it");
  }
  settings.orders_objects =
      shadow.choice<bool>("order", {{"distance", true}, {"none", false}}).value_or(true);
  settings.culls_occluders = shadow.boolean("cull").value_or(true);
}

void read_warp(JsonObject& shadow, Light& light) {
  const auto warp = shadow.choice<ShadowWarp>(
      "warp", {{"none", ShadowWarp::none}, {"light_space_perspective", ShadowWarp::light_space_perspective}});
  light.shadow.warp = warp.value_or(ShadowWarp::none);
  if (std::string fault = find_fault(light.shadow.warp, light); !fault.empty())
    shadow.error("warp", std::move(fault));
}

void read_layout(JsonObject& shadow, Light& light) {
  light.shadow.layout =
      shadow
          .choice<ShadowLayout>(
              "layout", {{"cube", ShadowLayout::cube}, {"dual_paraboloid", ShadowLayout::dual_paraboloid}})
          .value_or(ShadowLayout::cube);
  if (std::string fault = find_fault(light.shadow.layout, light); !fault.empty())
    shadow.error("layout", std::move(fault));
}

void read_cascades(JsonObject& shadow, ShadowSettings& settings) {
  if (const auto count = shadow.whole("cascades", 1, kMostCascades))
    settings.cascades = static_cast<int>(*count);
  settings.split_lambda = shadow.number("split_lambda", kZeroToOne).value_or(settings.split_lambda);
  settings.cascade_distance = shadow.number("cascade_distance", kPositiveLength).value_or(0);
}

void read_darkness(JsonObject& shadow, ShadowSettings& settings) {
  if (const auto color = shadow.numbers<3>("color", kZeroToOne)) {
    settings.color = glm::vec3((*color)[0], (*color)[1], (*color)[2]);
  }
  const auto read = [&](std::string_view name, float& value) {
    if (const auto given = shadow.number(name, kZeroToOne)) value = static_cast<float>(*given);
  };
  read("opacity", settings.opacity);
  read("ambient", settings.ambient);
  read("fill", settings.fill);
}

}  // namespace

void read_rig_shadow(const JsonDocument& json, JsonObject& object, FaultList& faults, Light& light) {
  const JsonValue* value = object.any("shadow");
  if (value == nullptr) return;
  if (value->kind == JsonValue::Kind::boolean) {
    if (!value->boolean) light.shadow.technique = ShadowTechnique::none;
    return;
  }
  if (!value->is_object()) {
    object.error("shadow", fmt::format("expected true, false or an object, got {}", describe(*value)));
    return;
  }
  JsonObject shadow(json, *value, faults, object.names());
  read_technique(shadow, light);
  read_map(shadow, light.shadow);
  read_depth(shadow, light);
  read_variance(shadow, light.shadow);
  read_ground(json, shadow, faults, light.shadow);
  read_silhouette(shadow, light.shadow);
  read_warp(shadow, light);
  read_layout(shadow, light);
  read_cascades(shadow, light.shadow);
  read_darkness(shadow, light.shadow);
  warn_of_unread_settings(shadow, light.shadow);
  shadow.report_unknown_members("a shadow");
}

}  // namespace laterna
