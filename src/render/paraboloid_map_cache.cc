#include "render/paraboloid_map_cache.h"

namespace laterna::render {

std::size_t ParaboloidMapCache::Entry::bytes() const {
  std::size_t bytes = shown == nullptr ? 0 : shown->memory_bytes();
  if (standing != nullptr && standing != shown) bytes += standing->memory_bytes();
  return bytes;
}

void ParaboloidMapCache::forget_changed(Entry& entry) const {
  const auto changes = casters_.since(entry.casters_revision);
  if (!changes) {
    entry.shown = entry.standing = nullptr;
    return;
  }
  for (const CasterChange& change : *changes) {
    if (change.stood_before || change.stands_after) entry.standing = nullptr;
    if (!change.stands_after) entry.shown = nullptr;
  }
}

ParaboloidMapCache::Found ParaboloidMapCache::find(std::size_t light, const shadow::ParaboloidPair& pair,
                                                   CasterFaces faces, const frame::Frame& frame,
                                                   const TaskPool& pool, bool anew,
                                                   const std::function<bool()>& asks_to_stop) {
  std::unique_lock list_lock(mutex_);
  Entry& entry = entries_[light];  // stays where it is
  entry.used = ++uses_;
  list_lock.unlock();
  const std::lock_guard lock(entry.mutex);
  const bool is_of_another = anew || entry.pair != pair || entry.faces != faces;
  const bool had_one = !is_of_another && entry.shown != nullptr;
  if (is_of_another) entry.shown = entry.standing = nullptr;
  forget_changed(entry);
  entry.pair = pair;
  entry.faces = faces;
  entry.casters_revision = casters_.revision();
  if (entry.shown != nullptr) return {entry.shown, false, false};
  using Casters = shadow::ParaboloidMap::Casters;
  const auto draw = [&](const Casters& casters, const shadow::ParaboloidMap* under) {
    return std::make_shared<const shadow::ParaboloidMap>(frame, pair, casters, under, pool, asks_to_stop);
  };
  const bool is_updated = had_one && casters_.has_movers();
  if (is_updated) {
    if (entry.standing == nullptr) entry.standing = draw({faces, kMoves, 0}, nullptr);
    entry.shown = draw({faces, kMoves, kMoves}, entry.standing.get());
  } else {
    entry.shown = draw({faces}, nullptr);
    entry.standing = casters_.has_movers() ? nullptr : entry.shown;
  }
  const Map found = entry.shown;
  if (asks_to_stop()) entry.shown = entry.standing = nullptr;
  return {found, !is_updated, is_updated};
}

// Lists would take memory, of which there may be none left.
void ParaboloidMapCache::rest(std::size_t most_bytes) {
  const std::lock_guard list_lock(mutex_);
  std::size_t bytes = 0;
  for (const auto& [light, entry] : entries_) bytes += entry.bytes();
  while (bytes > most_bytes) {
    Entry* longest_unused = nullptr;
    for (auto& [light, entry] : entries_) {
      const bool is_older = longest_unused == nullptr || entry.used < longest_unused->used;
      if (entry.bytes() > 0 && is_older) longest_unused = &entry;
    }
    bytes -= longest_unused->bytes();
    longest_unused->shown = longest_unused->standing = nullptr;
  }
  kept_bytes_ = bytes;
}

}  // namespace laterna::render
