#include "outcome.h"

#include <fmt/format.h>

#include <cstdio>

namespace laterna::app {

int report(const Error& error) {
  for (const Diagnostic& diagnostic : error.diagnostics)
    fmt::print(stderr, "laterna: error: {}\n", to_string(diagnostic));
  return static_cast<int>(error.failure);
}

void report_warnings(const std::vector<Diagnostic>& warnings) {
  for (const Diagnostic& warning : warnings) fmt::print(stderr, "laterna: note: {}\n", to_string(warning));
}

}  // namespace laterna::app
