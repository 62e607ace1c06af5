#include "scene/rig_terrain.h"

#include <utility>

#include "laterna/terrain.h"
#include "scene/json_object.h"
#include "scene/rig_ranges.h"
#include "scene/uri.h"

namespace laterna {
namespace {

constexpr double kMostRepeats = 1e6;

// The file that a member names. Nothing where it names none, or one that is not there.
std::optional<std::filesystem::path> read_file_name(JsonObject& object, std::string_view key,
                                                    const std::filesystem::path& folder) {
  const std::optional<std::string> name = object.string(key);
  if (!name) return std::nullopt;
  auto path = resolve_typed_file(folder, *name);
  if (path) return std::move(*path);
  object.error(key, path.error());
  return std::nullopt;
}

Material read_material(JsonObject& object, const std::filesystem::path& folder,
                       std::vector<Picture>& pictures) {
  Material material;
  if (const auto color = object.numbers<3>("color", kAmountOfLight))
    material.base_color = glm::vec4((*color)[0], (*color)[1], (*color)[2], 1);
  material.metallic = 0;
  material.roughness = static_cast<float>(object.number("roughness", kZeroToOne).value_or(1));
  const std::optional<std::filesystem::path> file = read_file_name(object, "texture", folder);
  const double repeats = object.number("texture_repeat", {0, kMostRepeats, true, false}).value_or(1);
  if (!file) return material;
  Texture& texture = material.base_color_texture;
  texture.picture = static_cast<int>(pictures.size());
  texture.uv_from_mesh_uv[0] = texture.uv_from_mesh_uv[4] = static_cast<float>(repeats);
  Picture picture;
  picture.file = *file;
  picture.name = file->string();
  pictures.push_back(std::move(picture));
  return material;
}

}  // namespace

void read_rig_terrain(const JsonDocument& json, const JsonValue& value, const std::filesystem::path& folder,
                      const std::string& name, Scene& scene, FaultList& faults) {
  const std::size_t errors_before = faults.error_count();
  JsonObject object(json, value, faults);
  if (!value.is_object()) return;
  Node node;
  node.name = object.string("name").value_or(name);
  if (node.name.empty()) object.error("name", "is empty");
  object.require_all({"heights", "size"});
  const std::optional<std::filesystem::path> heights = read_file_name(object, "heights", folder);
  const auto size = object.numbers<2>("size", kPositiveLength);
  const double height = object.number("height", kCoordinate).value_or(1);
  const double error = object.number("error", kLength).value_or(0);
  if (const auto place = object.numbers<3>("position", kCoordinate))
    node.parent_from_node[3] = glm::dvec4((*place)[0], (*place)[1], (*place)[2], 1);
  Material material = read_material(object, folder, scene.pictures);
  object.report_unknown_members("a terrain");
  if (!heights || !size || faults.error_count() != errors_before) return;
  const Result<HeightMap> map = read_height_map(*heights, height);
  if (!map) return object.error("heights", to_string(map.error()));
  Result<Primitive> surface = make_terrain(*map, {(*size)[0], (*size)[1], error});
  if (!surface) return object.error({}, to_string(surface.error()));
  material.name = node.name;
  surface->material = static_cast<int>(scene.materials.size());
  node.mesh = static_cast<int>(scene.meshes.size());
  scene.materials.push_back(std::move(material));
  Mesh mesh;
  mesh.name = node.name;
  mesh.primitives.push_back(std::move(*surface));
  scene.meshes.push_back(std::move(mesh));
  scene.nodes.push_back(std::move(node));
}

}  // namespace laterna
