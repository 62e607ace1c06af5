// A JSON text as a tree in which every value knows where it stands: its path ("lights[0].color[2]") and its
// line. Read with nlohmann-json's event parser, whose own tree keeps no positions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "laterna/result.h"

namespace laterna {

struct JsonValue {
  enum class Kind : std::uint8_t { null, boolean, number, string, array, object };

  Kind kind = Kind::null;
  bool boolean = false;
  std::uint32_t index = 0;  ///< in the parent's list
  std::size_t offset =
      0;              ///< into the text, just behind the key (members) or the value's first token (elements)
  double number = 0;  ///< whole numbers are exact up to 2^53
  std::string text;   ///< of a string
  std::string key;    ///< of an object's member
  std::vector<JsonValue> children;  ///< of arrays and objects, in the order of the text
  const JsonValue* parent = nullptr;

  /// The member of that name; null when there is none or this is no object.
  [[nodiscard]] const JsonValue* find(std::string_view name) const;
  [[nodiscard]] bool is_array() const { return kind == Kind::array; }
  [[nodiscard]] bool is_object() const { return kind == Kind::object; }
};

/// The value in a message: 3.5, "text", true, null, "an array of 3", "an object".
std::string describe(const JsonValue& value);

class JsonDocument {
 public:
  /// Deeper nesting than any sane file has, and shallow enough for any stack.
  static constexpr std::size_t kMaxDepth = 256;
  /// Each value takes about 130 bytes: 2 GB in all.
  static constexpr std::size_t kMaxValues = std::size_t{1} << 24;

  enum class Place { path, line_and_path };

  /// Strict JSON in UTF-8: no comments, no trailing commas, no duplicate keys. `text` must outlive the
  /// document.
  static Result<JsonDocument> parse(std::string_view text, const std::string& file, Place place);

  [[nodiscard]] const JsonValue& root() const { return *root_; }
  [[nodiscard]] std::string path(const JsonValue& value) const;

  /// How diagnostics name the value: "lights[0].lux" or "line 7: lights[0].lux".
  [[nodiscard]] std::string place(const JsonValue& value) const;
  /// The same for a member that is missing or wrong as a whole.
  [[nodiscard]] std::string place(const JsonValue& object, std::string_view member) const;

 private:
  JsonDocument(std::string_view text, Place place);
  [[nodiscard]] std::size_t line(const JsonValue& value) const;

  std::string_view text_;
  std::vector<std::size_t> line_ends_;  // offsets of the newlines; for Place::line_and_path only
  Place place_;
  std::unique_ptr<JsonValue> root_;
};

}  // namespace laterna
