// From a planned light to what answers for its shadows.
#pragma once

#include <memory>

#include "frame/triangle_neighbours.h"
#include "laterna/render.h"
#include "light/light_plan.h"
#include "render/caster_structures.h"
#include "render/depth_map_cache.h"
#include "render/paraboloid_map_cache.h"
#include "render/progress_report.h"
#include "shadow/caster_tree.h"
#include "shadow/panes.h"
#include "shadow/shadow_technique.h"
#include "trace/ray_scene.h"

namespace laterna::render {

/// What shadow techniques of one picture are made of.
struct CastingContext {
  const frame::Frame& frame;
  const TaskPool& pool;
  InstructionSet instruction_set;
  BinsPool& bins;
  DepthMapCache& maps;
  ParaboloidMapCache& paraboloids;
  const CasterStructures& casters;
  const raster::RasterView& camera;
  const RenderSettings& settings;
  RenderStatistics& statistics;
  ProgressReport& progress;
  const std::vector<int>& way;  // on the way to the view: light::MirrorView
};

class ShadowCasting {
 public:
  explicit ShadowCasting(const CastingContext& context) : context_(context) {}

  /// Null where nothing stands in the light's way. The plan must outlive the result; `index` is the light's in it.
  [[nodiscard]] std::unique_ptr<shadow::ShadowTechnique> make(const light::PlannedLight& planned,
                                                              std::size_t index);

 private:
  // Where nothing is displaced.
  [[nodiscard]] std::unique_ptr<shadow::ShadowTechnique> make_for_flat(const light::PlannedLight& planned,
                                                                       std::size_t index);
  [[nodiscard]] std::unique_ptr<shadow::ShadowTechnique> make_opaque(const light::PlannedLight& planned,
                                                                     std::size_t index);
  [[nodiscard]] std::unique_ptr<shadow::PaneFinder> make_panes(const light::PlannedLight& planned);
  [[nodiscard]] std::unique_ptr<shadow::ShadowTechnique> make_map(const light::PlannedLight& planned,
                                                                  std::size_t index);
  [[nodiscard]] std::unique_ptr<shadow::ShadowTechnique> make_paraboloids(const light::PlannedLight& planned,
                                                                          std::size_t index);
  [[nodiscard]] std::unique_ptr<shadow::ShadowTechnique> make_exact(const light::PlannedLight& planned);
  [[nodiscard]] std::unique_ptr<shadow::ShadowTechnique> make_volume(const light::PlannedLight& planned);
  [[nodiscard]] std::unique_ptr<shadow::ShadowTechnique> make_soft_map(const light::PlannedLight& planned,
                                                                       std::size_t index);
  [[nodiscard]] std::unique_ptr<shadow::ShadowTechnique> make_variance_map(const light::PlannedLight& planned,
                                                                           std::size_t index);
  // The light's maps; their tiles are drawn when asked for.
  [[nodiscard]] DepthMapOwner owner_of(const light::PlannedLight& planned, std::size_t index) const;
  [[nodiscard]] DepthMapCache::Found find_maps(const light::PlannedLight& planned, std::size_t index,
                                               bool keeps_triangles);
  // Where the filter asks for them, and null elsewhere.
  [[nodiscard]] const frame::TriangleNeighbours* find_neighbours(const light::PlannedLight& planned) const;
  // All tiles at once. False: the caller asks to stop, and there is nothing to be made of the maps.
  [[nodiscard]] bool complete(const DepthMaps& maps);
  void report_memory(const light::PlannedLight& planned, const DepthMaps& maps, std::size_t more_bytes);
  [[nodiscard]] std::unique_ptr<shadow::ShadowTechnique> make_silhouettes(
      const light::PlannedLight& planned) const;
  void report_memory(const light::PlannedLight& planned, int maps, std::size_t bytes);

  CastingContext context_;
  std::size_t working_bytes_ = 0;  // of the picture's maps so far
  bool has_reported_tree_ = false;
};

/// What could be known only when the picture was done.
void report_drawn(const light::PlannedLight& planned, const shadow::ShadowTechnique* technique,
                  RenderStatistics& statistics);

}  // namespace laterna::render
