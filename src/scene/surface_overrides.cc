#include "scene/surface_overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "scene/mirror_settings.h"
#include "scene/node_selection.h"
#include "scene/scene_pose.h"
#include "scene/spelling.h"

namespace laterna {
namespace {

template <class Things>
std::vector<std::string_view> names_of(const Things& things) {
  std::vector<std::string_view> names;
  for (const auto& thing : things) {
    if (!thing.name.empty()) names.push_back(thing.name);
  }
  return names;
}

class SurfaceLayering {
 public:
  SurfaceLayering(const SurfaceOverride& change, Scene& scene, std::vector<Diagnostic>& faults)
      : change_(change), scene_(scene), faults_(faults) {}

  void run() {
    const std::vector<SurfaceLayer> layers = find_layers();
    const std::set<int> materials = change_.material ? materials_called(*change_.material)
                                    : change_.node   ? materials_of_node(*change_.node)
                                                     : materials_of_all();
    for (const int material : materials) lay(layers, material);
  }

 private:
  void fault(const std::string& place, std::string message) {
    faults_.push_back({change_.file, place, std::move(message)});
  }

  Material& material_at(int index) { return scene_.materials[static_cast<std::size_t>(index)]; }

  std::vector<SurfaceLayer> find_layers() {
    std::vector<SurfaceLayer> layers;
    for (const SurfaceOverride::Layer& read : change_.layers) {
      layers.push_back(read.layer);
      if (read.slide) find_projector(*read.slide, read.slide_place, layers.back().projector);
    }
    return layers;
  }

  void find_projector(const std::string& name, const std::string& place, int& projector) {
    const std::vector<Light>& lights = scene_.lights;
    if (projector < 0) {
      const auto found = std::find_if(lights.begin(), lights.end(),
                                      [&](const Light& candidate) { return candidate.name == name; });
      if (found == lights.end()) {
        return fault(place, fmt::format("there is no projector named {}{}", in_quotes(name),
                                        did_you_mean(name, names_of(lights))));
      }
      projector = static_cast<int>(found - lights.begin());
    }
    const Light& light = lights[static_cast<std::size_t>(projector)];
    if (light.type != LightType::projector) {
      fault(place, fmt::format("light {} is no projector: it has no slide", in_quotes(name)));
    } else if (light.slide_is_intensity) {
      fault(place, fmt::format("light {} throws an intensity map, which is no colour", in_quotes(name)));
    }
  }

  std::set<int> materials_called(const std::string& name) {
    std::set<int> found;
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
      if (scene_.materials[i].name == name) found.insert(static_cast<int>(i));
    }
    if (found.empty()) {
      const std::vector<std::string_view> names = names_of(scene_.materials);
      fault(change_.place,
            fmt::format("the scene has no material named {}{}{}", in_quotes(name), did_you_mean(name, names),
                        names.empty() ? "; its materials have no names: use \"node\"" : ""));
    }
    return found;
  }

  // Surfaces without a material get one.
  std::set<int> materials_of_all() {
    int unnamed = -1;
    for (Mesh& mesh : scene_.meshes) {
      for (Primitive& primitive : mesh.primitives) {
        if (primitive.material >= 0) continue;
        if (unnamed < 0) unnamed = add_material({});
        primitive.material = unnamed;
      }
    }
    std::set<int> all;
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) all.insert(static_cast<int>(i));
    return all;
  }

  int add_material(Material material) {
    scene_.materials.push_back(std::move(material));
    return static_cast<int>(scene_.materials.size()) - 1;
  }

  std::set<int> materials_of_node(const std::string& name) {
    const std::vector<bool> is_chosen = select_nodes(scene_, name);
    if (std::find(is_chosen.begin(), is_chosen.end(), true) == is_chosen.end()) {
      fault(change_.place, no_such_node(scene_, name));
      return {};
    }
    const std::set<int> meshes = take_meshes(is_chosen);
    if (meshes.empty())
      fault(change_.place, fmt::format("node {} and all below it have no mesh", in_quotes(name)));
    return take_materials(meshes);
  }

  // Meshes of the chosen nodes: copies, where others show them too.
  std::set<int> take_meshes(const std::vector<bool>& is_chosen) {
    std::set<int> of_others;
    for (std::size_t i = 0; i < is_chosen.size(); ++i) {
      if (!is_chosen[i]) of_others.insert(scene_.nodes[i].mesh);
    }
    std::map<int, int> copies;
    std::set<int> taken;
    for (std::size_t i = 0; i < is_chosen.size(); ++i) {
      int& mesh = scene_.nodes[i].mesh;
      if (!is_chosen[i] || mesh < 0) continue;
      if (of_others.contains(mesh)) {
        const auto [copy, is_new] = copies.try_emplace(mesh, static_cast<int>(scene_.meshes.size()));
        if (is_new) {
          Mesh copied = scene_.meshes[static_cast<std::size_t>(mesh)];
          scene_.meshes.push_back(std::move(copied));
        }
        mesh = copy->second;
      }
      taken.insert(mesh);
    }
    return taken;
  }

  // The same for the materials of these meshes.
  std::set<int> take_materials(const std::set<int>& meshes) {
    std::set<int> of_others = {-1};
    for (std::size_t m = 0; m < scene_.meshes.size(); ++m) {
      if (meshes.contains(static_cast<int>(m))) continue;
      for (const Primitive& primitive : scene_.meshes[m].primitives) of_others.insert(primitive.material);
    }
    std::map<int, int> copies;
    std::set<int> taken;
    for (const int mesh : meshes) {
      for (Primitive& primitive : scene_.meshes[static_cast<std::size_t>(mesh)].primitives) {
        int& material = primitive.material;
        if (of_others.contains(material)) {
          const auto [copy, is_new] = copies.try_emplace(material, 0);
          if (is_new) {
            copy->second = add_material(material < 0 ? Material() : Material(material_at(material)));
            animate_copy(material, copy->second);
          }
          material = copy->second;
        }
        taken.insert(material);
      }
    }
    return taken;
  }

  // What clips do to a material they do to its copy.
  void animate_copy(int original, int copy) {
    for (Clip& clip : scene_.clips) {
      std::vector<ClipChannel> copies;
      for (ClipChannel channel : clip.channels) {
        if (!changes_material(channel.property) || channel.target != original) continue;
        channel.target = copy;
        copies.push_back(channel);
      }
      clip.channels.insert(clip.channels.end(), copies.begin(), copies.end());
    }
  }

  void lay(const std::vector<SurfaceLayer>& layers, int index) {
    std::vector<SurfaceLayer>& all = material_at(index).layers;
    all.insert(all.end(), layers.begin(), layers.end());
    if (all.size() > kMaxSurfaceLayers) {
      fault(change_.place, fmt::format("material {} comes to {} layers, more than {}",
                                       in_quotes(material_at(index).name), all.size(), kMaxSurfaceLayers));
    }
    if (change_.mirror != nullptr) set_mirror(*change_.mirror, index);
    for (const SurfaceOverride::Layer& read : change_.layers) {
      if (read.layer.texture.is_set())
        check_coordinates(read.layer.texture, read.texture_place, ": a projector's \"slide\" needs none",
                          index);
    }
    if (change_.relief) set_relief(*change_.relief, index);
  }

  void set_mirror(const Mirror& mirror, int index) {
    material_at(index).mirror = change_.mirror;
    if (const std::string fault = find_volume_fault(mirror, material_at(index).alpha_mode); !fault.empty())
      this->fault(mirror.place + ".volume", fmt::format("{}: {}", fault, in_quotes(material_at(index).name)));
  }

  void set_relief(const Relief& relief, int index) {
    Material& material = material_at(index);
    if (material.alpha_mode == AlphaMode::blend) {
      return fault(change_.relief_place,
                   fmt::format("material {} blends: reliefs belong to opaque surfaces and cut-outs",
                               in_quotes(material.name)));
    }
    material.relief = std::make_shared<const Relief>(relief);
    check_coordinates(relief.texture, change_.relief_place, "", index);
  }

  // `otherwise`: what could be done instead.
  void check_coordinates(const Texture& texture, const std::string& place, std::string_view otherwise,
                         int material) {
    const auto set = static_cast<std::size_t>(texture.uv_set);
    for (const Mesh& mesh : scene_.meshes) {
      for (const Primitive& primitive : mesh.primitives) {
        if (primitive.material != material || primitive.positions.empty() || !primitive.uv[set].empty())
          continue;
        return fault(place, fmt::format("mesh {} has no texture coordinates of set {}{}",
                                        in_quotes(mesh.name), set, otherwise));
      }
    }
  }

  const SurfaceOverride& change_;
  Scene& scene_;
  std::vector<Diagnostic>& faults_;
};

}  // namespace

void apply(const SurfaceOverride& change, Scene& scene, std::vector<Diagnostic>& faults) {
  SurfaceLayering(change, scene, faults).run();
}

}  // namespace laterna
