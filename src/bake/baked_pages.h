// Pages of luxels with their light, and the scene that shows it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bake/light_map_layout.h"
#include "laterna/image.h"
#include "laterna/scene.h"

namespace laterna::bake {

/// Null where there is none.
struct BakedPage {
  std::shared_ptr<Image> front, back;  ///< RGB, single precision: irradiance in lux
  std::shared_ptr<Image> occlusion;    ///< 8 bits
  std::vector<std::uint8_t> is_found;  ///< by luxel: 1, a surface reads it
};

/// Surfaces get light maps, and occlusion textures where there are any. The pages' pictures go to the scene.
void show_as_light_maps(Scene& scene, const LightMapLayout& layout, std::vector<BakedPage>& pages);

/// Surfaces shine as the pages say: front and back are the radiance that is seen, 8-bit sRGB. They reflect nothing any more
/// (KHR_materials_specular takes what glTF's plain surfaces mirror). Of double-sided surfaces on pages with backs, the backs
/// become surfaces of their own.
void show_as_emission(Scene& scene, const LightMapLayout& layout, std::vector<BakedPage>& pages);

/// Everything that the pages do not hold, as the pages were exposed: lights and the environment, which other surfaces still
/// reflect, what these give off, the background, and colours that need no light, up to white. `exposure`: a factor.
void expose(Scene& scene, const LightMapLayout& layout, float exposure);

/// Lights that were baked are taken out, unless surfaces show their slides as paint: these stay, and are off.
void remove_lights(Scene& scene, const std::vector<bool>& is_baked);

}  // namespace laterna::bake
