// Paraboloid maps, kept while nothing they show has changed; what stands still in them is drawn once, and what moves over it.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "render/caster_changes.h"
#include "shadow/paraboloid_map.h"

namespace laterna::render {

/// May be asked by several pictures at once, but not while the frame changes.
class ParaboloidMapCache {
 public:
  /// `casters`: changes of the frame that maps are drawn of. It stays while the cache lives.
  explicit ParaboloidMapCache(const CasterChanges& casters) : casters_(casters) {}

  struct Found {
    std::shared_ptr<const shadow::ParaboloidMap> map;
    bool is_made = false, is_updated = false;  // neither: kept as it was
  };
  /// The map of light `light`, drawn again if what is kept shows something else. Callers that ask for the same light at the
  /// same time wait. `anew`: in any case. Once `asks_to_stop`, texels may be missing.
  Found find(std::size_t light, const shadow::ParaboloidPair& pair, CasterFaces faces,
             const frame::Frame& frame, const TaskPool& pool, bool anew,
             const std::function<bool()>& asks_to_stop);
  /// When nobody draws: frees what was not used for longest, until no more than `most_bytes` are kept.
  void rest(std::size_t most_bytes);
  /// After the last rest().
  [[nodiscard]] std::size_t kept_bytes() const { return kept_bytes_; }

 private:
  using Map = std::shared_ptr<const shadow::ParaboloidMap>;
  struct Entry {
    std::mutex mutex;
    std::optional<shadow::ParaboloidPair> pair;
    CasterFaces faces = CasterFaces::both;
    Map shown, standing;  // null where they are to be drawn; the same where nothing has moved yet
    std::uint64_t casters_revision = 0;
    std::uint64_t used = 0;  // when
    [[nodiscard]] std::size_t bytes() const;
  };
  // Drops what changes of casters have made wrong.
  void forget_changed(Entry& entry) const;

  const CasterChanges& casters_;
  std::mutex mutex_;  // of the list
  std::uint64_t uses_ = 0;
  std::atomic<std::size_t> kept_bytes_ = 0;
  std::map<std::size_t, Entry> entries_;
};

}  // namespace laterna::render
