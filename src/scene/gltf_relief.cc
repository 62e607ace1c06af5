#include "scene/gltf_relief.h"

#include "scene/gltf_extension.h"
#include "scene/gltf_setting_writer.h"
#include "scene/relief_settings.h"

namespace laterna::gltf {

std::shared_ptr<const Relief> read_relief(const JsonDocument& json, const JsonValue& material,
                                          Textures& textures, const std::string& name, FaultList& faults) {
  const JsonValue* extension = find_extension(material, kReliefExtension);
  if (extension == nullptr) return nullptr;
  JsonObject object(json, *extension, faults, kGltfNames);
  if (!object.value().is_object()) return nullptr;
  Relief relief;
  object.require("texture");
  relief.texture = textures.read(object, "texture", name);
  read_relief_settings(object, relief);
  for (const std::string_view known : {"extensions", "extras"}) (void)object.any(known);
  object.report_unknown_members("a relief");
  if (!relief.texture.is_set()) return nullptr;
  return std::make_shared<const Relief>(relief);
}

Json relief_json(const Relief& relief) {
  const Relief usual;
  Json json = Json::object();
  set(json, "depth", relief.depth);
  if (relief.kind != usual.kind) set(json, "kind", word("depth"));
  if (relief.self_shadow != usual.self_shadow) set(json, "self_shadow", relief.self_shadow);
  if (relief.cut_edges != usual.cut_edges) set(json, "cut_edges", relief.cut_edges);
  return json;
}

}  // namespace laterna::gltf
