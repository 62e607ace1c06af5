// Shadow maps, drawn when needed and kept while nothing they show has changed (rows 77, 78, 105).
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "frame/frame.h"
#include "light/light_plan.h"
#include "render/bins_pool.h"
#include "shadow/depth_map.h"

namespace laterna::render {

using DepthMaps = std::vector<std::shared_ptr<const shadow::DepthMap>>;

/// What a depth map shows is given by its view, its size, how it is drawn, and the casters.
struct DepthMapKey {
  std::vector<light::ShadowView> views;
  CasterFaces faces = CasterFaces::both;
  bool keeps_triangles = true;
  std::uint64_t casters_revision = 0;
  bool operator==(const DepthMapKey& other) const;
};

struct DrawContext {
  const frame::Frame& frame;
  const TaskPool& pool;
  BinsPool& bins;
  InstructionSet instruction_set;
};

/// One depth map: a pass that touches nothing but positions, and alpha where a material is cut out (row 76).
shadow::DepthMap draw_depth_map(const DrawContext& context, const light::ShadowView& shadow_view,
                                CasterFaces faces, bool keeps_triangles);

class DepthMapCache {
 public:
  struct Found {
    DepthMaps maps;
    int drawn = 0;  // 0: all were kept
  };
  /// The maps of light `light`, drawn if those kept are of something else. Callers that ask at the same time wait.
  /// `anew`: drawn in any case.
  Found find(std::size_t light, const DepthMapKey& key, const DrawContext& context, bool anew);

 private:
  struct Entry {
    DepthMapKey key;
    DepthMaps maps;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;
};

}  // namespace laterna::render
