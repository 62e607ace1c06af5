#include "bake/laid_out_surfaces.h"

#include <algorithm>
#include <memory>

#include "bake/primitive_corners.h"
#include "laterna/material_lobes.h"
#include "laterna/relief.h"

namespace laterna::bake {
namespace {

template <class Use>
void for_each_texture(Material& material, Use use) {
  for (Texture* texture : {&material.base_color_texture, &material.metallic_roughness_texture,
                           &material.normal_texture, &material.occlusion_texture, &material.emissive_texture})
    use(*texture);
  for (SurfaceLayer& layer : material.layers) use(layer.texture);
  if (material.relief != nullptr) {
    auto relief = std::make_shared<Relief>(*material.relief);
    use(relief->texture);
    material.relief = std::move(relief);
  }
  if (material.lobes == nullptr) return;
  auto lobes = std::make_shared<MaterialLobes>(*material.lobes);
  for (Texture* texture : textures_of(*lobes)) use(*texture);
  material.lobes = std::move(lobes);
}

// The texture as before, from coordinates that have been scaled and moved.
void undo(const PlaceInPage& place, Texture& texture) {
  std::array<float, 6>& m = texture.uv_from_mesh_uv;
  for (std::size_t row = 0; row < 6; row += 3) {
    const double x = double{m[row]} / place.scale.x, y = double{m[row + 1]} / place.scale.y;
    m[row + 2] = static_cast<float>(double{m[row + 2]} - x * place.offset.x - y * place.offset.y);
    m[row] = static_cast<float>(x);
    m[row + 1] = static_cast<float>(y);
  }
}

}  // namespace

void LaidOutSurfaces::add(const SurfaceOfMesh& surface, std::size_t page, std::uint32_t triangle,
                          const std::array<glm::vec2, 3>& corners) {
  triangles_[{surface, page}].push_back({triangle, static_cast<std::uint32_t>(places_.size()), corners});
}

std::vector<int> LaidOutSurfaces::make() {
  make_primitives();
  make_materials();
  return std::move(page_of_material_);
}

// Vertices at which charts meet become several; triangles without an area are left out.
void LaidOutSurfaces::make_primitives() {
  std::map<std::size_t, std::vector<Primitive>> made_of_mesh;
  for (auto& [place, triangles] : triangles_) {
    const auto& [surface, page] = place;
    // As they come in the mesh.
    std::ranges::sort(triangles, {}, &PlacedTriangle::triangle);
    const SecondCoordinates use = use_[surface];
    std::vector<Primitive>& made = made_of_mesh[surface.mesh];
    kinds_[{surface.mesh, made.size()}] = {page, use,
                                           use == SecondCoordinates::shared ? triangles.front().piece : 0};
    made.push_back(with_places(at(surface), triangles));
    triangles = {};
  }
  for (auto& [mesh, made] : made_of_mesh) {
    std::vector<Primitive>& primitives = scene_.meshes[mesh].primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const auto first = triangles_.lower_bound({{mesh, i}, 0});
      const bool is_baked = first != triangles_.end() && first->first.first == SurfaceOfMesh{mesh, i};
      if (!is_baked) made.push_back(std::move(primitives[i]));
    }
    primitives = std::move(made);
  }
  triangles_.clear();
}

Primitive LaidOutSurfaces::with_places(const Primitive& from, const Triangles& triangles) {
  std::vector<std::uint32_t> source;  // the vertex behind each new one
  std::vector<glm::vec2> uv;
  std::vector<std::uint32_t> indices;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  for (const PlacedTriangle& placed : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = vertex_of(from, 3 * std::size_t{placed.triangle} + k);
      const auto [entry, is_new] =
          known.try_emplace({vertex, placed.piece}, static_cast<std::uint32_t>(source.size()));
      if (is_new) {
        source.push_back(vertex);
        uv.push_back(placed.corners[k]);
      }
      indices.push_back(entry->second);
    }
  }
  const auto pick = [&](const auto& values) {
    std::decay_t<decltype(values)> picked;
    if (values.empty()) return picked;
    picked.reserve(source.size());
    for (const std::uint32_t vertex : source) picked.push_back(values[vertex]);
    return picked;
  };
  Primitive made;
  made.positions = pick(from.positions);
  made.normals = pick(from.normals);
  made.tangents = pick(from.tangents);
  made.uv = {pick(from.uv[0]), std::move(uv)};
  made.colors = pick(from.colors);
  made.indices = std::move(indices);
  made.material = from.material;
  return made;
}

// A material whose surfaces lie on several pages becomes several of the same name.
void LaidOutSurfaces::make_materials() {
  page_of_material_.assign(scene_.materials.size(), -1);
  std::vector<bool> is_used_unbaked(scene_.materials.size(), false);
  for (std::size_t m = 0; m < scene_.meshes.size(); ++m) {
    for (std::size_t i = 0; i < scene_.meshes[m].primitives.size(); ++i) {
      const int material = scene_.meshes[m].primitives[i].material;
      if (material >= 0 && !kinds_.contains({m, i}))
        is_used_unbaked[static_cast<std::size_t>(material)] = true;
    }
  }
  // Copies are made of what materials were.
  const std::vector<Material> originals = scene_.materials;
  std::map<std::pair<int, Kind>, int> material_of_kind;
  for (const auto& [surface, kind] : kinds_) {
    Primitive& primitive = at(surface);
    const auto [entry, is_new] = material_of_kind.try_emplace({primitive.material, kind}, primitive.material);
    if (is_new) {
      const int old = primitive.material;
      const auto index = static_cast<std::size_t>(std::max(old, 0));
      if (old < 0 || is_used_unbaked[index] || page_of_material_[index] >= 0) {
        entry->second = static_cast<int>(scene_.materials.size());
        scene_.materials.push_back(old < 0 ? Material() : originals[index]);
        page_of_material_.push_back(-1);
      }
      Material& material = scene_.materials[static_cast<std::size_t>(entry->second)];
      if (kind.use != SecondCoordinates::unused) {
        for_each_texture(material, [&](Texture& texture) {
          if (!texture.is_set() || texture.uv_set != 1) return;
          if (kind.use == SecondCoordinates::moved) texture.uv_set = 0;
          if (kind.use == SecondCoordinates::shared) undo(places_[kind.piece - 1], texture);
        });
      }
      page_of_material_[static_cast<std::size_t>(entry->second)] = static_cast<int>(kind.page);
    }
    primitive.material = entry->second;
  }
}

}  // namespace laterna::bake
