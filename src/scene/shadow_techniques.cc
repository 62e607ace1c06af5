#include <array>

#include "laterna/scene.h"

namespace laterna {
namespace {

constexpr std::array<TechniqueDescription, 6> kTechniques = {{
    {ShadowTechnique::none, "none", "light passes through everything"},
    {ShadowTechnique::ground, "ground",
     "shadow polygons on the floor, or on planes that are named: sharp, no maps, but nothing else is shaded"},
    {ShadowTechnique::silhouette, "silhouette",
     "each object's silhouette thrown on the objects behind it: no depths, so none shades itself"},
    {ShadowTechnique::map, "map",
     "shadow maps, biased by the receiver's plane and the texel's footprint (default)"},
    {ShadowTechnique::exact, "exact",
     "hard shadows to the last bit: every sample against every triangle in its way, without a map"},
    {ShadowTechnique::raytraced, "raytraced",
     "hard shadows by rays: slow, exact, the reference for the others"},
}};

}  // namespace

std::span<const TechniqueDescription> list_techniques() { return kTechniques; }

std::string find_fault(ShadowTechnique technique, const Light& light) {
  static_cast<void>(light);
  for (const TechniqueDescription& known : kTechniques) {
    if (known.technique == technique) return "";
  }
  return "there is no such shadow technique";
}

}  // namespace laterna
