#include "scene/gltf_light_map.h"

#include <fmt/format.h>

#include "scene/gltf_extension.h"

namespace laterna::gltf {
namespace {

// Between luxels light changes evenly; there are no levels to choose from, in which surfaces would mix that are neighbours
// only in the picture.
constexpr Sampler kLuxels = {Wrap::clamp, Wrap::clamp, Filter::linear, Filter::linear, MipFilter::none};

constexpr int kUsualUvSet = 1;

}  // namespace

void read_light_map(const JsonDocument& json, const JsonValue& material, Textures& textures,
                    FaultList& faults, LightMap& light_map) {
  const JsonValue* extension = find_extension(material, kLightMapExtension);
  if (extension == nullptr) return;
  JsonObject object(json, *extension, faults);
  const auto uv_set = static_cast<int>(object.whole("texCoord", 0, 1).value_or(kUsualUvSet));
  const auto read = [&](std::string_view name) {
    Texture texture;
    texture.picture = textures.read_picture(object, name);
    texture.sampler = kLuxels;
    texture.uv_set = uv_set;
    return texture.is_set() ? texture : Texture{};
  };
  object.require("front");
  light_map.front = read("front");
  light_map.back = read("back");
  light_map.intensity = static_cast<float>(object.number("intensity", {0, kMaxRadiance}).value_or(1));
  object.report_unknown_members(kLightMapExtension);
}

Result<void> write_light_map(const LightMap& light_map, PictureWriter& pictures, Document& document,
                             Json& material) {
  Json json = Json::object();
  for (const auto& [name, texture] : {std::pair("front", &light_map.front), {"back", &light_map.back}}) {
    if (!texture->is_set()) continue;
    Result<Json> picture = pictures.slide(texture->picture);
    if (!picture) return tl::unexpected(std::move(picture.error()));
    json[name] = std::move(*picture);
  }
  set_unless(json, "texCoord", light_map.front.uv_set, kUsualUvSet);
  set_unless(json, "intensity", shortest(light_map.intensity), 1.0);
  document.extend(material, kLightMapExtension, std::move(json));
  return {};
}

}  // namespace laterna::gltf
