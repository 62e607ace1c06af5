// Where every surface of a scene lies in the light maps.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "laterna/bake.h"
#include "laterna/scene.h"

namespace laterna::bake {

/// A light map's picture, before there is light in it.
struct LightMapPage {
  glm::ivec2 size{0};     ///< luxels
  bool has_back = false;  ///< some of its surfaces are seen from behind
};

struct LightMapLayout {
  std::vector<LightMapPage> pages;
  std::vector<int> page_of_material;  ///< of the scene's materials; −1: has no light map
  std::size_t surfaces = 0, charts = 0;
  double used = 0;  ///< the surfaces' share of the pages' area
  double least_density = 0, greatest_density = 0;
  std::size_t thin_triangles = 0;  ///< which these leave out
};

/// Whether its surfaces can show a light map: what has no light to reflect (unlit) and glass, which shows what lies behind,
/// cannot.
bool can_have_light_map(const Material& material);

/// Changes the scene such that every instance of a mesh has a mesh of its own, and every primitive that is to be baked second
/// texture coordinates that are its own place in a page, and a material that no primitive of another page has. Warnings are
/// added to the scene's. Error: more than kMostLuxels or kMostLightMaps, or a triangle that is too large for a page.
Result<LightMapLayout> lay_out(Scene& scene, const BakeSettings& settings);

}  // namespace laterna::bake
