#include "scene/json_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "scene/spelling.h"

namespace laterna {
namespace {

constexpr std::size_t kMaxShownPath = 200;  // of hostile depth: the line says enough

// Walks the text and tells how far the parser has come: its events carry no positions.
class TrackedCharacter {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  TrackedCharacter(const char* at, const char** progress) : at_(at), progress_(progress) {}
  reference operator*() const { return *at_; }
  TrackedCharacter& operator++() {
    *progress_ = ++at_;
    return *this;
  }
  TrackedCharacter operator++(int) {
    TrackedCharacter before = *this;
    ++*this;
    return before;
  }
  bool operator==(const TrackedCharacter& other) const { return at_ == other.at_; }
  bool operator!=(const TrackedCharacter& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** progress_;
};

std::string path_of(const JsonValue& value) {
  std::vector<const JsonValue*> chain;
  for (const JsonValue* v = &value; v->parent != nullptr; v = v->parent) chain.push_back(v);
  std::string path;
  for (auto v = chain.rbegin(); v != chain.rend(); ++v) {
    if ((*v)->parent->is_array()) {
      path += fmt::format("[{}]", (*v)->index);
    } else {
      path += (path.empty() ? "" : ".") + (*v)->key;
    }
  }
  return path;
}

// Builds the tree from the parser's events. Returning false stops the parser.
class TreeBuilder {
 public:
  TreeBuilder(std::string_view text, const std::string& file)
      : text_(text), file_(file), progress_(text.data()) {}

  const char** progress() { return &progress_; }
  JsonValue& root() { return root_; }
  [[nodiscard]] const Diagnostic& fault() const { return fault_; }

  bool null() { return add({}); }
  bool boolean(bool b) {
    JsonValue value;
    value.kind = JsonValue::Kind::boolean;
    value.boolean = b;
    return add(std::move(value));
  }
  bool number_integer(std::int64_t n) { return add_number(static_cast<double>(n)); }
  bool number_unsigned(std::uint64_t n) { return add_number(static_cast<double>(n)); }
  bool number_float(double n, const std::string& /*as_written*/) { return add_number(n); }
  bool string(std::string& s) {
    JsonValue value;
    value.kind = JsonValue::Kind::string;
    value.text = std::move(s);
    return add(std::move(value));
  }
  bool binary(std::vector<std::uint8_t>& /*bytes*/) { return false; }  // JSON text has none
  bool start_object(std::size_t /*unknown*/) { return open(JsonValue::Kind::object); }
  bool start_array(std::size_t /*unknown*/) { return open(JsonValue::Kind::array); }
  bool end_array() { return close(); }
  bool end_object() {
    if (const JsonValue* twice = duplicate_member(open_.back())) {
      return refuse(twice->offset, fmt::format("the key {} appears twice", in_quotes(twice->key)));
    }
    return close();
  }
  bool key(std::string& name) {
    key_ = std::move(name);
    key_offset_ = offset();
    return true;
  }
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                   const nlohmann::detail::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 7: syntax error while parsing value -
    // …"
    std::string_view message = error.what();
    const std::size_t column = message.find("column ");
    if (const std::size_t colon = message.find(": ", column == std::string_view::npos ? 0 : column);
        colon != std::string_view::npos) {
      message.remove_prefix(colon + 2);
    } else if (const std::size_t bracket = message.find("] "); bracket != std::string_view::npos) {
      message.remove_prefix(bracket + 2);
    }
    return refuse(offset(), fmt::format("not valid JSON: {}{}", message.substr(0, 200),
                                        message.size() > 200 ? "…" : ""));
  }

 private:
  [[nodiscard]] std::size_t offset() const { return static_cast<std::size_t>(progress_ - text_.data()); }

  bool refuse(std::size_t at, std::string message) {
    // A token that was cut short by the end of its line belongs to that line.
    if (at > 0 && at <= text_.size() && text_[at - 1] == '\n') --at;
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    fault_ = {file_, fmt::format("line {}", line), std::move(message)};
    if (const std::string where = current_path(); !where.empty() && where.size() < kMaxShownPath) {
      fault_.place += ": " + where;
    }
    return false;
  }

  std::string current_path() {
    for (std::size_t i = 1; i < open_.size(); ++i) {
      open_[i].parent = &open_[i - 1];
      open_[i].index = static_cast<std::uint32_t>(open_[i - 1].children.size());
    }
    if (open_.empty()) return {};
    std::string path = path_of(open_.back());
    if (open_.back().is_array()) path += fmt::format("[{}]", open_.back().children.size());
    if (open_.back().is_object() && !key_.empty()) path += (path.empty() ? "" : ".") + key_;
    return path;
  }

  bool add_number(double n) {
    JsonValue value;
    value.kind = JsonValue::Kind::number;
    value.number = n;
    return add(std::move(value));
  }

  // Gives the value its key and place and hangs it into the container that is open.
  bool add(JsonValue value) {
    if (++value_count_ > JsonDocument::kMaxValues) {
      return refuse(offset(), fmt::format("more than {} values", JsonDocument::kMaxValues));
    }
    label(value);
    append(std::move(value));
    return true;
  }

  void label(JsonValue& value) {
    const bool is_member = !open_.empty() && open_.back().is_object();
    value.offset = is_member ? key_offset_ : offset();
    if (is_member) value.key = std::move(key_);
    key_.clear();
  }

  void append(JsonValue value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return;
    }
    std::vector<JsonValue>& siblings = open_.back().children;
    value.index = static_cast<std::uint32_t>(siblings.size());
    siblings.push_back(std::move(value));
  }

  bool open(JsonValue::Kind kind) {
    if (open_.size() >= JsonDocument::kMaxDepth) {
      return refuse(offset(), fmt::format("nested more than {} deep", JsonDocument::kMaxDepth));
    }
    if (++value_count_ > JsonDocument::kMaxValues) {
      return refuse(offset(), fmt::format("more than {} values", JsonDocument::kMaxValues));
    }
    JsonValue value;
    value.kind = kind;
    label(value);
    open_.push_back(std::move(value));
    return true;
  }

  bool close() {
    JsonValue value = std::move(open_.back());
    open_.pop_back();
    append(std::move(value));
    return true;
  }

  static const JsonValue* duplicate_member(const JsonValue& object) {
    const std::vector<JsonValue>& members = object.children;
    if (members.size() < 2) return nullptr;
    std::vector<const JsonValue*> sorted;
    sorted.reserve(members.size());
    for (const JsonValue& member : members) sorted.push_back(&member);
    std::sort(sorted.begin(), sorted.end(), [](const JsonValue* a, const JsonValue* b) {
      return a->key != b->key ? a->key < b->key : a->index < b->index;
    });
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i]->key == sorted[i - 1]->key) return sorted[i];
    }
    return nullptr;
  }

  std::string_view text_;
  const std::string& file_;
  const char* progress_;
  JsonValue root_;
  std::vector<JsonValue> open_;
  std::string key_;
  std::size_t key_offset_ = 0;
  std::size_t value_count_ = 0;
  Diagnostic fault_;
};

// Values moved while the tree grew; only now do they stay where they are. Depth is bounded by kMaxDepth.
void link_parents(JsonValue& value) {
  for (JsonValue& child : value.children) {
    child.parent = &value;
    link_parents(child);
  }
}

}  // namespace

const JsonValue* JsonValue::find(std::string_view name) const {
  if (kind != Kind::object) return nullptr;
  for (const JsonValue& child : children) {
    if (child.key == name) return &child;
  }
  return nullptr;
}

std::string describe(const JsonValue& value) {
  switch (value.kind) {
    case JsonValue::Kind::null:
      return "null";
    case JsonValue::Kind::boolean:
      return value.boolean ? "true" : "false";
    case JsonValue::Kind::number:
      return fmt::format("{}", value.number);
    case JsonValue::Kind::array:
      return fmt::format("an array of {}", value.children.size());
    case JsonValue::Kind::object:
      return "an object";
    case JsonValue::Kind::string:
      break;
  }
  return in_quotes(value.text);
}

Result<JsonDocument> JsonDocument::parse(std::string_view text, const std::string& file, Place place) {
  TreeBuilder builder(text, file);
  const TrackedCharacter first(text.data(), builder.progress());
  const TrackedCharacter last(text.data() + text.size(), builder.progress());
  if (!nlohmann::json::sax_parse(first, last, &builder)) {
    return tl::unexpected(Error(Failure::bad_input, builder.fault()));
  }
  JsonDocument document(text, place);
  document.root_ = std::make_unique<JsonValue>(std::move(builder.root()));
  link_parents(*document.root_);
  return document;
}

JsonDocument::JsonDocument(std::string_view text, Place place) : text_(text), place_(place) {
  if (place != Place::line_and_path) return;
  for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
    line_ends_.push_back(at);
}

std::string JsonDocument::path(const JsonValue& value) const { return path_of(value); }

std::size_t JsonDocument::line(const JsonValue& value) const {
  std::size_t end = std::min(value.offset, text_.size());
  // The parser reads one character past a number to see that it ends, and that may be the end of its line.
  if (value.kind == JsonValue::Kind::number && value.key.empty() && end > 0) --end;
  return 1 + static_cast<std::size_t>(std::lower_bound(line_ends_.begin(), line_ends_.end(), end) -
                                      line_ends_.begin());
}

std::string JsonDocument::place(const JsonValue& value) const {
  std::string where = path_of(value);
  if (place_ == Place::path) return where;
  return fmt::format("line {}{}{}", line(value), where.empty() ? "" : ": ", where);
}

std::string JsonDocument::place(const JsonValue& object, std::string_view member) const {
  if (const JsonValue* value = object.find(member)) return place(*value);
  const std::string where = path_of(object);
  const std::string full = where.empty() ? std::string(member) : fmt::format("{}.{}", where, member);
  return place_ == Place::path ? full : fmt::format("line {}: {}", line(object), full);
}

}  // namespace laterna
