#include "render/posed_scene.h"

#include <algorithm>
#include <utility>

#include "base/refuse.h"
#include "frame/flatten.h"
#include "frame/place_lights.h"
#include "render/memory_guard.h"
#include "render/settings_check.h"

namespace laterna::render {
namespace {

// Whether two states of a material let light through alike, where it lets any through.
bool same_cut_outs(const frame::Surface& a, const frame::Surface& b) {
  if (a.alpha_mode == AlphaMode::opaque) return true;
  return a.alpha_cutoff == b.alpha_cutoff && a.base_color == b.base_color &&
         a.base_color_texture.uv_from_mesh_uv == b.base_color_texture.uv_from_mesh_uv;
}

}  // namespace

PosedScene::PosedScene(Scene scene, const RendererOptions& options, const TaskPool& pool)
    : scene_(std::move(scene)),
      pool_(pool),
      instruction_set_(options.instruction_set.value_or(best_instruction_set())),
      time_(options.time),
      poses_(scene_),
      casters_(scene_, frame_, meshes_, pool) {
  poses_.apply(scene_, time_);
}

// Pictures are decoded and triangles cut into clusters at the same time.
Result<void> PosedScene::load() {
  frame::TextureLoading pictures(scene_, instruction_set_, time_);
  frame::MeshClustering clusters(scene_);
  pool_.for_each(pictures.task_count() + clusters.task_count(), [&](std::size_t task, int) {
    if (task < pictures.task_count()) {
      pictures.run(task);
    } else {
      clusters.run(task - pictures.task_count());
    }
  });
  Result<frame::TextureLibrary> library = pictures.finish();
  if (!library) return tl::unexpected(std::move(library.error()));
  textures_ = std::make_shared<frame::TextureLibrary>(std::move(*library));
  meshes_ = clusters.take();
  tell_warnings();
  return rebuild();
}

// Of pictures, each once, however often they are loaded.
void PosedScene::tell_warnings() {
  for (const Diagnostic& warning : textures_->warnings()) {
    if (std::find(scene_.warnings.begin(), scene_.warnings.end(), warning) == scene_.warnings.end())
      scene_.warnings.push_back(warning);
  }
}

// The frame anew, because what casts shadows has moved.
Result<void> PosedScene::rebuild() {
  Result<frame::Frame> built = frame::Frame::build(scene_, textures_, meshes_, pool_);
  if (!built) return tl::unexpected(std::move(built.error()));
  frame_ = std::move(*built);
  may_move_.assign(scene_.nodes.size(), false);
  forget_casters();
  return {};
}

void PosedScene::forget_casters() {
  casters_.forget();
  caster_changes_.forget(frame_);
}

// Everything that clips move, where it is at a time. Lights and cameras are still to be placed.
Result<PoseChanges> PosedScene::pose(double seconds) {
  const PoseChanges changes = poses_.apply(scene_, seconds);
  if (const Result<void> followed = follow(changes); !followed) {
    return_to(time_);
    return tl::unexpected(followed.error());
  }
  return changes;
}

// The frame as the scene is now.
Result<void> PosedScene::follow(const PoseChanges& changes) {
  const CasterChanges::Before before = CasterChanges::look_at(frame_);
  bool casters_changed = false;
  std::vector<bool> other_cut_outs;
  if (changes.materials) {
    const std::vector<frame::Surface> surfaces = frame_.surfaces;
    frame_.make_surfaces(scene_);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      other_cut_outs.push_back(!same_cut_outs(surfaces[i], frame_.surfaces[i]));
      casters_changed |= other_cut_outs.back();
    }
  }
  if (changes.nodes) {
    const Result<frame::Reposed> reposed = frame_.repose(scene_, pool_);
    if (!reposed) return tl::unexpected(reposed.error());
    posing_.primitives_posed += reposed->parts;
    posing_.vertices_posed += reposed->vertices;
    casters_changed |= reposed->moves_casters;
  }
  if (casters_changed) {
    ++posing_.casters_moved;
    if (caster_changes_.note(before, other_cut_outs, frame_)) {
      casters_.forget();
    } else {
      casters_.forget_movers();
    }
  }
  return {};
}

// As it was before, which was sound.
void PosedScene::return_to(double seconds) {
  poses_.apply(scene_, seconds);
  frame_.make_surfaces(scene_);
  static_cast<void>(frame_.repose(scene_, pool_));
  forget_casters();
}

// The first time that a caller moves a node, what hangs on it joins what clips move. False: no mesh does.
bool PosedScene::let_move(int node) {
  const std::vector<bool> moves = nodes_moved_by(scene_, node);
  bool has_meshes = false, is_first = false;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (!moves[i] || scene_.nodes[i].mesh < 0) continue;
    has_meshes = true;
    is_first |= !may_move_[i];
    may_move_[i] = true;
  }
  if (is_first) frame::let_move(scene_, meshes_, moves, frame_);
  return has_meshes;
}

Result<void> PosedScene::set_transform(int node, const glm::dmat4& parent_from_node) {
  if (node < 0 || static_cast<std::size_t>(node) >= scene_.nodes.size()) {
    return refuse("the scene has no node " + std::to_string(node));
  }
  return guarded([&]() -> Result<void> {
    const bool moves_meshes = let_move(node);
    glm::dmat4& place = scene_.nodes[static_cast<std::size_t>(node)].parent_from_node;
    const glm::dmat4 before = place;
    place = parent_from_node;
    if (std::vector<Diagnostic> faults = validate(scene_); !faults.empty()) {
      place = before;
      return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
    }
    poses_.set_node(node, parent_from_node);
    poses_.apply(scene_, time_);
    if (Result<void> followed = follow({.nodes = moves_meshes}); !followed) {
      place = before;
      poses_.set_node(node, before);
      return_to(time_);
      return followed;
    }
    frame_.place_lights_and_cameras(scene_);
    return {};
  });
}

Result<void> PosedScene::set_light(int light, Light value) {
  if (light < 0 || static_cast<std::size_t>(light) >= scene_.lights.size()) {
    return refuse("the scene has no light " + std::to_string(light));
  }
  Light& place = scene_.lights[static_cast<std::size_t>(light)];
  std::swap(place, value);
  if (std::vector<Diagnostic> faults = validate(scene_); !faults.empty()) {
    std::swap(place, value);
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  }
  poses_.set_light(light, place);
  poses_.apply(scene_, time_);
  const std::vector<int> decals = frame::decal_lights(scene_);
  const bool is_decal = std::find(decals.begin(), decals.end(), light) != decals.end();
  const auto is_missing = [&](image::MipUse use) { return textures_->find(place.slide, use) == nullptr; };
  if (place.slide >= 0 &&
      (is_missing(frame::slide_use(place)) || (is_decal && is_missing(frame::kLayerUse)))) {
    Result<void> loaded = guarded([&] { return load(); });
    if (!loaded) {
      std::swap(place, value);
      poses_.set_light(light, place);
    }
    return loaded;
  }
  frame_.place_lights_and_cameras(scene_);
  return {};
}

Result<void> PosedScene::set_photograph_gains(std::span<const glm::vec3> gains) {
  std::vector<Photograph>& photographs = scene_.photographs;
  if (gains.size() != photographs.size()) {
    return refuse("expected a gain for each of " + std::to_string(photographs.size()) + " photographs, got " +
                  std::to_string(gains.size()));
  }
  std::vector<Photograph> before = photographs;
  for (std::size_t i = 0; i < gains.size(); ++i) photographs[i].gain = gains[i];
  if (std::vector<Diagnostic> faults = validate(scene_); !faults.empty()) {
    for (std::size_t i = 0; i < gains.size(); ++i) photographs[i].gain = before[i].gain;
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  }
  return {};
}

Result<int> PosedScene::set_time(double seconds) {
  if (Result<void> checked = check_time(seconds); !checked) return tl::unexpected(checked.error());
  return guarded([&]() -> Result<int> {
    Result<int> changed = textures_->show(seconds);
    if (!changed) return changed;
    const Result<PoseChanges> moved = pose(seconds);
    if (!moved) {
      static_cast<void>(textures_->show(time_));
      return tl::unexpected(moved.error());
    }
    time_ = seconds;
    if (*changed > 0 || moved->nodes || moved->cameras || moved->lights)
      frame_.place_lights_and_cameras(scene_);
    return changed;
  });
}

}  // namespace laterna::render
