// The text of a lamp file: lines, and numbers that may stand anywhere on them. Reports where something else stands.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/fault_list.h"

namespace laterna {

/// A number in C's notation, with a leading + or decimal comma if `allow_comma`. Nothing for anything else, infinities
/// and NaN among it.
std::optional<double> parse_number(std::string_view text, bool allow_comma);

std::string_view trimmed(std::string_view text);

/// Ends of lines may be LF, CR LF or CR.
std::vector<std::string_view> split_lines(std::string_view text);

/// Numbers with blanks, commas or ends of lines between them. After the first fault it gives none.
class NumberStream {
 public:
  enum class Comma { separates, is_decimal_point };
  NumberStream(const std::vector<std::string_view>& lines, std::size_t first_line, Comma comma,
               FaultList& faults)
      : lines_(lines), line_(first_line), comma_(comma), faults_(faults) {}

  /// What is wanted; asked for only where it is not there.
  using Describe = std::function<std::string()>;

  std::optional<double> next(const Describe& describe);
  /// At least `low`, at most `high`.
  std::optional<double> next(const Describe& describe, double low, double high);
  std::optional<std::size_t> next_count(const std::string& what, std::size_t low, std::size_t high);
  /// Ascending by at least kLeastLampStep, within [low, high]. Nothing when faulty.
  std::optional<std::vector<double>> next_angles(std::string_view which, std::size_t count, double low,
                                                 double high);
  /// Reports when anything follows.
  bool expect_end(const Describe& after);

  /// The line that the last number stood on, counted from 1.
  [[nodiscard]] std::string place() const;
  /// Reports at place().
  void fault(std::string message);

 private:
  std::optional<std::string_view> next_word();

  const std::vector<std::string_view>& lines_;
  std::size_t line_, column_ = 0;
  std::size_t word_line_ = 0;
  Comma comma_;
  FaultList& faults_;
  bool is_faulty_ = false;
};

}  // namespace laterna
