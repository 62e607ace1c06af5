#include "accuracy_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "scene_options.h"
#include "technique_names.h"

namespace laterna::app {
namespace {

constexpr AccuracyMeasure kMeasures[] = {{"false_lit", &ShadowAccuracy::false_lit},
                                         {"false_dark", &ShadowAccuracy::false_dark},
                                         {"acne", &ShadowAccuracy::acne},
                                         {"gap_texels", &ShadowAccuracy::gap_texels},
                                         {"edge_px_median", &ShadowAccuracy::edge_px_median},
                                         {"edge_px_p99", &ShadowAccuracy::edge_px_p99},
                                         {"ms", &ShadowAccuracy::ms},
                                         {"mb", &ShadowAccuracy::mb},
                                         {"edge_px_mean", &ShadowAccuracy::edge_px_mean},
                                         {"mean_error", &ShadowAccuracy::mean_error}};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<AccuracyLimit> parse_limit(const std::string& text) {
  const std::string_view all = trimmed(text);
  const std::size_t sign = all.find_first_of("<>");
  const bool is_closed = sign != std::string_view::npos && sign + 1 < all.size() && all[sign + 1] == '=';
  const std::optional<double> limit = sign == std::string_view::npos
                                          ? std::nullopt
                                          : number_in(trimmed(all.substr(sign + (is_closed ? 2 : 1))));
  if (!limit) {
    return tl::unexpected(bad_option(fmt::format(
        "--fail: expected a measure, one of > >= < <=, and a number, such as acne>0, got \"{}\"", text)));
  }
  const std::string_view name = trimmed(all.substr(0, sign));
  std::string known;
  for (const AccuracyMeasure& measure : kMeasures) {
    using Relation = AccuracyLimit::Relation;
    const Relation relation = all[sign] == '>' ? (is_closed ? Relation::at_least : Relation::above)
                                               : (is_closed ? Relation::at_most : Relation::below);
    if (measure.name == name) return AccuracyLimit{measure, relation, *limit, std::string(all)};
    known += fmt::format("{}{}", known.empty() ? "" : ", ", measure.name);
  }
  return tl::unexpected(
      bad_option(fmt::format("--fail: there is no measure \"{}\"; there are {}", name, known)));
}

}  // namespace

std::span<const AccuracyMeasure> accuracy_measures() { return kMeasures; }

bool AccuracyLimit::is_broken_by(const ShadowAccuracy& measured) const {
  const double value = measured.*measure.value;
  switch (relation) {
    case Relation::above:
      return value > limit;
    case Relation::at_least:
      return value >= limit;
    case Relation::below:
      return value < limit;
    case Relation::at_most:
      return value <= limit;
  }
  return false;
}

Result<std::vector<AccuracyLimit>> parse_limits(const std::string& list) {
  std::vector<AccuracyLimit> limits;
  for (const std::string& text : split_list(list)) {
    Result<AccuracyLimit> limit = parse_limit(text);
    if (!limit) return tl::unexpected(std::move(limit.error()));
    limits.push_back(std::move(*limit));
  }
  if (limits.empty() && !list.empty())
    return tl::unexpected(bad_option(fmt::format("--fail: \"{}\" names no measure", list)));
  return limits;
}

}  // namespace laterna::app
