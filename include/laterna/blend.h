// How a layer of colour combines with what lies below it: layers of surfaces (SurfaceLayer), and projectors that do more
// to the light of those before them than add to it (Light::blend). docs/blend.md
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace laterna {

/// What becomes of a colour c below under a layer of colour t and alpha a (MIT 6.837, lecture 20, slide 17: texture
/// modulation, alpha attenuation, additive textures, weird modes). All is linear light, channel by channel, and held to no
/// most: bright stays bright. With f the mode's formula and k = opacity · a the result is c (1 − k) + f k.
enum class BlendMode : std::uint8_t {
  over,              ///< t
  modulate,          ///< c t
  add,               ///< c + t
  alpha_attenuate,   ///< c a; k is the opacity alone, and t is not looked at
  subtract,          ///< max(c − t, 0)
  reverse_subtract,  ///< max(t − c, 0)
  difference,        ///< |c − t|
  screen,            ///< c + t − min(c, 1) min(t, 1): for colours up to 1 that is 1 − (1 − c)(1 − t)
  min,               ///< the darker
  max,               ///< the brighter
  /// 4 Σ (c − ½)(t − ½) over R, G and B, held to [0, 1], in all three: the dot product of two directions that are kept as
  /// colours
  dot3,
};

struct BlendModeDescription {
  BlendMode mode;
  std::string_view name;     ///< in rigs
  std::string_view formula;  ///< f
  std::string_view meaning;
  std::string_view known_as;  ///< what OpenGL calls it
};
/// In the order of the enumeration.
std::span<const BlendModeDescription> list_blend_modes();

/// Why a projector's light cannot combine in this way with the light of those before it; empty where it can. Light has no
/// alpha: `over` and `alpha_attenuate` are for surfaces.
std::string_view find_light_fault(BlendMode mode);

}  // namespace laterna
