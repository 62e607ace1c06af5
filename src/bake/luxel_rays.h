// What luxels see: rays that leave them, and what comes through to them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "bake/luxel_grids.h"
#include "bake/luxel_tree.h"
#include "shadow/panes.h"
#include "trace/ray_scene.h"

namespace laterna::bake {

/// What a ray has met.
struct Sight {
  float distance = std::numeric_limits<float>::infinity();
  std::uint32_t place = kNoLuxel;  ///< the luxel that stands for it
  glm::vec3 tint{1};               ///< the part of each channel that panes in between let through
};

/// Const calls may come from several threads, each with a Scratch of its own.
class LuxelRays {
 public:
  struct Scratch {
    std::vector<trace::RayScene::Pane> panes;
    std::vector<shadow::PaneCrossing> crossings;
    std::vector<shadow::PaneColor> colors;
    std::vector<std::pair<float, std::uint32_t>> boxes;  ///< of a sum over the tree that is under way
  };

  LuxelRays(const frame::Frame& frame, const trace::RayScene& rays, const LuxelTree& tree,
            const TaskPool& pool)
      : frame_(frame), rays_(rays), tree_(tree), grids_(frame, tree, pool) {}

  /// Ray number `ray` of `count` that leave a luxel, cosine-weighted about its normal: of irradiance π L each brings
  /// 1 / count of what it meets. The rays of one luxel fill the hemisphere evenly (a lattice), those of its neighbours fill
  /// the gaps (the lattice shifted).
  [[nodiscard]] Sight look(std::uint32_t place, int ray, int count, Scratch& scratch) const;

  /// How far off things are, by rays of the same kind that know nothing of look()'s: metres, infinity where there is nothing.
  [[nodiscard]] float probe(std::uint32_t place, int ray, int count) const;

  /// The part of each channel that comes from one luxel to another, 0 where something opaque stands in the way.
  [[nodiscard]] glm::vec3 transmittance(std::uint32_t from, std::uint32_t to, Scratch& scratch) const;

  [[nodiscard]] bool has_panes() const { return frame_.has_blended_casters; }

 private:
  [[nodiscard]] glm::vec3 tint_along(const Luxel& from, const glm::vec3& direction_ws, float near, float far,
                                     Scratch& scratch) const;

  const frame::Frame& frame_;
  const trace::RayScene& rays_;
  const LuxelTree& tree_;
  LuxelGrids grids_;
};

/// A number in [0, 1) for each place, in each of two dimensions: Kronecker's sequence of the plastic number (Roberts, The
/// unreasonable effectiveness of quasirandom sequences, 2018). Successive places, which lie side by side, differ most.
struct PlaceShift {
  double u, v;
};
PlaceShift shift_of(std::uint32_t place);

}  // namespace laterna::bake
