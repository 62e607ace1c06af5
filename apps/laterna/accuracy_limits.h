// The measures of shadow accuracy by name, and limits on them: "false_lit>0.01,acne>0".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "laterna/accuracy.h"

namespace laterna::app {

struct AccuracyMeasure {
  std::string_view name;
  double ShadowAccuracy::*value;
};
/// In the order of the report.
std::span<const AccuracyMeasure> accuracy_measures();

/// What must not be.
struct AccuracyLimit {
  AccuracyMeasure measure;
  enum class Relation { above, at_least, below, at_most } relation = Relation::above;
  double limit = 0;
  std::string text;  ///< as it was given

  [[nodiscard]] bool is_broken_by(const ShadowAccuracy& measured) const;
};
/// Conditions with commas between, each a measure, one of > >= < <=, and a number. Error: something else.
Result<std::vector<AccuracyLimit>> parse_limits(const std::string& list);

}  // namespace laterna::app
