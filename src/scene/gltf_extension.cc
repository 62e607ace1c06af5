#include "scene/gltf_extension.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "scene/json_object.h"
#include "scene/spelling.h"

namespace laterna::gltf {
namespace {

constexpr std::array<std::string_view, 28> kRead = {
    "EXT_lights_ies",
    "EXT_lights_image_based",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "KHR_animation_pointer",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "LATERNA_light_map",
    "LATERNA_lighting",
    "LATERNA_mirror",
    "LATERNA_projector",
    "LATERNA_relief",
    // Safe to leave out: they hold alternatives or descriptions of what is read anyway.
    "KHR_materials_variants",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "EXT_mesh_features",
};

struct LookChanger {
  std::string_view name, what;
};

constexpr std::array<LookChanger, 11> kChangeTheLook = {{
    {"KHR_materials_diffuse_transmission", "thin materials let no light through"},
    {"KHR_materials_dispersion", "glass has no colour fringes"},
    {"KHR_materials_pbrSpecularGlossiness",
     "materials are approximated: the diffuse colour becomes the base colour"},
    {"KHR_texture_basisu", "textures fall back on their PNG or JPEG, where there is one"},
    {"EXT_texture_webp", "textures fall back on their PNG or JPEG, where there is one"},
    {"EXT_texture_avif", "textures fall back on their PNG or JPEG, where there is one"},
    {"MSFT_texture_dds", "textures fall back on their PNG or JPEG, where there is one"},
    {"KHR_lights_image_based", "the environment light is left out"},
    {"KHR_node_visibility", "hidden nodes are shown"},
    {"KHR_materials_common", "materials have their standard look"},
    {"KHR_techniques_webgl", "materials have their standard look"},
}};

void check_version(const JsonDocument& json, FaultList& faults) {
  JsonObject root(json, json.root(), faults);
  if (!root.require("asset")) return;
  const JsonValue* asset = root.object("asset");
  if (asset == nullptr) return;
  JsonObject object(json, *asset, faults);
  object.require("version");
  const std::optional<std::string> version = object.string("version");
  if (version && version->substr(0, 2) != "2.") {
    object.error("version", fmt::format("glTF {} is not supported; expected 2.0", in_quotes(*version)));
  }
  const std::optional<std::string> least = object.string("minVersion");
  if (least && *least != "2.0") {
    object.error("minVersion", fmt::format("the file needs glTF {}; supported is 2.0", in_quotes(*least)));
  }
}

void check_required(const JsonDocument& json, FaultList& faults) {
  JsonObject root(json, json.root(), faults);
  const JsonValue* list = root.array("extensionsRequired");
  if (list == nullptr) return;
  for (const JsonValue& name : list->children) {
    if (name.kind != JsonValue::Kind::string) {
      faults.error(json.place(name), fmt::format("expected a string, got {}", describe(name)));
    } else if (std::find(kRead.begin(), kRead.end(), name.text) == kRead.end()) {
      faults.error(json.place(name), fmt::format("the file requires the extension {}, which is not supported",
                                                 in_quotes(name.text)));
    }
  }
}

void warn_about_used(const JsonDocument& json, FaultList& faults) {
  JsonObject root(json, json.root(), faults);
  const JsonValue* list = root.array("extensionsUsed");
  if (list == nullptr) return;
  for (const JsonValue& name : list->children) {
    const auto* found = std::find_if(kChangeTheLook.begin(), kChangeTheLook.end(),
                                     [&](const LookChanger& changer) { return changer.name == name.text; });
    if (found == kChangeTheLook.end()) continue;
    faults.warning(json.place(name), fmt::format("{} is not fully supported: {}", found->name, found->what));
  }
}

}  // namespace

const JsonValue* find_extension(const JsonValue& value, std::string_view name) {
  const JsonValue* extensions = value.find("extensions");
  return extensions == nullptr ? nullptr : extensions->find(name);
}

void check_requirements(const JsonDocument& json, FaultList& faults) {
  check_version(json, faults);
  check_required(json, faults);
  warn_about_used(json, faults);
}

}  // namespace laterna::gltf
