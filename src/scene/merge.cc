#include "scene/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <system_error>

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

std::vector<bool> nodes_called(const Scene& scene, const std::string& name) {
  std::vector<bool> is_called(scene.nodes.size(), false);
  bool any = false;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) any |= is_called[i] = scene.nodes[i].name == name;
  if (any) return is_called;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int mesh = scene.nodes[i].mesh;
    is_called[i] = mesh >= 0 && scene.meshes[static_cast<std::size_t>(mesh)].name == name;
  }
  return is_called;
}

// Everything below a chosen node is chosen too. Each chain upward is walked once.
void choose_descendants(const Scene& scene, std::vector<bool>& is_chosen) {
  std::vector<bool> is_decided = is_chosen;
  std::vector<std::size_t> path;
  for (std::size_t start = 0; start < scene.nodes.size(); ++start) {
    path.clear();
    auto node = static_cast<int>(start);
    while (node >= 0 && !is_decided[static_cast<std::size_t>(node)]) {
      path.push_back(static_cast<std::size_t>(node));
      node = scene.nodes[static_cast<std::size_t>(node)].parent;
    }
    const bool chosen = node >= 0 && is_chosen[static_cast<std::size_t>(node)];
    for (const std::size_t at : path) {
      is_chosen[at] = chosen;
      is_decided[at] = true;
    }
  }
}

std::string no_such_node(const Scene& scene, const std::string& name) {
  std::vector<std::string_view> names;
  names.reserve(scene.nodes.size() + scene.meshes.size());
  for (const Node& node : scene.nodes) names.push_back(node.name);
  for (const Mesh& mesh : scene.meshes) names.push_back(mesh.name);
  return fmt::format("the scene has no node named {}{}", in_quotes(name), did_you_mean(name, names));
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

void SceneMerger::add(Scene scene, const std::string& file) {
  append(merged_.warnings, scene.warnings);
  const std::vector<int> picture = add_pictures(scene.pictures);
  for (Material& material : scene.materials) {
    for (Texture* texture :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
          &material.occlusion_texture, &material.emissive_texture}) {
      remap_picture(texture->picture, picture);
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
  }
  rename_taken(scene.cameras, camera_names_, "camera", file);
  rename_taken(scene.lights, light_names_, "light", file);
  append(merged_.materials, scene.materials);
  append(merged_.meshes, scene.meshes);
  append(merged_.cameras, scene.cameras);
  append(merged_.lights, scene.lights);
  append(merged_.nodes, scene.nodes);
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
}

void SceneMerger::apply(const std::vector<NodeOverride>& overrides, std::vector<Diagnostic>& faults) {
  for (const NodeOverride& change : overrides) {
    std::vector<bool> is_chosen = nodes_called(merged_, change.name);
    if (std::find(is_chosen.begin(), is_chosen.end(), true) == is_chosen.end()) {
      faults.push_back({change.file, change.place, no_such_node(merged_, change.name)});
      continue;
    }
    choose_descendants(merged_, is_chosen);
    for (std::size_t i = 0; i < merged_.nodes.size(); ++i) {
      if (!is_chosen[i]) continue;
      Node& node = merged_.nodes[i];
      node.casts_shadow = change.casts_shadow.value_or(node.casts_shadow);
      node.receives_shadow = change.receives_shadow.value_or(node.receives_shadow);
      node.visible = change.visible.value_or(node.visible);
    }
  }
}

}  // namespace laterna
