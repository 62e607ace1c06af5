// Words and numbers of text files, line by line. Numbers do not depend on the locale.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace laterna {

/// The lines of a text, without their ends; a last line that is empty is none.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : text_(text) {}
  /// False at the end.
  bool next();
  [[nodiscard]] std::string_view line() const { return line_; }
  [[nodiscard]] std::size_t number() const { return number_; }  ///< from 1

 private:
  std::string_view text_, line_;
  std::size_t at_ = 0, number_ = 0;
};

/// Separated by spaces and tabs.
std::vector<std::string_view> words_of(std::string_view line);
/// What is behind the first `count` words, without spaces at its ends.
std::string_view rest_after_words(std::string_view line, std::size_t count);
/// The whole word as a finite number in C's notation, with a + before it or not.
std::optional<double> number_of(std::string_view word);

}  // namespace laterna
