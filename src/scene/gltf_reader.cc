#include "scene/gltf_reader.h"

#include <fmt/format.h>

#include <optional>

#include "scene/fault_list.h"
#include "scene/gltf_accessors.h"
#include "scene/gltf_animations.h"
#include "scene/gltf_buffers.h"
#include "scene/gltf_container.h"
#include "scene/gltf_environment.h"
#include "scene/gltf_extension.h"
#include "scene/gltf_lamps.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_materials.h"
#include "scene/gltf_meshes.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_skins.h"
#include "scene/gltf_textures.h"
#include "scene/json_document.h"
#include "scene/json_object.h"
#include "scene/scene_settings.h"
#include "scene/unique_names.h"

namespace laterna {
namespace gltf {
namespace {

// Hangs what the nodes refer to into the scene.
class SceneBuilder {
 public:
  struct Readers {
    Meshes& meshes;
    Accessors& accessors;
    Lamps& lamps;
    LightExtensions& light_extensions;
    Skins& skins;
    const Animations& animations;
  };
  SceneBuilder(const JsonDocument& json, const Readers& readers, FaultList& faults)
      : json_(json),
        meshes_(readers.meshes),
        accessors_(readers.accessors),
        lamps_(readers.lamps),
        light_extensions_(readers.light_extensions),
        skins_(readers.skins),
        animations_(readers.animations),
        faults_(faults) {
    JsonObject root(json, json.root(), faults);
    FaultList told(faults.file());  // with the nodes
    if (const JsonValue* scene = default_scene(json, told)) read_lighting(*scene);
    cameras_ = root.array("cameras");
    lights_ = find_lights(json, faults);
    const JsonValue* nodes = root.array("nodes");
    indices_.nodes.assign(nodes == nullptr ? 0 : nodes->children.size(), -1);
    indices_.cameras.resize(cameras_ == nullptr ? 0 : cameras_->children.size());
    indices_.lights.resize(lights_ == nullptr ? 0 : lights_->children.size());
  }

  void add(const PlacedNode& placed) {
    JsonObject object(json_, *placed.json, faults_);
    Node node;
    node.name = object.string("name").value_or("");
    node.parent = placed.parent;
    const NodePlace place = node_place(json_, *placed.json, faults_);
    node.parent_from_node = place.parent_from_node;
    node.transform = place.transform;
    indices_.nodes[placed.json->index] = static_cast<int>(scene_.nodes.size());
    read_flags(*placed.json, node);
    if (const int mesh = object.index("mesh", meshes_.count(), "meshes"); mesh >= 0) {
      wear_mesh(node, object, mesh, static_cast<int>(placed.json->index));
      node.node_from_instance =
          node_instances(json_, *placed.json, accessors_, kMaxInstances - instance_count_, faults_);
      instance_count_ += node.node_from_instance.size();
    }
    const std::size_t camera_count = cameras_ == nullptr ? 0 : cameras_->children.size();
    if (const int camera = object.index("camera", camera_count, "cameras"); camera >= 0) {
      node.camera = add_camera(cameras_->children[static_cast<std::size_t>(camera)], node.name);
      if (node.camera >= 0) indices_.cameras[static_cast<std::size_t>(camera)].push_back(node.camera);
    }
    if (const JsonValue* extension = find_extension(*placed.json, "KHR_lights_punctual")) {
      JsonObject reference(json_, *extension, faults_);
      const std::size_t light_count = lights_ == nullptr ? 0 : lights_->children.size();
      const int light = reference.index("light", light_count, "lights");
      if (light >= 0) node.light = add_light(lights_->children[static_cast<std::size_t>(light)], node.name);
      if (node.light >= 0) indices_.lights[static_cast<std::size_t>(light)].push_back(node.light);
    }
    scene_.nodes.push_back(std::move(node));
    if (std::optional<Light> lamp = lamps_.read(*placed.json, light_extensions_))
      hang_lamp(std::move(*lamp), static_cast<int>(scene_.nodes.size()) - 1);
  }

  // A node that has a light already gets its lamp as a child, once all nodes of the file have their numbers.
  void hang_lamp(Light lamp, int node) {
    const std::string& node_name = scene_.nodes[static_cast<std::size_t>(node)].name;
    const std::size_t index = scene_.lights.size();
    lamp.name = name_for(lamp.name, node_name, fmt::format("light {}", index + 1), light_names_);
    scene_.lights.push_back(std::move(lamp));
    if (scene_.nodes[static_cast<std::size_t>(node)].light < 0) {
      scene_.nodes[static_cast<std::size_t>(node)].light = static_cast<int>(index);
    } else {
      lamps_of_lit_nodes_.push_back({static_cast<int>(index), node});
    }
  }

  Scene take() {
    for (const LampOfLitNode& lamp : lamps_of_lit_nodes_) {
      Node node;
      node.name = scene_.lights[static_cast<std::size_t>(lamp.light)].name;
      node.parent = lamp.parent;
      node.light = lamp.light;
      scene_.nodes.push_back(std::move(node));
    }
    return std::move(scene_);
  }
  [[nodiscard]] SceneIndices& indices() { return indices_; }

 private:
  // A mesh that moves by itself keeps what it needs for that; any other is drawn toward its morph targets here and now.
  void wear_mesh(Node& node, JsonObject& object, int mesh, int file_node) {
    Meshes::Use use;
    use.node_weights = object.array("weights");
    use.morphs = animations_.move_weights(file_node, mesh);
    const int skin = object.index("skin", skins_.count(), "skins");
    use.has_skin = skin >= 0;
    node.mesh = meshes_.use(mesh, use);
    if (skin >= 0) node.skin = skins_.use(skin);
    if (!use.morphs) return;
    for (const double weight : meshes_.weights_of(mesh, use.node_weights))
      node.weights.push_back(static_cast<float>(weight));
  }

  void read_lighting(const JsonValue& scene) {
    const JsonValue* extension = find_extension(scene, kLightingExtension);
    if (extension == nullptr) return;
    JsonObject object(json_, *extension, faults_, kGltfNames);
    for (const std::string_view allowed : {"extensions", "extras"}) object.any(allowed);
    read_scene_settings(json_, object, faults_, scene_);
    object.report_unknown_members("a scene");
  }

  void read_flags(const JsonValue& value, Node& node) {
    const JsonValue* extension = find_extension(value, kLightingExtension);
    if (extension == nullptr) return;
    JsonObject object(json_, *extension, faults_, kGltfNames);
    for (const std::string_view allowed : {"extensions", "extras"}) object.any(allowed);
    read_node_flags(object).apply(node);
    object.report_unknown_members("a node");
  }

  // The thing's own name; where that is missing or belongs to another node already, the node's.
  static std::string name_for(const std::string& own, const std::string& node, const std::string& fallback,
                              UniqueNames& names) {
    if (!own.empty() && !names.is_taken(own)) return names.take(own);
    if (!node.empty()) return names.take(node);
    return names.take(own.empty() ? fallback : own);
  }

  int add_camera(const JsonValue& value, const std::string& node_name) {
    std::optional<Camera> camera = read_camera(json_, value, faults_);
    if (!camera) return -1;
    const std::size_t index = scene_.cameras.size();
    camera->name = name_for(camera->name, node_name, fmt::format("camera {}", index + 1), camera_names_);
    scene_.cameras.push_back(std::move(*camera));
    return static_cast<int>(index);
  }

  int add_light(const JsonValue& value, const std::string& node_name) {
    std::optional<Light> light = read_light(json_, value, light_extensions_, faults_);
    if (!light) return -1;
    const std::size_t index = scene_.lights.size();
    light->name = name_for(light->name, node_name, fmt::format("light {}", index + 1), light_names_);
    scene_.lights.push_back(std::move(*light));
    return static_cast<int>(index);
  }

  const JsonDocument& json_;
  Meshes& meshes_;
  Accessors& accessors_;
  Lamps& lamps_;
  LightExtensions& light_extensions_;
  Skins& skins_;
  const Animations& animations_;
  FaultList& faults_;
  SceneIndices indices_;
  struct LampOfLitNode {
    int light, parent;
  };
  std::vector<LampOfLitNode> lamps_of_lit_nodes_;
  const JsonValue* cameras_ = nullptr;
  const JsonValue* lights_ = nullptr;
  UniqueNames camera_names_, light_names_;
  std::uint64_t instance_count_ = 0;
  Scene scene_;
};

tl::unexpected<Error> failure(const FaultList& faults) {
  return tl::unexpected(Error(Failure::bad_input, faults.errors()));
}

Result<Scene> read_document(const JsonDocument& json, const Container& container,
                            const std::filesystem::path& folder, FaultList& faults) {
  check_requirements(json, faults);
  if (faults.has_errors()) return failure(faults);
  Buffers buffers(json, container, folder, faults);
  Accessors accessors(json, buffers, faults);
  Textures textures(json, buffers, folder, faults);
  Materials materials(json, textures, faults);
  Meshes meshes(json, buffers, accessors, materials, faults);
  const std::vector<PlacedNode> placed = placed_nodes(json, faults);
  Lamps lamps(json, buffers, folder, faults);
  LightExtensions light_extensions(json, textures, folder, faults);
  Skins skins(json, accessors, faults);
  Animations animations(json, accessors, faults);
  SceneBuilder builder(json, {meshes, accessors, lamps, light_extensions, skins, animations}, faults);
  for (const PlacedNode& node : placed) builder.add(node);
  std::optional<Environment> environment = read_environment(json, textures, faults);
  if (faults.has_errors()) return failure(faults);
  Scene scene = builder.take();
  scene.meshes = meshes.take();
  SceneIndices& indices = builder.indices();
  indices.materials = materials.indices();
  scene.skins = skins.read(indices.nodes);
  scene.clips = animations.read(indices, scene);
  if (faults.has_errors()) return failure(faults);
  scene.materials = materials.take();
  scene.pictures = textures.take_pictures();
  scene.environment = std::move(environment);
  scene.warnings = faults.warnings();
  return scene;
}

}  // namespace
}  // namespace gltf

Result<Scene> read_gltf(const ByteSource& source, const std::string& file,
                        const std::filesystem::path& folder) {
  const Result<gltf::Container> container = gltf::open_container(source, file);
  if (!container) return tl::unexpected(container.error());
  const Result<JsonDocument> json = JsonDocument::parse(container->json, file, JsonDocument::Place::path);
  if (!json) return tl::unexpected(json.error());
  FaultList faults(file);
  return gltf::read_document(*json, *container, folder, faults);
}

}  // namespace laterna
