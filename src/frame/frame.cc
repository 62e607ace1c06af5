#include "frame/frame.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <span>

#include "base/elementary.h"
#include "frame/flatten.h"
#include "frame/place_lights.h"
#include "frame/surface_lobes.h"
#include "laterna/relief.h"

namespace laterna::frame {
namespace {

// `decals`: the lights of Frame::decals.
LayerBinding make_layer(const SurfaceLayer& l, const TextureLibrary& library, std::span<const int> decals) {
  LayerBinding layer;
  layer.texture = bind(l.texture, kLayerUse, library);
  layer.once = l.once;
  if (l.projector >= 0) {
    layer.decal = static_cast<int>(std::find(decals.begin(), decals.end(), l.projector) - decals.begin());
  }
  layer.occluded = l.occluded;
  for (int i = 0; i < 3; ++i) layer.color[static_cast<std::size_t>(i)] = l.color[i];
  layer.opacity = l.opacity;
  layer.blend = l.blend;
  return layer;
}

Surface make_surface(const Material& m, const TextureLibrary& library, std::span<const int> decals) {
  Surface s;
  for (int i = 0; i < 4; ++i) s.base_color[static_cast<std::size_t>(i)] = m.base_color[i];
  for (int i = 0; i < 3; ++i) s.emissive[static_cast<std::size_t>(i)] = m.emissive[i];
  s.metallic = m.metallic;
  s.roughness = m.roughness;
  s.normal_scale = m.normal_scale;
  s.occlusion_strength = m.occlusion_strength;
  s.alpha_cutoff = m.alpha_cutoff;
  s.alpha_mode = m.alpha_mode;
  s.double_sided = m.double_sided;
  s.unlit = m.unlit;
  s.base_color_texture = bind(m.base_color_texture, base_color_use(m), library);
  s.metallic_roughness_texture = bind(m.metallic_roughness_texture, image::MipUse::data, library);
  s.normal_texture = bind(m.normal_texture, image::MipUse::data, library);
  s.occlusion_texture = bind(m.occlusion_texture, image::MipUse::data, library);
  s.emissive_texture = bind(m.emissive_texture, image::MipUse::colour, library);
  s.light_map = {bind(m.light_map.front, image::MipUse::data, library),
                 bind(m.light_map.back, image::MipUse::data, library), m.light_map.intensity};
  if (m.lobes != nullptr) s.lobes = bind_lobes(*m.lobes, library);
  for (const SurfaceLayer& layer : m.layers) s.layers.push_back(make_layer(layer, library, decals));
  if (has_relief(m)) {
    const Relief& r = *m.relief;
    s.relief = {library.find_relief(r),      r.texture.uv_set, r.texture.uv_from_mesh_uv,
                static_cast<float>(r.depth), r.self_shadow,    r.cut_edges};
  }
  s.mirror = m.mirror;
  return s;
}

std::vector<Diagnostic> find_far_objects(const Frame& frame) {
  std::vector<Diagnostic> faults;
  std::uint32_t last = kNoStream;
  for (const Cluster& cluster : frame.clusters) {
    bool is_near = true;
    for (int k = 0; k < 3; ++k)
      is_near &=
          std::abs(cluster.low_ws[k]) <= kMaxCoordinate && std::abs(cluster.high_ws[k]) <= kMaxCoordinate;
    if (is_near || cluster.object == last) continue;
    last = cluster.object;
    faults.push_back(
        {{}, "object \"" + frame.object_names[last] + "\"", "lies farther than 1e9 m from the origin"});
  }
  return faults;
}

}  // namespace

Result<Frame> Frame::build(const Scene& scene, std::shared_ptr<const TextureLibrary> textures,
                           const ClusteredMeshes& meshes, const TaskPool& pool) {
  Frame frame;
  frame.textures = std::move(textures);
  frame.make_surfaces(scene);
  for (const Photograph& photograph : scene.photographs) {
    frame.photographs.push_back(
        {&photograph, frame.textures->find(photograph.picture, image::MipUse::colour_with_alpha)});
  }
  if (const std::size_t clusters = count_clusters(scene, meshes); clusters > kMaxClusters) {
    return tl::unexpected(
        Error(Failure::bad_input,
              Diagnostic{{},
                         {},
                         "the scene's meshes and instances need " + std::to_string(clusters) +
                             " clusters of triangles; at most " + std::to_string(kMaxClusters) + " fit"}));
  }
  flatten_meshes(scene, meshes, world_from_nodes(scene), pool, frame);
  if (std::vector<Diagnostic> faults = find_far_objects(frame); !faults.empty()) {
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  }
  frame.place_lights_and_cameras(scene);
  return frame;
}

void Frame::make_surfaces(const Scene& scene) {
  surfaces.clear();
  const std::vector<int> decal_lights_of_scene = decal_lights(scene);
  for (const Material& material : scene.materials)
    surfaces.push_back(make_surface(material, *textures, decal_lights_of_scene));
  surfaces.push_back(make_surface(Material{}, *textures, {}));
  has_mirrors = std::any_of(surfaces.begin(), surfaces.end(),
                            [](const Surface& surface) { return surface.mirror != nullptr; });
  // Photographs hold the light that they were taken in.
  if (!scene.photographs.empty() && !scene.photograph_settings.are_lit) {
    for (Surface& surface : surfaces) surface.unlit = true;
  }
}

Result<Reposed> Frame::repose(const Scene& scene, const TaskPool& pool) {
  const Reposed reposed = repose_meshes(scene, world_from_nodes(scene), pool, *this);
  if (reposed.parts == 0) return reposed;
  if (std::vector<Diagnostic> faults = find_far_objects(*this); !faults.empty()) {
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  }
  return reposed;
}

void Frame::place_lights_and_cameras(const Scene& scene) {
  lights.clear();
  cameras.clear();
  decals.clear();
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene);
  frame::place_lights_and_cameras(scene, world_from_node, *this);
  place_decals(scene, world_from_node, *this);
  // Tables of lamps that no light has any more.
  std::erase_if(lamps, [this](const auto& lamp) {
    return std::none_of(lights.begin(), lights.end(),
                        [&](const PlacedLight& placed) { return placed.lamp == lamp.second.get(); });
  });
}

std::size_t Frame::triangle_count() const {
  std::size_t count = 0;
  for (const Cluster& cluster : clusters) count += cluster.triangle_count;
  return count;
}

}  // namespace laterna::frame
