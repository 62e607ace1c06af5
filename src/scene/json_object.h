// Reads the members of one JSON object by name: checks their type and range, reports what does not fit with
// its place, and knows which members nobody asked for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "laterna/view.h"
#include "scene/fault_list.h"
#include "scene/json_document.h"
#include "scene/setting_names.h"

namespace laterna {

/// What a number may be. Infinity and NaN cannot be written in JSON; they appear only as bounds.
struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false, open_high = false;  ///< the bound itself is excluded

  [[nodiscard]] bool holds(double value) const;
  /// "a number greater than 0", "a number from 0 to 1", …
  [[nodiscard]] std::string expectation() const;
};

inline constexpr NumberRange kAnyNumber;
inline constexpr NumberRange kPositive{0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr NumberRange kNotNegative{0, std::numeric_limits<double>::infinity(), false, false};
inline constexpr NumberRange kZeroToOne{0, 1, false, false};

class JsonObject {
 public:
  /// Reports when `value` is not an object, and then behaves as an empty one. Members, and words among their values, are
  /// looked for as `names` spells them.
  JsonObject(const JsonDocument& json, const JsonValue& value, FaultList& faults,
             const SettingNames& names = kRigNames);

  [[nodiscard]] const JsonValue& value() const { return value_; }
  [[nodiscard]] const SettingNames& names() const { return names_; }
  [[nodiscard]] bool has(std::string_view name) const { return value_.find(names_.spelled(name)) != nullptr; }
  /// "name" as the file spells it, in quotes, for messages.
  [[nodiscard]] std::string quoted(std::string_view name) const;

  /// Each reader returns nothing when the member is absent, and reports and returns nothing when it does not
  /// fit.
  std::optional<double> number(std::string_view name, const NumberRange& range = kAnyNumber);
  /// `degrees` is what it may be; files with angles in radians may exceed it by what single precision rounds.
  std::optional<Angle> angle(std::string_view name, const NumberRange& degrees);
  std::optional<bool> boolean(std::string_view name);
  std::optional<std::string> string(std::string_view name);
  const JsonValue* array(std::string_view name);
  const JsonValue* object(std::string_view name);
  /// Any kind of value.
  const JsonValue* any(std::string_view name);

  /// Exactly N numbers, each in `range`.
  template <std::size_t N>
  std::optional<std::array<double, N>> numbers(std::string_view name, const NumberRange& range = kAnyNumber) {
    std::array<double, N> values{};
    if (!read_numbers(name, range, values)) return std::nullopt;
    return values;
  }

  /// A whole number from 0 to `most`; `most` is at most 2^53, so that no later sum of a few overflows 64
  /// bits.
  std::optional<std::uint64_t> whole(std::string_view name, std::uint64_t least = 0,
                                     std::uint64_t most = kMaxWhole);

  /// A reference into a list of `count` things that the message calls `list`; −1 when absent or faulty.
  int index(std::string_view name, std::size_t count, std::string_view list);

  /// One of a few words.
  template <class Choice>
  std::optional<Choice> choice(std::string_view name,
                               std::initializer_list<std::pair<std::string_view, Choice>> choices) {
    return choice<Choice>(
        name, std::span<const std::pair<std::string_view, Choice>>(choices.begin(), choices.size()));
  }
  template <class Choice>
  std::optional<Choice> choice(std::string_view name,
                               std::span<const std::pair<std::string_view, Choice>> choices) {
    std::vector<std::string_view> words;
    for (const auto& entry : choices) words.push_back(entry.first);
    const std::optional<std::size_t> which = read_choice(name, std::move(words));
    if (!which) return std::nullopt;
    return choices[*which].second;
  }

  /// Reports a member that must be there and is not. Returns whether it is.
  bool require(std::string_view name);
  /// The same for several; reports each one that is missing.
  bool require_all(std::initializer_list<std::string_view> names);

  /// Reports every member that was never asked for, with the one that was probably meant.
  void report_unknown_members(std::string_view what);

  /// Reports at one member, or at the object when the name is empty.
  void error(std::string_view member, std::string message);
  void warning(std::string_view member, std::string message);

  static constexpr std::uint64_t kMaxWhole = std::uint64_t{1} << 53;

 private:
  const JsonValue* find(std::string_view name, JsonValue::Kind kind, std::string_view expected);
  bool read_numbers(std::string_view name, const NumberRange& range, std::span<double> values);
  std::optional<std::size_t> read_choice(std::string_view name, std::vector<std::string_view> words);
  [[nodiscard]] std::string place(std::string_view member) const;

  const JsonDocument& json_;
  const JsonValue& value_;
  FaultList& faults_;
  const SettingNames& names_;
  std::vector<std::string_view> asked_for_;
};

}  // namespace laterna
