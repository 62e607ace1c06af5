// Names of numbered outputs, such as frame.####.png.
#pragma once

#include <cstdint>
#include <string>

#include "laterna/result.h"

namespace laterna::app {

/// A file's name with one run of #, where a number goes: at least as many digits as there are.
class NumberedName {
 public:
  /// Error, for the option that asks for it: there is no #, or more than one run, or one in the name of a folder.
  /// takes_films: whether the option writes films, too, which the error then tells.
  static Result<NumberedName> parse(const char* option, const std::string& output, bool takes_films);
  [[nodiscard]] std::string with(std::int64_t number) const;

 private:
  NumberedName(std::string before, std::size_t digits, std::string after)
      : before_(std::move(before)), after_(std::move(after)), digits_(digits) {}
  std::string before_, after_;
  std::size_t digits_;
};

}  // namespace laterna::app
