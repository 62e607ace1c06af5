#include "laterna/blend.h"

#include <array>

namespace laterna {
namespace {

constexpr std::array<BlendModeDescription, 11> kModes = {{
    {BlendMode::over, "over", "t", "the layer covers what is below, as far as its alpha says", "GL_DECAL"},
    {BlendMode::modulate, "modulate", "c t", "a filter: white changes nothing, black is black",
     "GL_MODULATE"},
    {BlendMode::add, "add", "c + t", "one light and another", "GL_ADD"},
    {BlendMode::alpha_attenuate, "alpha_attenuate", "c a", "the layer's alpha alone darkens what is below",
     "glBlendFunc(GL_ZERO, GL_SRC_ALPHA)"},
    {BlendMode::subtract, "subtract", "max(c - t, 0)", "the layer is taken away from what is below",
     "GL_SUBTRACT_ARB of a texture; GL_FUNC_REVERSE_SUBTRACT of a pass"},
    {BlendMode::reverse_subtract, "reverse_subtract", "max(t - c, 0)",
     "what is below is taken away from the layer", "GL_FUNC_SUBTRACT of a pass"},
    {BlendMode::difference, "difference", "|c - t|", "how far they are apart: equal colours are black",
     "GL_DIFFERENCE_KHR"},
    {BlendMode::screen, "screen", "c + t - min(c, 1) min(t, 1)",
     "a filter of darkness: black changes nothing, white is white",
     "GL_SCREEN_KHR; glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_COLOR)"},
    {BlendMode::min, "min", "min(c, t)", "the darker of the two, channel by channel", "GL_MIN"},
    {BlendMode::max, "max", "max(c, t)", "the brighter of the two, channel by channel", "GL_MAX"},
    {BlendMode::dot3, "dot3", "4 sum (c - 1/2)(t - 1/2), 0 to 1",
     "two directions kept as colours, and the cosine between them in grey", "GL_DOT3_RGB"},
}};

}  // namespace

std::span<const BlendModeDescription> list_blend_modes() { return kModes; }

std::string_view find_light_fault(BlendMode mode) {
  if (mode == BlendMode::over || mode == BlendMode::alpha_attenuate)
    return "light has no alpha: only layers of surfaces have this mode";
  return mode > BlendMode::dot3 ? "there is no such mode" : "";
}

}  // namespace laterna
