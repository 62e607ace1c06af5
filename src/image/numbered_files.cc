#include "image/numbered_files.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "laterna/film.h"

namespace laterna::image {
namespace {

constexpr std::size_t kMostDigits = 18;  // of a number below 2⁶³

tl::unexpected<Error> fault(const std::filesystem::path& file, std::string message) {
  return tl::unexpected(Error(Failure::bad_input, Diagnostic{file.string(), {}, std::move(message)}));
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

struct Placeholder {
  std::size_t begin, end, digits;
};

// "%d", "%4d" or "%04d" at `at`.
std::optional<Placeholder> printf_number(const std::string& name, std::size_t at) {
  std::size_t end = at + 1;
  while (end < name.size() && is_digit(name[end])) ++end;
  if (end == name.size() || name[end] != 'd' || end > at + 4) return std::nullopt;
  std::size_t digits = 1;
  if (end > at + 1) std::from_chars(name.data() + at + 1, name.data() + end, digits);
  return Placeholder{at, end + 1, std::max<std::size_t>(digits, 1)};
}

// The first place for a number from `from` on.
std::optional<Placeholder> find_placeholder(const std::string& name, std::size_t from) {
  for (std::size_t at = from; at < name.size(); ++at) {
    if (name[at] == '#') {
      std::size_t end = name.find_first_not_of('#', at);
      if (end == std::string::npos) end = name.size();
      return Placeholder{at, end, end - at};
    }
    if (name[at] == '%') {
      if (const auto found = printf_number(name, at)) return found;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<NumberPattern> find_number_pattern(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const std::optional<Placeholder> place = find_placeholder(name, 0);
  if (!place) return std::nullopt;
  return NumberPattern{name.substr(0, place->begin), name.substr(place->end), place->digits};
}

std::optional<std::uint64_t> number_in_name(const NumberPattern& pattern, const std::string& name) {
  const std::size_t around = pattern.before.size() + pattern.after.size();
  if (name.size() < around + pattern.digits || name.size() > around + kMostDigits) return std::nullopt;
  if (!name.starts_with(pattern.before) || !name.ends_with(pattern.after)) return std::nullopt;
  const std::string digits = name.substr(pattern.before.size(), name.size() - around);
  if (digits.size() > pattern.digits && digits.front() == '0') return std::nullopt;
  std::uint64_t number = 0;
  const auto [end, wrong] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (wrong != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

Result<std::map<std::uint64_t, std::filesystem::path>> find_numbered_files(
    const std::filesystem::path& file) {
  const std::optional<NumberPattern> pattern = find_number_pattern(file);
  if (!pattern) return fault(file, "expected # or %d where the number of a picture stands");
  if (find_placeholder(pattern->after, 0))
    return fault(file, "expected one place for a number, as in frame.####.png, got several");
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::map<std::uint64_t, std::filesystem::path> files;
  std::error_code failure;
  for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const auto number = number_in_name(*pattern, entry->path().filename().string());
    if (number) files.emplace(*number, file.has_parent_path() ? entry->path() : entry->path().filename());
    if (files.size() > kMaxFilmFrames)
      return fault(
          file, "more than " + std::to_string(kMaxFilmFrames) + " files fit, the most that a film may have");
  }
  if (failure) return fault(folder, "cannot be read: " + failure.message());
  if (files.empty()) return fault(file, "no file fits this pattern of numbers");
  std::uint64_t expected = files.begin()->first;
  for (const auto& [number, path] : files) {
    if (number != expected++) {
      return fault(file, "number " + std::to_string(expected - 1) + " is missing: there are " +
                             std::to_string(files.begin()->first) + " to " +
                             std::to_string(files.rbegin()->first));
    }
  }
  return files;
}

}  // namespace laterna::image

namespace laterna {

bool is_numbered(const std::filesystem::path& file) {
  std::error_code ignored;
  return image::find_number_pattern(file).has_value() && !std::filesystem::is_regular_file(file, ignored);
}

}  // namespace laterna
