#include "render/caster_structures.h"

namespace laterna::render {

void CasterStructures::forget() {
  ++revision_;
  const std::lock_guard lock(mutex_);
  rays_.reset();
  casters_.reset();
  panes_.reset();
  neighbours_.reset();
}

std::shared_ptr<const trace::RayScene> CasterStructures::ray_scene() const {
  const std::lock_guard lock(mutex_);
  if (rays_ == nullptr) rays_ = std::make_shared<const trace::RayScene>(frame_);
  return rays_;
}

std::shared_ptr<const shadow::CasterTree> CasterStructures::caster_tree(
    shadow::CasterTree::Casters which) const {
  const std::lock_guard lock(mutex_);
  auto& tree = which == shadow::CasterTree::Casters::opaque ? casters_ : panes_;
  if (tree == nullptr) tree = std::make_shared<const shadow::CasterTree>(frame_, which);
  return tree;
}

const frame::TriangleNeighbours* CasterStructures::triangle_neighbours() const {
  const std::lock_guard lock(mutex_);
  if (mesh_neighbours_ == nullptr) {
    mesh_neighbours_ =
        std::make_shared<const frame::MeshNeighbours>(frame::find_mesh_neighbours(scene_, meshes_, pool_));
  }
  if (neighbours_ == nullptr) {
    neighbours_ = std::make_unique<const frame::TriangleNeighbours>(
        frame::place_neighbours(mesh_neighbours_, scene_, meshes_));
  }
  return neighbours_.get();
}

}  // namespace laterna::render
