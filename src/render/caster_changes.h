// Which casters move, and where they went: so that what is made of casters is made anew only where they were and are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "frame/frame.h"

namespace laterna::render {

/// Set on clusters of casters that have moved or changed of late; beside ClusterFlag, from the other end. Shadow maps draw
/// them over what stands still.
inline constexpr std::uint32_t kMoves = 1U << 31U;
static_assert(kMoves > (std::uint32_t{kVisible} << 8U));

/// Of one instance of a primitive.
struct CasterChange {
  frame::Bounds before, after;
  bool stood_before = false;  ///< it was drawn with what stands still until now
  bool stands_after = false;  ///< it is from now on, where it already was: what is seen of it stays
};

/// Changes of a frame's opaque casters. After so many changes of others, what did not change counts as standing again.
class CasterChanges {
 public:
  static constexpr std::uint64_t kRestAfter = 32;
  /// No more changes are remembered, nor of more revisions.
  static constexpr std::size_t kMostRemembered = 4096, kMostRevisions = 64;

  /// Counts changes: equal numbers are equal casters.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  /// Whether any caster has kMoves.
  [[nodiscard]] bool has_movers() const { return !movers_.empty(); }
  /// What has changed since that revision, oldest first; nothing where that is not known, or everything has.
  [[nodiscard]] std::optional<std::vector<CasterChange>> since(std::uint64_t revision) const;

  /// The frame is another: nothing that was known of it holds, and everything stands.
  void forget(frame::Frame& frame);

  /// What moving parts looked like before the frame is posed anew.
  struct Before {
    std::vector<std::shared_ptr<const frame::MeshPose>> poses;  // one for each of the frame's moving parts
    std::vector<frame::Bounds> bounds;
  };
  [[nodiscard]] static Before look_at(const frame::Frame& frame);
  /// Notes the casters whose poses are others than `before`, and those of materials that let light through elsewhere
  /// (`materials`: one for each of the frame's surfaces; empty: none). True: what stands is not what stood before.
  bool note(const Before& before, const std::vector<bool>& materials, frame::Frame& frame);

 private:
  // A run of clusters.
  struct Mover {
    std::uint32_t first_cluster, end_cluster;
    std::uint64_t changed_at;  // revision
  };
  struct Revision {
    std::uint64_t number;
    std::vector<CasterChange> changes;
  };

  void note_change(std::uint32_t first, std::uint32_t end, const frame::Bounds& before, frame::Frame& frame);
  void note_materials(const std::vector<bool>& materials, frame::Frame& frame);
  void let_rest(frame::Frame& frame);
  void remember();

  std::uint64_t revision_ = 0;
  std::uint64_t known_from_ = 0;  // all later changes are remembered
  std::vector<Mover> movers_;
  std::vector<CasterChange> now_;  // being noted
  std::deque<Revision> remembered_;
};

}  // namespace laterna::render
