#include "scene/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/gltf_extension.h"
#include "scene/gltf_light_map.h"
#include "scene/gltf_lobes.h"
#include "scene/gltf_mirror.h"
#include "scene/gltf_relief.h"

namespace laterna::gltf {
namespace {

// Exporters write 1.0000001 and worse; the nearest allowed value is what they meant.
double limited(JsonObject& object, std::string_view name, double value, double most) {
  const double allowed = std::clamp(value, 0.0, most);
  if (allowed != value)
    object.warning(name, fmt::format("{} is out of range and taken as {}", value, allowed));
  return allowed;
}

float factor(JsonObject& object, std::string_view name, double fallback, double most = 1) {
  const std::optional<double> value = object.number(name);
  return static_cast<float>(value ? limited(object, name, *value, most) : fallback);
}

template <std::size_t N>
std::array<double, N> color(JsonObject& object, std::string_view name, double fallback, double most = 1) {
  std::array<double, N> values;
  values.fill(fallback);
  if (const auto read = object.numbers<N>(name)) values = *read;
  for (double& value : values) value = limited(object, name, value, most);
  return values;
}

glm::vec4 to_vec4(const std::array<double, 4>& v) { return glm::vec4(v[0], v[1], v[2], v[3]); }

// Far above any real emitter; their product, and products with it, stay finite in single precision.
constexpr double kMaxEmissive = 1e6, kMaxStrength = 1e6;

void read_metallic_roughness(JsonObject& material, const JsonDocument& json, Textures& textures,
                             FaultList& faults, Material& result) {
  const JsonValue* value = material.object("pbrMetallicRoughness");
  if (value == nullptr) return;
  JsonObject pbr(json, *value, faults);
  result.base_color = to_vec4(color<4>(pbr, "baseColorFactor", 1));
  result.base_color_texture = textures.read(pbr, "baseColorTexture", result.name);
  result.metallic = factor(pbr, "metallicFactor", 1);
  result.roughness = factor(pbr, "roughnessFactor", 1);
  result.metallic_roughness_texture = textures.read(pbr, "metallicRoughnessTexture", result.name);
}

// The archived extension: a diffuse colour and glossiness. Its specular colour has no place in our model, so
// the surface becomes a non-metal of the same diffuse colour. A file's own metallic-roughness values are
// preferred.
void read_specular_glossiness(const JsonDocument& json, const JsonValue& extension, Textures& textures,
                              FaultList& faults, Material& result) {
  JsonObject object(json, extension, faults);
  result.base_color = to_vec4(color<4>(object, "diffuseFactor", 1));
  result.base_color_texture = textures.read(object, "diffuseTexture", result.name);
  result.metallic = 0;
  result.roughness = 1 - factor(object, "glossinessFactor", 1);
}

void read_normal_and_occlusion(JsonObject& material, const JsonDocument& json, Textures& textures,
                               FaultList& faults, Material& result) {
  result.normal_texture = textures.read(material, "normalTexture", result.name);
  if (const JsonValue* value = material.object("normalTexture")) {
    JsonObject info(json, *value, faults);
    result.normal_scale = static_cast<float>(info.number("scale", {-1e6, 1e6}).value_or(1));
  }
  result.occlusion_texture = textures.read(material, "occlusionTexture", result.name);
  if (const JsonValue* value = material.object("occlusionTexture")) {
    JsonObject info(json, *value, faults);
    result.occlusion_strength = factor(info, "strength", 1);
  }
}

void read_emission(JsonObject& material, const JsonDocument& json, Textures& textures, FaultList& faults,
                   Material& result) {
  double strength = 1;
  if (const JsonValue* extension = find_extension(material.value(), "KHR_materials_emissive_strength")) {
    JsonObject object(json, *extension, faults);
    strength = factor(object, "emissiveStrength", 1, kMaxStrength);
  }
  const auto emissive = color<3>(material, "emissiveFactor", 0, kMaxEmissive);
  result.emissive = glm::vec3(emissive[0] * strength, emissive[1] * strength, emissive[2] * strength);
  result.emissive_texture = textures.read(material, "emissiveTexture", result.name);
}

}  // namespace

Material read_material(const JsonDocument& json, const JsonValue& value, Textures& textures,
                       FaultList& faults) {
  JsonObject object(json, value, faults);
  Material material;
  material.name = object.string("name").value_or("");
  const JsonValue* glossiness = find_extension(value, "KHR_materials_pbrSpecularGlossiness");
  // Exporters write an empty pbrMetallicRoughness beside it.
  const JsonValue* metallic = value.find("pbrMetallicRoughness");
  const bool has_metallic = metallic != nullptr && !(metallic->is_object() && metallic->children.empty());
  if (glossiness != nullptr && !has_metallic) {
    object.any("pbrMetallicRoughness");
    read_specular_glossiness(json, *glossiness, textures, faults, material);
  } else {
    read_metallic_roughness(object, json, textures, faults, material);
  }
  read_normal_and_occlusion(object, json, textures, faults, material);
  read_emission(object, json, textures, faults, material);
  const auto mode = object.choice<AlphaMode>(
      "alphaMode", {{"OPAQUE", AlphaMode::opaque}, {"MASK", AlphaMode::mask}, {"BLEND", AlphaMode::blend}});
  material.alpha_mode = mode.value_or(AlphaMode::opaque);
  material.alpha_cutoff =
      factor(object, "alphaCutoff", 0.5, 2);  // above 1: nothing is left, as the standard says
  material.double_sided = object.boolean("doubleSided").value_or(false);
  read_light_map(json, value, textures, faults, material.light_map);
  material.unlit = find_extension(value, "KHR_materials_unlit") != nullptr;
  read_lobes(json, value, textures, faults, material);
  material.relief = read_relief(json, value, textures, material.name, faults);
  material.mirror = read_mirror(json, value, material.alpha_mode, faults);
  return material;
}

Materials::Materials(const JsonDocument& json, Textures& textures, FaultList& faults)
    : json_(json), textures_(textures), faults_(faults) {
  JsonObject root(json, json.root(), faults);
  const JsonValue* list = root.array("materials");
  if (list == nullptr) return;
  for (const JsonValue& value : list->children) values_.push_back(&value);
  index_of_.assign(values_.size(), -1);
}

int Materials::use(int material) {
  if (material < 0) return -1;
  int& index = index_of_[static_cast<std::size_t>(material)];
  if (index < 0) {
    index = static_cast<int>(materials_.size());
    materials_.push_back(
        read_material(json_, *values_[static_cast<std::size_t>(material)], textures_, faults_));
  }
  return index;
}

}  // namespace laterna::gltf
