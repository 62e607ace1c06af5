// Shadow maps, drawn when needed and kept while nothing they show has changed (rows 77, 78, 105).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "frame/frame.h"
#include "light/light_plan.h"
#include "render/reuse_pool.h"
#include "shadow/depth_map.h"

namespace laterna::render {

using DepthMaps = std::vector<std::shared_ptr<shadow::DepthMap>>;

/// What a depth map shows is given by its view, its size, how it is drawn, and the casters.
struct DepthMapKey {
  std::vector<light::ShadowView> views;
  CasterFaces faces = CasterFaces::both;
  bool keeps_triangles = true;
  std::uint64_t casters_revision = 0;
  /// The same but for the views.
  [[nodiscard]] bool has_same_casters(const DepthMapKey& other) const;
  bool operator==(const DepthMapKey& other) const;
};

/// What drawing depth maps needs. All but the pool stays while a map lives.
struct DrawContext {
  const frame::Frame& frame;
  const TaskPool& pool;
  BinsPool& bins;
  InstructionSet instruction_set;
  StageTimes& times;  // what is done here and now is added
  std::size_t bins_owner = 0;
};

/// Sorted casters that the maps of one picture hold until it is done, in bytes. Maps beyond it are drawn whole, one after
/// the other.
inline constexpr std::size_t kMaxWorkingBytes = std::size_t{1} << 30U;

/// A depth map whose tiles are drawn as they are asked for. `outworn`: see DepthMap.
shadow::DepthMap make_depth_map(const DrawContext& context, const light::ShadowView& shadow_view,
                                CasterFaces faces, bool keeps_triangles, shadow::DepthMap outworn = {});
/// The same, with every tile drawn.
shadow::DepthMap draw_depth_map(const DrawContext& context, const light::ShadowView& shadow_view,
                                CasterFaces faces, bool keeps_triangles, shadow::DepthMap outworn = {});

/// Draws every tile that is not drawn yet, and lets the map rest. `asks_to_stop` is called between tiles, where set; once it
/// says so, tiles may be missing.
void draw_tiles(shadow::DepthMap& map, const TaskPool& pool, StageTimes& times,
                const std::function<bool()>& asks_to_stop);

class DepthMapCache {
 public:
  struct Found {
    DepthMaps maps;
    int made = 0;  // 0: all were kept
  };
  /// The maps of light `light`, made anew if those kept are of something else. Callers that ask for the same light at
  /// the same time wait. `anew`: in any case. `working_bytes`: of the picture's maps so far. `asks_to_stop` is called
  /// between tiles; once it says so, maps may have tiles that are not drawn.
  Found find(std::size_t light, const DepthMapKey& key, const DrawContext& context, bool anew,
             std::size_t& working_bytes, const std::function<bool()>& asks_to_stop);
  /// Frees what only drawing needs, when nobody draws.
  void rest();

 private:
  struct Entry {
    std::mutex mutex;
    DepthMapKey key;
    DepthMaps maps;
  };
  ReusePool<shadow::DepthMap> outworn_;  // outlives the maps
  std::mutex mutex_;                     // of the list
  std::map<std::size_t, Entry> entries_;
};

}  // namespace laterna::render
