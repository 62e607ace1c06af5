#include "scene/text_numbers.h"

#include <charconv>
#include <cmath>

namespace laterna {
namespace {

constexpr std::string_view kSpaces = " \t\r\v\f";

}  // namespace

bool TextLines::next() {
  if (at_ >= text_.size()) return false;
  const std::size_t end = text_.find('\n', at_);
  line_ = text_.substr(at_, end == std::string_view::npos ? end : end - at_);
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  at_ = end == std::string_view::npos ? text_.size() : end + 1;
  ++number_;
  return true;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kSpaces); at != std::string_view::npos;) {
    const std::size_t end = line.find_first_of(kSpaces, at);
    words.push_back(line.substr(at, end == std::string_view::npos ? end : end - at));
    at = end == std::string_view::npos ? end : line.find_first_not_of(kSpaces, end);
  }
  return words;
}

std::string_view rest_after_words(std::string_view line, std::size_t count) {
  std::size_t at = line.find_first_not_of(kSpaces);
  for (; count > 0 && at != std::string_view::npos; --count) {
    const std::size_t end = line.find_first_of(kSpaces, at);
    at = end == std::string_view::npos ? end : line.find_first_not_of(kSpaces, end);
  }
  if (at == std::string_view::npos) return {};
  return line.substr(at, line.find_last_not_of(kSpaces) + 1 - at);
}

std::optional<double> number_of(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace laterna
