#include "scene/gltf_material_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <optional>

#include "scene/gltf_light_map.h"
#include "scene/gltf_lobes.h"
#include "scene/gltf_mirror.h"
#include "scene/gltf_relief.h"
#include "scene/texture_transform.h"

namespace laterna::gltf {
namespace {

// Of KHR_materials_emissive_strength, as far as it is read: a power of two below a million.
constexpr float kMostStrength = 524288;

// One material. An error ends the whole file.
class MaterialWriter {
 public:
  MaterialWriter(PictureWriter& pictures, Document& document, std::string place)
      : pictures_(pictures), document_(document), place_(std::move(place)) {}

  Result<Json> write(const Material& material) {
    Json json;
    if (!material.name.empty()) json["name"] = material.name;
    const Material usual;
    Json pbr = Json::object();
    const glm::vec4 base = limited("base_color", material.base_color, 1);
    if (base != usual.base_color) pbr["baseColorFactor"] = components(base);
    set_texture(pbr, "baseColorTexture", material.base_color_texture);
    set_factor(pbr, "metallicFactor", "metallic", material.metallic, 1);
    set_factor(pbr, "roughnessFactor", "roughness", material.roughness, 1);
    set_texture(pbr, "metallicRoughnessTexture", material.metallic_roughness_texture);
    if (!pbr.empty()) json["pbrMetallicRoughness"] = std::move(pbr);
    set_texture(json, "normalTexture", material.normal_texture);
    if (json.contains("normalTexture"))
      set_unless(json["normalTexture"], "scale", shortest(material.normal_scale), 1.0);
    set_texture(json, "occlusionTexture", material.occlusion_texture);
    if (json.contains("occlusionTexture"))
      set_factor(json["occlusionTexture"], "strength", "occlusion_strength", material.occlusion_strength, 1);
    set_emission(json, material);
    set_texture(json, "emissiveTexture", material.emissive_texture);
    set_alpha(json, material);
    if (material.double_sided) json["doubleSided"] = true;
    if (material.light_map.front.is_set() && !fault_) {
      if (Result<void> written = write_light_map(material.light_map, pictures_, document_, json); !written)
        fault_ = std::move(written.error());
    }
    if (material.unlit) document_.extend(json, "KHR_materials_unlit", Json::object());
    write_lobes(material, document_, json, [this](Json& object, const char* name, const Texture& texture) {
      set_texture(object, name, texture);
    });
    set_relief(json, material);
    if (material.mirror != nullptr) document_.extend(json, kMirrorExtension, mirror_json(*material.mirror));
    if (fault_) return tl::unexpected(std::move(*fault_));
    if (json.is_null()) json = Json::object();
    return json;
  }

 private:
  template <class T>
  T limited(const char* name, const T& value, float most) {
    const T nearest = glm::clamp(value, 0.0F, most);
    if (nearest != value)
      document_.warn(place_ + "." + name, fmt::format("glTF holds 0 to {}: the nearest is written", most));
    return nearest;
  }

  void set_factor(Json& object, const char* name, const char* field, float value, float usual) {
    set_unless(object, name, shortest(limited(field, value, 1)), shortest(usual));
  }

  // The factor is at most 1 in glTF; a power of two makes up for it, so that the product is what it was.
  void set_emission(Json& json, const Material& material) {
    if (material.emissive == glm::vec3(0)) return;
    const float most = std::max({material.emissive.x, material.emissive.y, material.emissive.z});
    float strength = 1;
    while (strength < most && strength < kMostStrength) strength *= 2;
    json["emissiveFactor"] = components(material.emissive / strength);
    if (strength > 1) {
      document_.extend(json, "KHR_materials_emissive_strength", {{"emissiveStrength", shortest(strength)}});
    }
  }

  void set_alpha(Json& json, const Material& material) {
    if (material.alpha_mode == AlphaMode::opaque) return;
    json["alphaMode"] = material.alpha_mode == AlphaMode::mask ? "MASK" : "BLEND";
    if (material.alpha_mode == AlphaMode::mask)
      set_unless(json, "alphaCutoff", shortest(limited("alpha_cutoff", material.alpha_cutoff, 2)), 0.5);
  }

  void set_relief(Json& json, const Material& material) {
    if (material.relief == nullptr || !material.relief->texture.is_set()) return;
    Json relief = Json::object();
    set_texture(relief, "texture", material.relief->texture);
    relief.update(relief_json(*material.relief));
    document_.extend(json, kReliefExtension, std::move(relief));
  }

  void set_texture(Json& object, const char* name, const Texture& texture) {
    if (!texture.is_set() || fault_) return;
    Result<int> index = pictures_.texture(texture);
    if (!index) {
      fault_ = std::move(index.error());
      return;
    }
    Json info = {{"index", *index}};
    if (texture.uv_set != 0) info["texCoord"] = texture.uv_set;
    set_transform(info, texture, name);
    object[name] = std::move(info);
  }

  void set_transform(Json& info, const Texture& texture, const char* name) {
    const std::array<float, 6>& matrix = texture.uv_from_mesh_uv;
    if (matrix == Texture().uv_from_mesh_uv) return;
    const std::optional<TextureTransform> transform = decomposed(matrix);
    const std::string member = fmt::format("{}.{}", place_, name);
    if (!transform)
      return document_.warn(member,
                            "glTF cannot shear texture coordinates: they are left as the mesh has them");
    if (composed(*transform) != matrix)
      document_.warn(member, "the matrix of its texture coordinates comes back with other roundings");
    Json json = Json::object();
    if (transform->offset != glm::dvec2(0)) json["offset"] = components(glm::vec2(transform->offset));
    if (transform->rotation != 0) json["rotation"] = transform->rotation;
    if (transform->scale != glm::dvec2(1)) json["scale"] = {transform->scale.x, transform->scale.y};
    document_.extend(info, "KHR_texture_transform", std::move(json));
  }

  PictureWriter& pictures_;
  Document& document_;
  std::string place_;
  std::optional<Error> fault_;
};

}  // namespace

Result<void> write_materials(const Scene& scene, PictureWriter& pictures, Document& document) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    Result<Json> json =
        MaterialWriter(pictures, document, fmt::format("materials[{}]", i)).write(scene.materials[i]);
    if (!json) return tl::unexpected(std::move(json.error()));
    document.add("materials", std::move(*json));
  }
  return {};
}

}  // namespace laterna::gltf
