// Parts of a bake that are finished, in files beside what is being made, so that one that was stopped goes on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "image/environment_cache.h"
#include "laterna/result.h"

namespace laterna::bake {

/// Files "room.glb.bake-0-3": the fourth strip of the first page. Each is written beside its place and renamed; one that is
/// damaged, cut short or of other content is as if it were not there. remove_bake_parts() takes them away.
class PartFiles {
 public:
  /// Where a part's numbers are: read by keep(), written by find().
  using Values = std::vector<std::span<std::byte>>;

  /// What became of the parts that were looked for, those of every copy together. From one thread at a time.
  struct Tally {
    std::size_t asked = 0, found = 0, kept = 0;
    std::optional<Error> not_kept;  ///< why the first part that is in no file is in none
  };

  /// An empty `file` keeps nothing. `key`: of all that the parts depend on. `resume`: what is there is taken.
  PartFiles(std::filesystem::path file, const image::ContentKey& key, bool resume)
      : file_(std::move(file)), key_(key), resume_(resume), tally_(std::make_shared<Tally>()) {}

  /// Keeps nothing.
  static PartFiles none() { return {{}, {}, false}; }
  /// The same of what depends on these numbers too.
  [[nodiscard]] PartFiles with(std::initializer_list<double> numbers) const;
  [[nodiscard]] PartFiles with(std::span<const std::byte> bytes) const;

  /// As many bytes as the spans hold, one after the other. False: it is not there, and they are as before. `part`: lower-case
  /// letters, digits and '-'.
  [[nodiscard]] bool find(std::string_view part, const Values& values) const;
  /// A disk that is full costs only what cannot be resumed.
  void keep(std::string_view part, const Values& values) const;
  [[nodiscard]] const Tally& tally() const { return *tally_; }

 private:
  [[nodiscard]] bool read(std::string_view part, const Values& values) const;
  [[nodiscard]] std::filesystem::path path_of(std::string_view part) const;

  std::filesystem::path file_;
  image::ContentKey key_;
  bool resume_;
  std::shared_ptr<Tally> tally_;
};

}  // namespace laterna::bake
