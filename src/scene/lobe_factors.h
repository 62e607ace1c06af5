// The numbers and pictures of material lobes, in one table: how files and messages name each, what it may be, where it is.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "laterna/animation.h"
#include "laterna/material_lobes.h"

namespace laterna {

struct LobeFactor {
  AnimatedProperty property;
  std::string_view extension, member;  ///< of a glTF material; members of a textureInfo as "texture/scale"
  std::string_view field;              ///< of MaterialLobes, for messages
  int components;
  float low, high;
  const float* (*first)(const MaterialLobes& lobes);

  [[nodiscard]] std::span<const float> of(const MaterialLobes& lobes) const {
    return {first(lobes), static_cast<std::size_t>(components)};
  }
  [[nodiscard]] std::span<float> of(MaterialLobes& lobes) const {
    return {const_cast<float*>(first(lobes)),  // NOLINT(*-const-cast): of lobes that may be changed
            static_cast<std::size_t>(components)};
  }
  /// Whether this may stand for every component. Beside its range: ior 0, and an attenuation distance without end.
  [[nodiscard]] bool allows(double value) const;
  /// The nearest that it allows.
  [[nodiscard]] float nearest(double value) const;
};
std::span<const LobeFactor> lobe_factors();
/// Null: the property is of something else.
const LobeFactor* find_lobe_factor(AnimatedProperty property);

struct LobeTexture {
  std::string_view extension, member, field;
};
/// In the order of textures_of(MaterialLobes).
std::span<const LobeTexture, kLobeTextures> lobe_textures();

/// Brings `values` to what the factor allows and sets it; whatever else shares the material's lobes keeps what it has.
void set_lobe_factor(Material& material, const LobeFactor& factor, std::span<const double> values);
/// Texture number 0 … kLobeTextures − 1 of a material that has lobes, to be changed.
Texture& lobe_texture_of(Material& material, std::size_t number);

}  // namespace laterna
