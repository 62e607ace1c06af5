#include "render/caster_changes.h"

#include <algorithm>
#include <glm/common.hpp>

namespace laterna::render {
namespace {

frame::Bounds bounds_of(const frame::Frame& frame, std::uint32_t first, std::uint32_t end) {
  frame::Bounds bounds;
  for (std::uint32_t i = first; i < end; ++i) {
    const Cluster& c = frame.clusters[i];
    const glm::vec3 low(c.low_ws[0], c.low_ws[1], c.low_ws[2]);
    const glm::vec3 high(c.high_ws[0], c.high_ws[1], c.high_ws[2]);
    bounds.low = bounds.is_empty ? low : glm::min(bounds.low, low);
    bounds.high = bounds.is_empty ? high : glm::max(bounds.high, high);
    bounds.is_empty = false;
  }
  return bounds;
}

std::uint32_t end_of(const frame::PlacedPart& part) {
  return part.first_cluster + static_cast<std::uint32_t>(part.clustered->clusters.size());
}

bool casts(const frame::PlacedPart& part) {
  return (part.flags & (kCastsShadow | kPaneFlags)) == kCastsShadow;
}

// Of clusters, and of the part that they belong to, if it is one that moves: its clusters get its flags when it is posed.
void set_moves(frame::Frame& frame, std::uint32_t first, std::uint32_t end, bool moves) {
  const auto set = [&](std::uint32_t& flags) { flags = moves ? flags | kMoves : flags & ~kMoves; };
  for (std::uint32_t i = first; i < end; ++i) set(frame.clusters[i].flags);
  const auto part =
      std::ranges::lower_bound(frame.moving_parts, first, {}, &frame::PlacedPart::first_cluster);
  if (part != frame.moving_parts.end() && part->first_cluster == first && end_of(*part) == end)
    set(part->flags);
}

}  // namespace

void CasterChanges::forget(frame::Frame& frame) {
  known_from_ = ++revision_;
  for (Cluster& cluster : frame.clusters) cluster.flags &= ~kMoves;
  for (frame::PlacedPart& part : frame.moving_parts) part.flags &= ~kMoves;
  movers_.clear();
  remembered_.clear();
}

CasterChanges::Before CasterChanges::look_at(const frame::Frame& frame) {
  Before before;
  before.poses.reserve(frame.moving_parts.size());
  before.bounds.reserve(frame.moving_parts.size());
  for (const frame::PlacedPart& part : frame.moving_parts) {
    before.poses.push_back(part.pose);
    before.bounds.push_back(bounds_of(frame, part.first_cluster, end_of(part)));
  }
  return before;
}

bool CasterChanges::note(const Before& before, const std::vector<bool>& materials, frame::Frame& frame) {
  now_.clear();
  // Noted as of the revision to come.
  ++revision_;
  for (std::size_t i = 0; i < before.poses.size(); ++i) {
    const frame::PlacedPart& part = frame.moving_parts[i];
    if (part.pose == before.poses[i] || !casts(part) || part.clustered->clusters.empty()) continue;
    note_change(part.first_cluster, end_of(part), before.bounds[i], frame);
  }
  if (!materials.empty()) note_materials(materials, frame);
  if (now_.empty()) {
    --revision_;
    return false;
  }
  let_rest(frame);
  const bool stands_otherwise =
      std::ranges::any_of(now_, [](const CasterChange& c) { return c.stood_before || c.stands_after; });
  remember();
  return stands_otherwise;
}

void CasterChanges::note_change(std::uint32_t first, std::uint32_t end, const frame::Bounds& before,
                                frame::Frame& frame) {
  const bool stood = std::any_of(frame.clusters.begin() + first, frame.clusters.begin() + end,
                                 [](const Cluster& c) { return (c.flags & kMoves) == 0; });
  if (stood) set_moves(frame, first, end, true);
  // Runs of materials and of parts that move may overlap.
  const auto same = [&](const Mover& mover) {
    return mover.first_cluster == first && mover.end_cluster == end;
  };
  const auto known = std::ranges::find_if(movers_, same);
  if (known != movers_.end()) {
    known->changed_at = revision_;
  } else {
    movers_.push_back({first, end, revision_});
  }
  now_.push_back({before, bounds_of(frame, first, end), stood, false});
}

// Primitives have one material each, and their clusters follow one another.
void CasterChanges::note_materials(const std::vector<bool>& materials, frame::Frame& frame) {
  const auto same_primitive = [&](std::size_t a, std::size_t b) {
    return frame.clusters[a].object == frame.clusters[b].object &&
           frame.clusters[a].material == frame.clusters[b].material;
  };
  // Of one object several primitives may have one material: what moves is noted part by part, here as where poses change.
  const auto parts_meet_at = [&](std::size_t cluster) {
    const auto next =
        std::ranges::lower_bound(frame.moving_parts, cluster, {}, &frame::PlacedPart::first_cluster);
    if (next != frame.moving_parts.end() && next->first_cluster == cluster) return true;
    return next != frame.moving_parts.begin() && end_of(*std::prev(next)) == cluster;
  };
  std::size_t end = 0;
  for (std::size_t first = 0; first < frame.clusters.size(); first = end) {
    end = first + 1;
    if (!is_opaque_caster(frame.clusters[first]) || !materials[frame.clusters[first].material]) continue;
    while (end < frame.clusters.size() && same_primitive(first, end) && !parts_meet_at(end)) ++end;
    const auto begin = static_cast<std::uint32_t>(first);
    const auto stop = static_cast<std::uint32_t>(end);
    note_change(begin, stop, bounds_of(frame, begin, stop), frame);
  }
}

void CasterChanges::let_rest(frame::Frame& frame) {
  std::erase_if(movers_, [&](const Mover& mover) {
    if (revision_ - mover.changed_at < kRestAfter) return false;
    set_moves(frame, mover.first_cluster, mover.end_cluster, false);
    const frame::Bounds bounds = bounds_of(frame, mover.first_cluster, mover.end_cluster);
    now_.push_back({bounds, bounds, false, true});
    return true;
  });
}

void CasterChanges::remember() {
  remembered_.push_back({revision_, std::move(now_)});
  now_ = {};
  std::size_t count = 0;
  for (const Revision& revision : remembered_) count += revision.changes.size();
  while (!remembered_.empty() && (count > kMostRemembered || remembered_.size() > kMostRevisions)) {
    known_from_ = remembered_.front().number;
    count -= remembered_.front().changes.size();
    remembered_.pop_front();
  }
}

std::optional<std::vector<CasterChange>> CasterChanges::since(std::uint64_t revision) const {
  if (revision < known_from_) return std::nullopt;
  std::vector<CasterChange> changes;
  for (const Revision& later : remembered_) {
    if (later.number <= revision) continue;
    changes.insert(changes.end(), later.changes.begin(), later.changes.end());
  }
  return changes;
}

}  // namespace laterna::render
