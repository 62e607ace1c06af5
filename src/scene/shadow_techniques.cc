#include "laterna/technique_choice.h"

namespace laterna {
namespace {

constexpr TechniqueDescription kTechniques[] = {
    {ShadowTechnique::none, "none", "light passes through everything"},
    {ShadowTechnique::ground, "ground",
     "shadow polygons on the floor, or on planes that are named: sharp, no maps, but nothing else is shaded"},
    {ShadowTechnique::silhouette, "silhouette",
     "each object's silhouette thrown on the objects behind it: no depths, so none shades itself"},
    {ShadowTechnique::map, "map",
     "shadow maps, biased by the receiver's plane and the texel's footprint (default)"},
    {ShadowTechnique::pcss, "pcss",
     "soft shadows by the light's size: maps filtered as wide as each penumbra"},
    {ShadowTechnique::variance, "variance", "maps of moments of depth, filtered like textures: smooth edges"},
    {ShadowTechnique::cascades, "cascades",
     "several shadow maps for a sun, finer toward the camera: for scenes much larger than what is near"},
    {ShadowTechnique::volume, "volume",
     "shadow volumes counted along each line of sight: slow, exact, a second reference"},
    {ShadowTechnique::exact, "exact",
     "hard shadows to the last bit: every sample against every triangle in its way, without a map"},
    {ShadowTechnique::raytraced, "raytraced",
     "hard shadows by rays: slow, exact, the reference for the others"},
};

}  // namespace

std::span<const TechniqueDescription> list_techniques() { return kTechniques; }

std::string find_fault(ShadowTechnique technique, const Light& light) {
  if (technique == ShadowTechnique::pcss && light.type == LightType::projector &&
      light.projection.is_orthographic && light.source.has_size()) {
    return "\"pcss\" cannot serve a parallel projector with a size: all its light goes one way";
  }
  if (technique == ShadowTechnique::cascades && light.type != LightType::directional)
    return "cascades serve directional lights only";
  for (const TechniqueDescription& known : kTechniques) {
    if (known.technique == technique) return "";
  }
  return "there is no such shadow technique";
}

ShadowTechnique technique_for(const Light& light, ShadowTechnique of_picture) {
  if (light.shadow.technique) return *light.shadow.technique;
  return find_fault(of_picture, light).empty() ? of_picture : ShadowTechnique::map;
}

std::string find_fault(ShadowDepth depth, const Light& light) {
  if (depth != ShadowDepth::radial || !is_parallel(light)) return "";
  return "radial depths are distances from the light, and parallel light comes from nowhere: use \"planar\"";
}

std::string find_fault(ShadowWarp warp, const Light& light) {
  if (warp == ShadowWarp::none) return "";
  if (light.type != LightType::directional || !light.fit)
    return "only the map of a directional light that is fitted to the scene can be warped";
  const ShadowTechnique technique = light.shadow.technique.value_or(ShadowTechnique::map);
  return technique == ShadowTechnique::map ? "" : "only the technique \"map\" has a warp";
}

bool is_parallel(const Light& light) {
  return light.type == LightType::directional ||
         (light.type == LightType::projector && light.projection.is_orthographic);
}

bool has_frustum(const Light& light) {
  return light.type == LightType::projector || (light.type == LightType::directional && !light.fit);
}

bool shines_all_round(const Light& light) {
  return light.type == LightType::point ||
         (light.type == LightType::spot && light.outer_cone.in_degrees() > kWidestSingleMap);
}

std::string find_fault(ShadowLayout layout, const Light& light) {
  if (layout == ShadowLayout::cube) return "";
  if (!shines_all_round(light))
    return "only point lights and spots wider than 150 degrees have maps of all directions: others have one "
           "map";
  if (light.shadow.filter == ShadowFilter::averaged_depths)
    return "\"averaged_depths\" means depths along one axis, and these maps have none: use \"cube\"";
  return "";
}

}  // namespace laterna
