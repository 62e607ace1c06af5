// Parts of a bake that are finished, in files beside what is being made, so that one that was stopped goes on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "image/environment_cache.h"

namespace laterna::bake {

/// Files "room.glb.bake-0-3": the fourth strip of the first page. Each is written beside its place and renamed; one that is
/// damaged, cut short or of another scene is as if it were not there.
class StripFiles {
 public:
  /// An empty `file` keeps nothing. `key`: of all that the light depends on. `resume`: what is there is taken.
  StripFiles(std::filesystem::path file, const image::ContentKey& key, bool resume)
      : file_(std::move(file)), key_(key), resume_(resume) {}

  /// As many numbers as `values` holds. False: it is not there.
  [[nodiscard]] bool find(std::size_t page, std::size_t strip, std::span<float> values);
  /// A disk that is full costs only what cannot be resumed.
  void keep(std::size_t page, std::size_t strip, std::span<const float> values);
  /// All of this bake, found or kept.
  void remove();

 private:
  [[nodiscard]] std::filesystem::path path_of(std::size_t page, std::size_t strip) const;

  std::filesystem::path file_;
  image::ContentKey key_;
  bool resume_;
  std::vector<std::filesystem::path> there_;
};

}  // namespace laterna::bake
