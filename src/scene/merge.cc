#include "scene/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>

#include "scene/lobe_factors.h"
#include "scene/node_path.h"
#include "scene/node_selection.h"
#include "scene/spelling.h"

namespace laterna {
namespace {

void shift(int& index, std::size_t by) {
  if (index >= 0) index += static_cast<int>(by);
}

void remap_picture(int& picture, const std::vector<int>& new_index) {
  if (picture >= 0) picture = new_index[static_cast<std::size_t>(picture)];
}

template <class T>
void append(std::vector<T>& to, std::vector<T>& from) {
  if (to.empty()) {
    to = std::move(from);
  } else {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  }
}

// What skins and clips refer to, as it is numbered behind what `merged` holds already.
void shift_animation(Scene& scene, const Scene& merged) {
  for (Skin& skin : scene.skins) {
    for (int& joint : skin.joints) shift(joint, merged.nodes.size());
  }
  for (Clip& clip : scene.clips) {
    for (ClipChannel& channel : clip.channels) {
      if (channel.property <= AnimatedProperty::look_at) {
        shift(channel.target, merged.nodes.size());
      } else if (channel.property <= AnimatedProperty::far && !channel.of_light) {
        shift(channel.target, merged.cameras.size());
      } else if (channel.property <= AnimatedProperty::outer_cone) {
        shift(channel.target, merged.lights.size());
      } else {
        shift(channel.target, merged.materials.size());
      }
    }
  }
}

}  // namespace

std::vector<int> SceneMerger::add_pictures(std::vector<Picture>& pictures) {
  std::vector<int> new_index;
  for (Picture& picture : pictures) {
    const auto next = static_cast<int>(merged_.pictures.size());
    if (picture.film) {
      // Two projectors that show one film at the same times share it.
      const auto known = std::find_if(
          merged_.pictures.begin(), merged_.pictures.end(),
          [&](const Picture& other) { return other.film == picture.film && other.file == picture.file; });
      new_index.push_back(static_cast<int>(known - merged_.pictures.begin()));
      if (known != merged_.pictures.end()) continue;
    } else if (!picture.file.empty()) {
      std::error_code ignored;
      std::filesystem::path key = std::filesystem::weakly_canonical(picture.file, ignored);
      if (key.empty()) key = picture.file;
      const auto [known, is_new] = picture_of_file_.try_emplace(std::move(key), next);
      new_index.push_back(known->second);
      if (!is_new) continue;
    } else {
      new_index.push_back(next);
    }
    merged_.pictures.push_back(std::move(picture));
  }
  return new_index;
}

template <class Named>
void SceneMerger::rename_taken(std::vector<Named>& things, UniqueNames& names, const char* kind,
                               const std::string& file) {
  for (Named& thing : things) {
    const std::string given = names.take(thing.name);
    if (given == thing.name) continue;
    merged_.warnings.push_back({file,
                                {},
                                fmt::format("a {} named {} is already there: this one becomes {}", kind,
                                            in_quotes(thing.name), in_quotes(given))});
    thing.name = given;
  }
}

MergedIndices SceneMerger::add(Scene scene, const std::string& file) {
  const auto first_light = static_cast<int>(merged_.lights.size());
  append(merged_.warnings, scene.warnings);
  const std::vector<int> picture = add_pictures(scene.pictures);
  for (Material& material : scene.materials) {
    for (Texture* texture :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture, &material.light_map.front,
          &material.light_map.back}) {
      remap_picture(texture->picture, picture);
    }
    for (std::size_t i = 0; material.lobes != nullptr && i < kLobeTextures; ++i)
      remap_picture(lobe_texture_of(material, i).picture, picture);
    if (material.relief != nullptr) {
      Relief relief = *material.relief;
      remap_picture(relief.texture.picture, picture);
      material.relief = std::make_shared<const Relief>(relief);
    }
    for (SurfaceLayer& layer : material.layers) {
      remap_picture(layer.texture.picture, picture);
      shift(layer.projector, merged_.lights.size());
    }
  }
  for (Light& light : scene.lights) remap_picture(light.slide, picture);
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& primitive : mesh.primitives) shift(primitive.material, merged_.materials.size());
  }
  for (Node& node : scene.nodes) {
    shift(node.parent, merged_.nodes.size());
    shift(node.mesh, merged_.meshes.size());
    shift(node.camera, merged_.cameras.size());
    shift(node.light, merged_.lights.size());
    shift(node.skin, merged_.skins.size());
  }
  shift_animation(scene, merged_);
  rename_taken(scene.cameras, camera_names_, "camera", file);
  rename_taken(scene.lights, light_names_, "light", file);
  append(merged_.materials, scene.materials);
  append(merged_.meshes, scene.meshes);
  append(merged_.cameras, scene.cameras);
  append(merged_.lights, scene.lights);
  append(merged_.nodes, scene.nodes);
  append(merged_.skins, scene.skins);
  append(merged_.clips, scene.clips);
  if (scene.ambient_is_set) {
    merged_.ambient = scene.ambient;
    merged_.ambient_is_set = true;
  }
  if (scene.background) merged_.background = scene.background;
  if (scene.phong) merged_.phong = scene.phong;
  if (scene.environment) {
    merged_.environment = std::move(scene.environment);
    remap_picture(merged_.environment->picture, picture);
    for (std::array<int, 6>& faces : merged_.environment->specular_pictures) {
      for (int& face : faces) remap_picture(face, picture);
    }
  }
  return {picture, first_light};
}

void SceneMerger::apply(const std::vector<NodeOverride>& overrides, std::vector<Diagnostic>& faults) {
  for (const NodeOverride& change : overrides) {
    const std::vector<bool> is_chosen = select_nodes(merged_, change.name);
    if (std::find(is_chosen.begin(), is_chosen.end(), true) == is_chosen.end()) {
      faults.push_back({change.file, change.place, no_such_node(merged_, change.name)});
      continue;
    }
    for (std::size_t i = 0; i < merged_.nodes.size(); ++i) {
      if (is_chosen[i]) change.flags.apply(merged_.nodes[i]);
    }
    if (!change.path) continue;
    if (std::string fault = add_node_path(merged_, change.name, *change.path); !fault.empty())
      faults.push_back({change.file, change.place, std::move(fault)});
  }
}

void SceneMerger::apply(const std::vector<SurfaceOverride>& overrides, std::vector<Diagnostic>& faults) {
  for (const SurfaceOverride& change : overrides) laterna::apply(change, merged_, faults);
}

}  // namespace laterna
