// What was worked out from environments, kept in a folder from run to run.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "image/environment_map.h"

namespace laterna::image {

/// Tells contents apart: 128 bits that depend on every byte added.
class ContentKey {
 public:
  void add(std::span<const std::byte> bytes);
  void add(std::uint64_t number);
  /// 32 hexadecimal digits.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] const std::array<std::uint64_t, 2>& words() const { return words_; }

 private:
  std::array<std::uint64_t, 2> words_ = {0xCBF29CE484222325ULL, 0x9AE16A3B2F90404FULL};
};

/// Of the texels of a picture in a chart, and of how maps are made.
ContentKey environment_key(EnvironmentChart chart, int width, int height,
                           const std::vector<glm::vec3>& texels);

/// A folder of maps, one file for each content. Files are written beside their place and renamed, so that none is ever
/// half there; one that is damaged, cut short or of another version is as if it were not there. A folder that cannot be
/// used keeps nothing.
class EnvironmentCache {
 public:
  /// Empty: keeps nothing.
  EnvironmentCache(std::filesystem::path folder, std::uint64_t most_bytes)
      : folder_(std::move(folder)), most_bytes_(most_bytes) {}

  [[nodiscard]] std::optional<EnvironmentMap> find(const ContentKey& key) const;
  /// Then removes what was not used for longest, until all files together are no larger than they may be.
  void keep(const ContentKey& key, const EnvironmentMap& map) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(const ContentKey& key) const;
  void trim() const;

  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
};

}  // namespace laterna::image
