#include "scene/lamp_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "laterna/lamps.h"
#include "scene/spelling.h"
#include "scene/text_numbers.h"

namespace laterna {
namespace {

// Old programs end texts with ^Z or fill them up with NUL.
bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v' || c == '\x1A' ||
         c == '\0';
}

constexpr std::size_t kLongestShown = 40;

}  // namespace

std::optional<double> parse_number(std::string_view text, bool allow_comma) {
  std::string with_point(text);
  if (allow_comma) std::replace(with_point.begin(), with_point.end(), ',', '.');
  return number_of(with_point);
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    lines.push_back(text.substr(0, end));
    const bool is_pair = text.substr(end, 2) == "\r\n";
    text.remove_prefix(std::min(end + (is_pair ? 2 : 1), text.size()));
  }
  return lines;
}

std::optional<std::string_view> NumberStream::next_word() {
  const auto separates = [&](char c) { return is_blank(c) || (c == ',' && comma_ == Comma::separates); };
  for (; line_ < lines_.size(); ++line_, column_ = 0) {
    const std::string_view line = lines_[line_];
    while (column_ < line.size() && separates(line[column_])) ++column_;
    if (column_ == line.size()) continue;
    const std::size_t begin = column_;
    while (column_ < line.size() && !separates(line[column_])) ++column_;
    word_line_ = line_;
    return line.substr(begin, column_ - begin);
  }
  return std::nullopt;
}

std::string NumberStream::place() const { return fmt::format("line {}", word_line_ + 1); }

void NumberStream::fault(std::string message) {
  if (!is_faulty_) faults_.error(place(), std::move(message));
  is_faulty_ = true;
}

std::optional<double> NumberStream::next(const Describe& describe) {
  if (is_faulty_) return std::nullopt;
  const std::optional<std::string_view> word = next_word();
  if (!word) {
    word_line_ = lines_.empty() ? 0 : lines_.size() - 1;
    fault(fmt::format("the file ends before {}", describe()));
    return std::nullopt;
  }
  const std::optional<double> value = parse_number(*word, comma_ == Comma::is_decimal_point);
  if (!value)
    fault(fmt::format("expected {}, got {}", describe(), in_quotes(word->substr(0, kLongestShown))));
  return value;
}

std::optional<double> NumberStream::next(const Describe& describe, double low, double high) {
  const std::optional<double> value = next(describe);
  if (!value || (*value >= low && *value <= high)) return value;
  fault(fmt::format("expected {}, from {} to {}, got {}", describe(), low, high, *value));
  return std::nullopt;
}

std::optional<std::size_t> NumberStream::next_count(const std::string& what, std::size_t low,
                                                    std::size_t high) {
  const std::optional<double> value = next([&] { return what; });
  if (!value) return std::nullopt;
  if (*value >= static_cast<double>(low) && *value <= static_cast<double>(high) &&
      *value == std::floor(*value))
    return static_cast<std::size_t>(*value);
  fault(fmt::format("expected {}, a whole number from {} to {}, got {}", what, low, high, *value));
  return std::nullopt;
}

std::optional<std::vector<double>> NumberStream::next_angles(std::string_view which, std::size_t count,
                                                             double low, double high) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < count; ++i) {
    const auto describe = [&] { return fmt::format("{} angle {} of {}", which, i + 1, count); };
    const std::optional<double> angle = next(describe, low, high);
    if (!angle) return std::nullopt;
    if (!angles.empty() && *angle - angles.back() < kLeastLampStep) {
      fault(fmt::format("expected {} to be more than the {} before it, got {}", describe(), angles.back(),
                        *angle));
      return std::nullopt;
    }
    angles.push_back(*angle);
  }
  return angles;
}

bool NumberStream::expect_end(const Describe& after) {
  if (is_faulty_) return false;
  const std::optional<std::string_view> word = next_word();
  if (!word) return true;
  fault(fmt::format("expected the file to end after {}, got {}", after(),
                    in_quotes(word->substr(0, kLongestShown))));
  return false;
}

}  // namespace laterna
