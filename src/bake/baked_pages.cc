#include "bake/baked_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "frame/place_lights.h"
#include "laterna/material_lobes.h"

namespace laterna::bake {
namespace {

// Smaller levels would mix surfaces that are neighbours in a page alone.
constexpr Sampler kLuxels = {Wrap::clamp, Wrap::clamp, Filter::linear, Filter::linear, MipFilter::none};

Texture texture_of(int picture) {
  Texture texture;
  texture.picture = picture;
  texture.sampler = kLuxels;
  texture.uv_set = 1;
  return texture;
}

int add_picture(Scene& scene, std::string name, std::shared_ptr<const Image> pixels) {
  if (pixels == nullptr) return -1;
  Picture picture;
  picture.name = std::move(name);
  picture.pixels = std::move(pixels);
  scene.pictures.push_back(std::move(picture));
  return static_cast<int>(scene.pictures.size()) - 1;
}

// What is left of a material that shines as it is seen: its outline.
void blacken(Material& material) {
  if (material.alpha_mode == AlphaMode::opaque) material.base_color_texture = {};
  material.base_color = {0, 0, 0, material.base_color.a};
  material.metallic = 0;
  material.roughness = 1;
  material.metallic_roughness_texture = material.normal_texture = material.occlusion_texture = {};
  material.emissive = glm::vec3(1);
  material.layers.clear();
  auto lobes = std::make_shared<MaterialLobes>();
  lobes->specular.factor = 0;
  material.lobes = std::move(lobes);
  material.relief = nullptr;
}

// glTF's colours end at 1: what would be brighter keeps its hue.
void expose_unlit(Material& material, float exposure, std::vector<Diagnostic>& warnings) {
  const glm::vec3 color(material.base_color);
  const float brightest = std::max({color.r, color.g, color.b});
  const float factor = brightest > 0 ? std::min(exposure, std::max(1.0F, brightest) / brightest) : exposure;
  material.base_color = glm::vec4(color * factor, material.base_color.a);
  if (factor < exposure)
    warnings.push_back(
        {{},
         fmt::format("material \"{}\"", material.name),
         fmt::format("needs no light, and glTF's colours end at 1: shown times {:.4g}, what is "
                     "baked times {:.4g}",
                     factor, exposure)});
}

Primitive turned_over(Primitive primitive, int material) {
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
    std::swap(primitive.indices[i], primitive.indices[i + 1]);
  for (glm::vec3& normal : primitive.normals) normal = -normal;
  primitive.tangents.clear();
  primitive.material = material;
  return primitive;
}

}  // namespace

void show_as_light_maps(Scene& scene, const LightMapLayout& layout, std::vector<BakedPage>& pages) {
  std::vector<LightMap> maps;
  std::vector<int> occlusion;
  for (std::size_t page = 0; page < pages.size(); ++page) {
    BakedPage& p = pages[page];
    LightMap map;
    map.front = texture_of(add_picture(scene, fmt::format("light map {}", page), std::move(p.front)));
    if (p.back != nullptr)
      map.back = texture_of(add_picture(scene, fmt::format("light map {}, back", page), std::move(p.back)));
    maps.push_back(map);
    occlusion.push_back(add_picture(scene, fmt::format("occlusion {}", page), std::move(p.occlusion)));
  }
  for (std::size_t m = 0; m < layout.page_of_material.size(); ++m) {
    if (layout.page_of_material[m] < 0) continue;
    const auto page = static_cast<std::size_t>(layout.page_of_material[m]);
    Material& material = scene.materials[m];
    material.light_map = maps[page];
    if (occlusion[page] < 0) continue;
    if (material.occlusion_texture.is_set()) {
      scene.warnings.push_back({{},
                                fmt::format("material \"{}\"", material.name),
                                "has an occlusion texture of its own, which stays"});
    } else {
      material.occlusion_texture = texture_of(occlusion[page]);
    }
  }
}

void show_as_emission(Scene& scene, const LightMapLayout& layout, std::vector<BakedPage>& pages) {
  std::vector<int> back_of_material(layout.page_of_material.size(), -1);
  std::vector<int> front_of_page, back_of_page;
  for (std::size_t page = 0; page < pages.size(); ++page) {
    front_of_page.push_back(add_picture(scene, fmt::format("baked {}", page), std::move(pages[page].front)));
    back_of_page.push_back(
        add_picture(scene, fmt::format("baked {}, back", page), std::move(pages[page].back)));
  }
  for (std::size_t m = 0; m < back_of_material.size(); ++m) {
    if (layout.page_of_material[m] < 0) continue;
    const auto page = static_cast<std::size_t>(layout.page_of_material[m]);
    blacken(scene.materials[m]);
    scene.materials[m].emissive_texture = texture_of(front_of_page[page]);
    if (!scene.materials[m].double_sided || back_of_page[page] < 0) continue;
    scene.materials[m].double_sided = false;
    Material back = scene.materials[m];
    back.emissive_texture = texture_of(back_of_page[page]);
    back_of_material[m] = static_cast<int>(scene.materials.size());
    scene.materials.push_back(std::move(back));
  }
  for (Mesh& mesh : scene.meshes) {
    for (std::size_t i = 0, count = mesh.primitives.size(); i < count; ++i) {
      const int material = mesh.primitives[i].material;
      const int back = material < 0 ? -1 : back_of_material[static_cast<std::size_t>(material)];
      if (back < 0) continue;
      Primitive turned = turned_over(mesh.primitives[i], back);
      mesh.primitives.push_back(std::move(turned));
    }
  }
}

void expose(Scene& scene, const LightMapLayout& layout, float exposure) {
  const auto exposed = [&](const glm::vec3& color) {
    return glm::min(color * exposure, static_cast<float>(kMaxRadiance));
  };
  scene.ambient = exposed(scene.ambient);
  if (scene.background) scene.background = exposed(*scene.background);
  if (scene.environment)
    scene.environment->intensity = std::min(scene.environment->intensity * double{exposure}, kMaxRadiance);
  for (Light& light : scene.lights) {
    light.intensity *= double{exposure};
    if (light.lumens) *light.lumens *= double{exposure};
  }
  for (std::size_t m = 0; m < layout.page_of_material.size(); ++m) {
    Material& material = scene.materials[m];
    if (layout.page_of_material[m] >= 0) continue;
    if (material.unlit) {
      expose_unlit(material, exposure, scene.warnings);
    } else {
      material.emissive = exposed(material.emissive);
    }
  }
}

void remove_lights(Scene& scene, const std::vector<bool>& is_baked) {
  const std::vector<int> decals = frame::decal_lights(scene);
  std::vector<int> new_index(scene.lights.size(), -1);
  std::vector<Light> kept;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const bool is_paint = std::ranges::find(decals, static_cast<int>(i)) != decals.end();
    if (is_baked[i] && !is_paint) continue;
    if (is_baked[i]) scene.lights[i].enabled = false;
    new_index[i] = static_cast<int>(kept.size());
    kept.push_back(std::move(scene.lights[i]));
  }
  scene.lights = std::move(kept);
  const auto renumber = [&](int& light) {
    if (light >= 0) light = new_index[static_cast<std::size_t>(light)];
  };
  for (Node& node : scene.nodes) renumber(node.light);
  for (Material& material : scene.materials) {
    for (SurfaceLayer& layer : material.layers) renumber(layer.projector);
  }
}

}  // namespace laterna::bake
