#include "scene/gltf_animation_pointers.h"

#include <fmt/format.h>

#include <array>
#include <span>

#include "scene/lobe_factors.h"

namespace laterna::gltf {
namespace {

using P = AnimatedProperty;

constexpr NamedProperty kOfNode[] = {{"translation", P::translation},
                                     {"rotation", P::rotation},
                                     {"scale", P::scale},
                                     {"weights", P::weights},
                                     {"extensions/LATERNA_lighting/look_at", P::look_at}};
constexpr NamedProperty kOfMesh[] = {{"weights", P::weights}};
constexpr NamedProperty kOfCamera[] = {
    {"perspective/yfov", P::yfov},      {"perspective/aspectRatio", P::aspect},
    {"perspective/znear", P::near},     {"perspective/zfar", P::far},
    {"orthographic/xmag", P::x_extent}, {"orthographic/ymag", P::y_extent},
    {"orthographic/znear", P::near},    {"orthographic/zfar", P::far}};
constexpr NamedProperty kOfLight[] = {{"color", P::light_color},
                                      {"intensity", P::intensity},
                                      {"range", P::range},
                                      {"spot/innerConeAngle", P::inner_cone},
                                      {"spot/outerConeAngle", P::outer_cone},
                                      {"extensions/LATERNA_projector/yfov", P::yfov},
                                      {"extensions/LATERNA_projector/aspectRatio", P::aspect},
                                      {"extensions/LATERNA_projector/znear", P::near},
                                      {"extensions/LATERNA_projector/zfar", P::far},
                                      {"extensions/LATERNA_projector/luminousFlux", P::lumens},
                                      {kFluxOfOtherLights, P::lumens}};
constexpr NamedProperty kOfMaterial[] = {
    {"pbrMetallicRoughness/baseColorFactor", P::base_color},
    {"pbrMetallicRoughness/metallicFactor", P::metallic},
    {"pbrMetallicRoughness/roughnessFactor", P::roughness},
    {"emissiveFactor", P::emissive},
    {"extensions/KHR_materials_emissive_strength/emissiveStrength", P::emissive_strength},
    {"alphaCutoff", P::alpha_cutoff},
    {"normalTexture/scale", P::normal_scale},
    {"occlusionTexture/strength", P::occlusion_strength}};
constexpr std::array<std::string_view, kPlainTextures> kTextures = {
    "pbrMetallicRoughness/baseColorTexture", "pbrMetallicRoughness/metallicRoughnessTexture", "normalTexture",
    "occlusionTexture", "emissiveTexture"};
constexpr NamedProperty kOfTexture[] = {{"/extensions/KHR_texture_transform/offset", P::texture_offset},
                                        {"/extensions/KHR_texture_transform/rotation", P::texture_rotation},
                                        {"/extensions/KHR_texture_transform/scale", P::texture_scale}};

// "extensions/KHR_materials_ior/ior" and the like.
std::string pointer_of(std::string_view extension, std::string_view member) {
  return fmt::format("extensions/{}/{}", extension, member);
}

// Texture transforms of a material, and what its lobes have; `path` leads from the material.
std::optional<NamedProperty> find_material_property(std::string_view path) {
  for (const LobeFactor& factor : lobe_factors()) {
    if (path == pointer_of(factor.extension, factor.member)) return NamedProperty{path, factor.property};
  }
  const auto is_below = [&](std::string_view texture) { return path.substr(0, texture.size()) == texture; };
  const auto find_transform = [&](std::string_view texture,
                                  std::size_t number) -> std::optional<NamedProperty> {
    for (const NamedProperty& property : kOfTexture) {
      if (property.path == path.substr(texture.size()))
        return NamedProperty{property.path, property.property, static_cast<int>(number)};
    }
    return std::nullopt;
  };
  for (std::size_t i = 0; i < kPlainTextures; ++i) {
    if (is_below(kTextures[i])) return find_transform(kTextures[i], i);
  }
  for (std::size_t i = 0; i < kLobeTextures; ++i) {
    const std::string texture = pointer_of(lobe_textures()[i].extension, lobe_textures()[i].member);
    if (is_below(texture + "/")) return find_transform(texture, kPlainTextures + i);
  }
  return std::nullopt;
}

std::span<const NamedProperty> plain_properties(AnimatedKind kind) {
  switch (kind) {
    case AnimatedKind::node:
      return kOfNode;
    case AnimatedKind::mesh:
      return kOfMesh;
    case AnimatedKind::camera:
      return kOfCamera;
    case AnimatedKind::light:
      return kOfLight;
    case AnimatedKind::material:
      break;
  }
  return kOfMaterial;
}

}  // namespace

std::string texture_pointer(std::size_t number) {
  if (number < kPlainTextures) return std::string(kTextures[number]);
  const LobeTexture& texture = lobe_textures()[number - kPlainTextures];
  return pointer_of(texture.extension, texture.member);
}

std::optional<NamedProperty> find_property(AnimatedKind kind, std::string_view path) {
  for (const NamedProperty& property : plain_properties(kind)) {
    if (property.path == path) return property;
  }
  return kind == AnimatedKind::material ? find_material_property(path) : std::nullopt;
}

std::string property_path(AnimatedKind kind, P property, int texture, bool is_orthographic) {
  for (const NamedProperty& plain : plain_properties(kind)) {
    const bool is_other_lens =
        kind == AnimatedKind::camera && plain.path.starts_with("orthographic") != is_orthographic;
    if (plain.property == property && !is_other_lens) return std::string(plain.path);
  }
  if (kind != AnimatedKind::material) return {};
  for (const NamedProperty& transform : kOfTexture) {
    if (transform.property == property)
      return texture_pointer(static_cast<std::size_t>(texture)) + std::string(transform.path);
  }
  const LobeFactor* factor = find_lobe_factor(property);
  return factor == nullptr ? std::string() : pointer_of(factor->extension, factor->member);
}

}  // namespace laterna::gltf
