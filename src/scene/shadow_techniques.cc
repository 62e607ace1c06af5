#include <array>

#include "laterna/scene.h"

namespace laterna {
namespace {

constexpr std::array<TechniqueDescription, 5> kTechniques = {{
    {ShadowTechnique::none, "none", "light passes through everything"},
    {ShadowTechnique::map, "map",
     "shadow maps, biased by the receiver's plane and the texel's footprint (default)"},
    {ShadowTechnique::cascades, "cascades",
     "several shadow maps for a sun, finer toward the camera: for scenes much larger than what is near"},
    {ShadowTechnique::exact, "exact",
     "hard shadows to the last bit: every sample against every triangle in its way, without a map"},
    {ShadowTechnique::raytraced, "raytraced",
     "hard shadows by rays: slow, exact, the reference for the others"},
}};

}  // namespace

std::span<const TechniqueDescription> list_techniques() { return kTechniques; }

std::string find_fault(ShadowTechnique technique, const Light& light) {
  if (technique == ShadowTechnique::cascades && light.type != LightType::directional)
    return "cascades share out the parallel light of a directional light: other lights have \"map\"";
  for (const TechniqueDescription& known : kTechniques) {
    if (known.technique == technique) return "";
  }
  return "there is no such shadow technique";
}

std::string find_fault(ShadowWarp warp, const Light& light) {
  if (warp == ShadowWarp::none) return "";
  if (light.type != LightType::directional || !light.fit)
    return "only the map of a directional light that is fitted to the scene can be warped";
  const ShadowTechnique technique = light.shadow.technique.value_or(ShadowTechnique::map);
  return technique == ShadowTechnique::map ? "" : "only the technique \"map\" has a warp";
}

}  // namespace laterna
