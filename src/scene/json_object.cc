#include "scene/json_object.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "scene/spelling.h"

namespace laterna {

bool NumberRange::holds(double value) const {
  if (!std::isfinite(value)) return false;
  return (open_low ? value > low : value >= low) && (open_high ? value < high : value <= high);
}

std::string NumberRange::expectation() const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (!has_low && !has_high) return "a number";
  if (has_low && has_high && open_low && open_high)
    return fmt::format("a number between {} and {}", low, high);
  std::string text = "a number";
  if (has_low && has_high && !open_low && !open_high) return text + fmt::format(" from {} to {}", low, high);
  if (has_low) text += fmt::format(" {} {}", open_low ? "greater than" : "of at least", low);
  if (has_high)
    text += fmt::format("{} {} {}", has_low ? " and" : "", open_high ? "less than" : "at most", high);
  return text;
}

JsonObject::JsonObject(const JsonDocument& json, const JsonValue& value, FaultList& faults,
                       const SettingNames& names)
    : json_(json), value_(value), faults_(faults), names_(names) {
  if (!value.is_object()) error({}, fmt::format("expected an object, got {}", describe(value)));
}

std::string JsonObject::place(std::string_view member) const {
  return member.empty() ? json_.place(value_) : json_.place(value_, names_.spelled(member));
}

std::string JsonObject::quoted(std::string_view name) const {
  return fmt::format("\"{}\"", names_.spelled(name));
}

void JsonObject::error(std::string_view member, std::string message) {
  faults_.error(place(member), std::move(message));
}

void JsonObject::warning(std::string_view member, std::string message) {
  faults_.warning(place(member), std::move(message));
}

const JsonValue* JsonObject::any(std::string_view name) {
  asked_for_.push_back(names_.spelled(name));
  return value_.find(asked_for_.back());
}

const JsonValue* JsonObject::find(std::string_view name, JsonValue::Kind kind, std::string_view expected) {
  const JsonValue* member = any(name);
  if (member == nullptr || member->kind == kind) return member;
  error(name, fmt::format("expected {}, got {}", expected, describe(*member)));
  return nullptr;
}

std::optional<double> JsonObject::number(std::string_view name, const NumberRange& range) {
  const JsonValue* member = any(name);
  if (member == nullptr) return std::nullopt;
  if (member->kind == JsonValue::Kind::number && range.holds(member->number)) return member->number;
  error(name, fmt::format("expected {}, got {}", range.expectation(), describe(*member)));
  return std::nullopt;
}

std::optional<Angle> JsonObject::angle(std::string_view name, const NumberRange& degrees) {
  if (!names_.angles_are_in_radians()) {
    const std::optional<double> value = number(name, degrees);
    return value ? std::optional(Angle::degrees(*value)) : std::nullopt;
  }
  constexpr double kSinglePrecision = 1 + 1e-7;
  NumberRange radians = degrees;
  radians.low = Angle::degrees(degrees.low).in_radians() *
                (degrees.low < 0 && !degrees.open_low ? kSinglePrecision : 1);
  radians.high = Angle::degrees(degrees.high).in_radians() * (degrees.open_high ? 1 : kSinglePrecision);
  const std::optional<double> value = number(name, radians);
  if (!value) return std::nullopt;
  return std::clamp(Angle::radians(*value), Angle::degrees(degrees.low), Angle::degrees(degrees.high));
}

std::optional<bool> JsonObject::boolean(std::string_view name) {
  const JsonValue* member = find(name, JsonValue::Kind::boolean, "true or false");
  if (member == nullptr) return std::nullopt;
  return member->boolean;
}

std::optional<std::string> JsonObject::string(std::string_view name) {
  const JsonValue* member = find(name, JsonValue::Kind::string, "a string");
  if (member == nullptr) return std::nullopt;
  return member->text;
}

const JsonValue* JsonObject::array(std::string_view name) {
  return find(name, JsonValue::Kind::array, "an array");
}

const JsonValue* JsonObject::object(std::string_view name) {
  return find(name, JsonValue::Kind::object, "an object");
}

bool JsonObject::read_numbers(std::string_view name, const NumberRange& range, std::span<double> values) {
  const JsonValue* member = any(name);
  if (member == nullptr) return false;
  if (!member->is_array() || member->children.size() != values.size()) {
    error(name, fmt::format("expected an array of {} numbers, got {}", values.size(), describe(*member)));
    return false;
  }
  bool fits = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const JsonValue& element = member->children[i];
    values[i] = element.number;
    if (element.kind == JsonValue::Kind::number && range.holds(element.number)) continue;
    faults_.error(json_.place(element),
                  fmt::format("expected {}, got {}", range.expectation(), describe(element)));
    fits = false;
  }
  return fits;
}

std::optional<std::uint64_t> JsonObject::whole(std::string_view name, std::uint64_t least,
                                               std::uint64_t most) {
  const JsonValue* member = any(name);
  if (member == nullptr) return std::nullopt;
  const double number = member->number;
  if (member->kind == JsonValue::Kind::number && number >= static_cast<double>(least) &&
      number <= static_cast<double>(most) && number == std::floor(number)) {
    return static_cast<std::uint64_t>(number);
  }
  const std::string expected = most >= kMaxWhole ? fmt::format("a whole number of at least {}", least)
                                                 : fmt::format("a whole number from {} to {}", least, most);
  error(name, fmt::format("expected {}, got {}", expected, describe(*member)));
  return std::nullopt;
}

int JsonObject::index(std::string_view name, std::size_t count, std::string_view list) {
  const std::optional<std::uint64_t> index = whole(name);
  if (!index) return -1;
  if (*index < count) return static_cast<int>(*index);
  error(name, count == 0
                  ? fmt::format("refers to {}[{}], but there are no {}", list, *index, list)
                  : fmt::format("refers to {}[{}], but the last is {}[{}]", list, *index, list, count - 1));
  return -1;
}

std::optional<std::size_t> JsonObject::read_choice(std::string_view name,
                                                   std::vector<std::string_view> words) {
  for (std::string_view& word : words) word = names_.spelled(word);
  const JsonValue* member = any(name);
  if (member == nullptr) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), member->text);
  if (member->kind == JsonValue::Kind::string && found != words.end()) {
    return static_cast<std::size_t>(found - words.begin());
  }
  error(name, fmt::format("expected one of \"{}\", got {}{}", fmt::join(words, "\", \""), describe(*member),
                          did_you_mean(member->text, words)));
  return std::nullopt;
}

bool JsonObject::require(std::string_view name) {
  if (has(name) || !value_.is_object()) return has(name);
  error(name, "is missing");
  return false;
}

bool JsonObject::require_all(std::initializer_list<std::string_view> names) {
  bool has_all = true;
  for (const std::string_view name : names) has_all &= require(name);
  return has_all;
}

void JsonObject::report_unknown_members(std::string_view what) {
  for (const JsonValue& member : value_.children) {
    if (!value_.is_object()) return;
    if (std::find(asked_for_.begin(), asked_for_.end(), member.key) != asked_for_.end()) continue;
    if (faults_.is_full()) {
      faults_.error({}, {});
      continue;
    }
    std::vector<std::string_view> unused;
    for (const std::string_view known : asked_for_) {
      if (value_.find(known) == nullptr) unused.push_back(known);
    }
    faults_.error(json_.place(member), fmt::format("{} has no key {}{}", what, in_quotes(member.key),
                                                   did_you_mean(member.key, unused)));
  }
}

}  // namespace laterna
