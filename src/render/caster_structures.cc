#include "render/caster_structures.h"

#include "render/caster_changes.h"

namespace laterna::render {

void CasterStructures::forget() {
  forget_movers();
  const std::lock_guard lock(mutex_);
  standing_.reset();
}

void CasterStructures::forget_movers() {
  ++revision_;
  const std::lock_guard lock(mutex_);
  rays_.reset();
  moving_.reset();
  panes_.reset();
  neighbours_.reset();
}

std::shared_ptr<const trace::RayScene> CasterStructures::ray_scene() const {
  const std::lock_guard lock(mutex_);
  if (rays_ == nullptr) rays_ = std::make_shared<const trace::RayScene>(frame_);
  return rays_;
}

std::vector<std::shared_ptr<const shadow::CasterTree>> CasterStructures::caster_trees() const {
  using shadow::CasterTree;
  const std::lock_guard lock(mutex_);
  if (standing_ == nullptr)
    standing_ = std::make_shared<const CasterTree>(frame_, CasterTree::Casters::opaque, kMoves, 0);
  if (moving_ == nullptr)
    moving_ = std::make_shared<const CasterTree>(frame_, CasterTree::Casters::opaque, kMoves, kMoves);
  if (moving_->is_empty()) return {standing_};
  return {standing_, moving_};
}

std::shared_ptr<const shadow::CasterTree> CasterStructures::pane_tree() const {
  using shadow::CasterTree;
  const std::lock_guard lock(mutex_);
  if (panes_ == nullptr) panes_ = std::make_shared<const CasterTree>(frame_, CasterTree::Casters::blended);
  return panes_;
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
