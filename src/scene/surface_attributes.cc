#include "scene/surface_attributes.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/material_lobes.h"
#include "scene/normals.h"
#include "scene/spelling.h"
#include "scene/tangents.h"
#include "scene/triangle_geometry.h"

namespace laterna {
namespace {

void complete_texture_coordinates(Primitive& primitive, const Material& material, const std::string& place,
                                  FaultList& faults) {
  for (const Texture* texture : textures_of(material)) {
    if (!texture->is_set()) continue;
    std::vector<glm::vec2>& uv = primitive.uv[static_cast<std::size_t>(texture->uv_set)];
    if (!uv.empty()) continue;
    faults.warning(
        place,
        fmt::format("material {} uses texture coordinates {}, which the mesh does not have: taken as (0, 0)",
                    in_quotes(material.name), texture->uv_set));
    uv.assign(primitive.positions.size(), glm::vec2(0));
  }
}

void repair_tangents(Primitive& primitive) {
  for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
    glm::vec4& tangent = primitive.tangents[i];
    const glm::dvec3 direction(tangent);
    // Of unit length already, to rounding: the file's bits are kept, as normals' are, so that what is written is what is read.
    if (std::abs(glm::dot(direction, direction) - 1) < 4e-6) {
      tangent.w = tangent.w < 0 ? -1.0F : 1.0F;
      continue;
    }
    tangent = glm::vec4(glm::vec3(unit_or(direction, any_perpendicular(glm::dvec3(primitive.normals[i])))),
                        tangent.w < 0 ? -1.0F : 1.0F);
  }
}

}  // namespace

std::vector<const Texture*> textures_of(const Material& material) {
  std::vector<const Texture*> textures = {&material.base_color_texture, &material.metallic_roughness_texture,
                                          &material.normal_texture,     &material.occlusion_texture,
                                          &material.emissive_texture,   &material.light_map.front,
                                          &material.light_map.back};
  if (material.lobes != nullptr) {
    for (const Texture* texture : textures_of(*material.lobes)) textures.push_back(texture);
  }
  for (const SurfaceLayer& layer : material.layers) textures.push_back(&layer.texture);
  return textures;
}

std::optional<int> tangent_uv_set(const Material& material) {
  if (material.normal_texture.is_set()) return material.normal_texture.uv_set;
  if (material.lobes == nullptr) return std::nullopt;
  const MaterialLobes& lobes = *material.lobes;
  if (lobes.clearcoat.normal_texture.is_set()) return lobes.clearcoat.normal_texture.uv_set;
  if (lobes.anisotropy.texture.is_set()) return lobes.anisotropy.texture.uv_set;
  return lobes.anisotropy.strength > 0 ? std::optional<int>(0) : std::nullopt;
}

void complete_moving_attributes(Primitive& primitive, const Material* material, const std::string& place,
                                FaultList& faults) {
  if (material != nullptr && tangent_uv_set(*material))
    return complete_attributes(primitive, material, std::nullopt, place, faults);
  if (material != nullptr) complete_texture_coordinates(primitive, *material, place, faults);
}

void complete_attributes(Primitive& primitive, const Material* material, std::optional<Angle> crease,
                         const std::string& place, FaultList& faults) {
  if (primitive.normals.empty()) {
    crease ? compute_smooth_normals(primitive, *crease) : compute_flat_normals(primitive);
  } else if (const std::size_t repaired = repair_normals(primitive); repaired > 0) {
    faults.warning(place, fmt::format("{} normals have no length: taken from the faces around", repaired));
  }
  repair_tangents(primitive);
  if (material == nullptr) return;
  complete_texture_coordinates(primitive, *material, place, faults);
  const std::optional<int> uv_set = tangent_uv_set(*material);
  if (!uv_set || !primitive.tangents.empty()) return;
  // Of a mesh without texture coordinates no direction is more along it than another.
  std::vector<glm::vec2>& uv = primitive.uv[static_cast<std::size_t>(*uv_set)];
  const bool is_made_up = uv.empty();
  if (is_made_up) uv.assign(primitive.positions.size(), glm::vec2(0));
  compute_tangents(primitive, *uv_set);
  if (is_made_up) uv.clear();
}

}  // namespace laterna
