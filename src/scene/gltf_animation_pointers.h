// What KHR_animation_pointer calls that which clips move.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "laterna/animation.h"

namespace laterna::gltf {

enum class AnimatedKind : std::uint8_t { node, mesh, camera, light, material };

struct NamedProperty {
  std::string_view path;
  AnimatedProperty property;
  int texture = 0;  ///< as in ClipChannel
};

/// What a path from a node, mesh, camera, light or material leads to; nothing: it cannot be animated.
std::optional<NamedProperty> find_property(AnimatedKind kind, std::string_view path);
/// The path to a property; empty: there is none. `texture` as in ClipChannel; `is_orthographic`: of cameras.
std::string property_path(AnimatedKind kind, AnimatedProperty property, int texture, bool is_orthographic);

/// Where lights that are no projectors keep their lumens; projectors, in LATERNA_projector, as property_path() has it.
inline constexpr std::string_view kFluxOfOtherLights = "extensions/LATERNA_lighting/luminousFlux";

/// Textures of glTF's own; those of lobes follow.
inline constexpr std::size_t kPlainTextures = 5;
/// A material's texture by its number, as it is reached from the material.
std::string texture_pointer(std::size_t number);

}  // namespace laterna::gltf
