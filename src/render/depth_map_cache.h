// Shadow maps, drawn when needed and kept while nothing they show has changed (rows 77, 78, 105).
#pragma once

#include <atomic>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "frame/frame.h"
#include "light/light_plan.h"
#include "render/depth_map_painter.h"
#include "render/reuse_pool.h"
#include "shadow/depth_map.h"

namespace laterna::render {

using DepthMaps = std::vector<std::shared_ptr<shadow::DepthMap>>;

/// What depth maps show is given by their views, how they are drawn, and the casters.
struct DepthMapKey {
  std::vector<light::ShadowView> views;
  CasterFaces faces = CasterFaces::both;
  bool keeps_triangles = true;
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

/// A depth map of all casters, with every tile drawn. `outworn`: see DepthMap.
shadow::DepthMap draw_depth_map(const DrawContext& context, const light::ShadowView& shadow_view,
                                CasterFaces faces, bool keeps_triangles, shadow::DepthMap outworn = {});

/// Draws every tile that is not drawn yet, and lets the map rest. `asks_to_stop` is called between tiles, where set; once it
/// says so, tiles may be missing.
void draw_tiles(shadow::DepthMap& map, const TaskPool& pool, StageTimes& times,
                const std::function<bool()>& asks_to_stop);

/// Whose maps they are.
struct DepthMapOwner {
  std::size_t light = 0;
  /// Of maps that follow the camera: the mirrored view that they are for (light::MirrorView::reflections). Else empty, so that all
  /// views share them.
  std::vector<int> reflections;
  auto operator<=>(const DepthMapOwner&) const = default;
};

/// May be asked by several pictures at once, but not while the frame changes.
class DepthMapCache {
 public:
  /// `casters`: changes of the frame that maps are drawn of. It stays while the cache lives.
  explicit DepthMapCache(const CasterChanges& casters) : casters_(casters) {}

  struct Found {
    DepthMaps maps;
    int made = 0, updated = 0;     // the others were kept as they were
    std::uint64_t tiles_kept = 0;  // drawn for earlier pictures, and still so
  };
  /// The owner's maps, made anew if those kept are of something else; where casters have moved in them, tiles that
  /// those touch are forgotten. Callers that ask for the same owner at the same time wait. `anew`: in any case.
  /// `working_bytes`: of the picture's maps so far. `asks_to_stop` is called between tiles; once it says so, maps may have
  /// tiles that are not drawn.
  Found find(const DepthMapOwner& owner, const DepthMapKey& key, const DrawContext& context, bool anew,
             std::size_t& working_bytes, const std::function<bool()>& asks_to_stop);
  /// While pictures are drawn: the same as rest(), of maps that none of them uses now.
  void make_room(std::size_t most_bytes);
  /// When nobody draws: frees what is not needed for maps that are complete, then what was not used for longest, until no
  /// more than `most_bytes` are kept.
  void rest(std::size_t most_bytes);
  /// After the last rest().
  [[nodiscard]] std::size_t kept_bytes() const { return kept_bytes_; }
  /// So far.
  [[nodiscard]] const MapWork& work() const { return work_; }

 private:
  struct KeptMap {
    light::ShadowView view;
    std::shared_ptr<shadow::DepthMap> map;
    DepthMapPainter* painter = nullptr;  // the map's
    std::uint64_t casters_revision = 0;
    [[nodiscard]] std::size_t bytes() const { return map->memory_bytes() + painter->kept_bytes(); }
  };
  struct Entry {
    std::mutex mutex;
    CasterFaces faces = CasterFaces::both;
    bool keeps_triangles = true;
    std::vector<KeptMap> maps;
    std::uint64_t used = 0;  // when
  };

  // Which of the maps is of that view, if any, whatever has moved since.
  [[nodiscard]] static std::vector<KeptMap>::iterator find_view(std::vector<KeptMap>& maps,
                                                                const light::ShadowView& view,
                                                                const frame::Frame& frame);
  // Brings the map to how casters are now. False: it has to be made anew.
  [[nodiscard]] bool update(KeptMap& kept, Found& found) const;
  [[nodiscard]] KeptMap make(const light::ShadowView& view, const DepthMapKey& key,
                             const DrawContext& context);

  const CasterChanges& casters_;
  MapWork work_;
  ReusePool<shadow::DepthMap> outworn_;  // outlives the maps
  std::mutex mutex_;                     // of the list
  std::uint64_t uses_ = 0;
  std::atomic<std::size_t> kept_bytes_ = 0;
  std::map<DepthMapOwner, Entry> entries_;
};

}  // namespace laterna::render
