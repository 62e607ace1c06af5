// Names of numbered pictures: "frame.####.png", "frame_%04d.png".
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "laterna/result.h"

namespace laterna::image {

/// The place of the number in a file's name (not in its folder's).
struct NumberPattern {
  std::string before, after;
  std::size_t digits = 1;  ///< at least so many, filled up with zeros
};

/// Nothing: the name has neither # nor %d.
std::optional<NumberPattern> find_number_pattern(const std::filesystem::path& file);

/// The number that a file's name holds; nothing where it does not fit the pattern. A number may have more digits than asked
/// for, but then begins with no zero, so that each number has one spelling.
std::optional<std::uint64_t> number_in_name(const NumberPattern& pattern, const std::string& name);

/// The files of a pattern by their numbers, without a gap. Error: the pattern has several places for a number, no file
/// fits, the folder cannot be read, a number is missing, or there are more than kMaxFilmFrames.
Result<std::map<std::uint64_t, std::filesystem::path>> find_numbered_files(const std::filesystem::path& file);

}  // namespace laterna::image
