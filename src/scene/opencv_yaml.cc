#include "scene/opencv_yaml.h"

#include <fmt/format.h>

#include <vector>

#include "base/json_text.h"
#include "scene/spelling.h"
#include "scene/text_numbers.h"

namespace laterna {
namespace {

constexpr int kMaxDepth = 64;

struct Line {
  std::size_t number, indent;
  std::string_view text;  // without indentation, comment and spaces at its end
};

bool is_space(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) { return rest_after_words(text, 0); }

// Up to a '#' that begins the text or follows a space, and is not within quotes.
std::string_view without_comment(std::string_view text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == '\\' && quote == '"') ++i;
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#' && (i == 0 || is_space(text[i - 1]))) {
      return text.substr(0, i);
    }
  }
  return text;
}

std::string json_scalar(std::string_view plain) {
  if (const std::optional<double> number = number_of(plain)) return fmt::format("{}", *number);
  if (plain == "true" || plain == "false" || plain == "null") return std::string(plain);
  return plain.empty() || plain == "~" ? "null" : json_string(plain);
}

class Transcriber {
 public:
  Transcriber(std::string_view yaml, FaultList& faults) : faults_(faults) {
    for (TextLines lines(yaml); lines.next();) add_line(lines.line(), lines.number());
  }

  std::optional<std::string> run() {
    if (lines_.empty()) {
      fail("expected a mapping, got nothing");
    } else {
      block(lines_[0].indent, 0);
      if (!has_failed_ && at_ < lines_.size()) fail("is indented less than what it belongs to");
    }
    if (has_failed_) return std::nullopt;
    return std::move(json_);
  }

 private:
  void add_line(std::string_view text, std::size_t number) {
    const std::size_t indent = text.find_first_not_of(' ');
    if (indent == std::string_view::npos) return;
    std::string_view content = trimmed(without_comment(text.substr(indent)));
    if (content.empty() || (indent == 0 && (content.front() == '%' || content == "---" || content == "...")))
      return;
    if (indent == 0 && content.starts_with("--- ")) content = trimmed(content.substr(4));
    lines_.push_back({number, indent, content});
  }

  void fail(std::string message) {
    if (has_failed_) return;
    has_failed_ = true;
    const std::size_t line = lines_.empty() ? 1 : lines_[std::min(at_, lines_.size() - 1)].number;
    faults_.error(fmt::format("line {}", line), std::move(message));
  }

  // On the line of the YAML that is being read.
  void put(std::string_view token) {
    const std::size_t line = lines_[std::min(at_, lines_.size() - 1)].number;
    for (; written_lines_ + 1 < line; ++written_lines_) json_ += '\n';
    json_ += token;
  }

  [[nodiscard]] bool is_at(std::size_t indent) const {
    return at_ < lines_.size() && lines_[at_].indent == indent;
  }
  [[nodiscard]] static bool begins_item(std::string_view text) {
    return text == "-" || text.starts_with("- ");
  }

  // Where the colon behind a key is, or npos.
  static std::size_t find_colon(std::string_view text) {
    std::size_t at = 0;
    if (!text.empty() && (text[0] == '"' || text[0] == '\'')) {
      at = text.find(text[0], 1);
      if (at == std::string_view::npos) return at;
    }
    for (at = text.find(':', at); at != std::string_view::npos; at = text.find(':', at + 1)) {
      if (at + 1 == text.size() || is_space(text[at + 1])) return at;
    }
    return at;
  }

  void block(std::size_t indent, int depth) {
    if (depth > kMaxDepth) return fail(fmt::format("is nested deeper than {}", kMaxDepth));
    const std::string_view text = lines_[at_].text;
    if (begins_item(text)) {
      sequence(indent, depth);
    } else if (text.front() != '[' && text.front() != '{' && find_colon(text) != std::string_view::npos) {
      mapping(indent, depth);
    } else {
      value(indent, depth);
    }
  }

  void sequence(std::size_t indent, int depth) {
    put("[");
    for (bool is_first = true; !has_failed_ && is_at(indent) && begins_item(lines_[at_].text);
         is_first = false) {
      if (!is_first) put(",");
      Line& line = lines_[at_];
      const std::string_view rest = trimmed(line.text.substr(1));
      if (rest.empty()) {
        nested(indent, depth);
        continue;
      }
      line.indent += static_cast<std::size_t>(rest.data() - line.text.data());
      line.text = rest;
      block(line.indent, depth + 1);
    }
    put_closing("]");
  }

  void mapping(std::size_t indent, int depth) {
    put("{");
    for (bool is_first = true; !has_failed_ && is_at(indent) && !begins_item(lines_[at_].text);
         is_first = false) {
      Line& line = lines_[at_];
      const std::size_t colon = find_colon(line.text);
      if (colon == std::string_view::npos)
        return fail(fmt::format("expected \"key: value\", got {}", in_quotes(line.text)));
      if (!is_first) put(",");
      std::string_view key = trimmed(line.text.substr(0, colon));
      if (key.size() >= 2 && (key.front() == '"' || key.front() == '\'')) key = key.substr(1, key.size() - 2);
      put(json_string(key) + ":");
      line.text = without_tag(trimmed(line.text.substr(colon + 1)));
      if (line.text.empty()) {
        nested(indent, depth);
      } else {
        value(indent, depth);
      }
    }
    put_closing("}");
  }

  static std::string_view without_tag(std::string_view text) {
    return text.starts_with('!') ? rest_after_words(text, 1) : text;
  }

  // What stands below the current line, which is done.
  void nested(std::size_t indent, int depth) {
    const bool is_deeper = at_ + 1 < lines_.size() && lines_[at_ + 1].indent > indent;
    const bool is_list = at_ + 1 < lines_.size() && lines_[at_ + 1].indent == indent &&
                         begins_item(lines_[at_ + 1].text) && !begins_item(lines_[at_].text);
    if (!is_deeper && !is_list) {
      put("null");
      ++at_;
      return;
    }
    ++at_;
    block(lines_[at_].indent, depth + 1);
  }

  // The rest of the current line, and further lines where a flow collection goes on.
  void value(std::size_t indent, int depth) {
    const std::string_view text = without_tag(lines_[at_].text);
    if (text.empty() || (text[0] != '[' && text[0] != '{' && text[0] != '"' && text[0] != '\'')) {
      if (!text.empty() && (text[0] == '|' || text[0] == '>' || text[0] == '&' || text[0] == '*'))
        return fail(fmt::format("block scalars, anchors and aliases are not read, got {}", in_quotes(text)));
      put(json_scalar(text));
      ++at_;
    } else {
      rest_ = text;
      flow(depth + 1);
      if (has_failed_) return;
      if (!rest_.empty()) return fail(fmt::format("expected the end of the line, got {}", in_quotes(rest_)));
      ++at_;
    }
    if (at_ < lines_.size() && lines_[at_].indent > indent) fail("is indented more than what it belongs to");
  }

  // False at the end of the file.
  bool skip_to_flow() {
    for (rest_ = trimmed(rest_); rest_.empty(); rest_ = lines_[at_].text) {
      if (at_ + 1 >= lines_.size()) {
        fail("a list or mapping does not end");
        return false;
      }
      ++at_;
    }
    return true;
  }

  void flow(int depth) {
    if (depth > kMaxDepth) return fail(fmt::format("is nested deeper than {}", kMaxDepth));
    if (!skip_to_flow()) return;
    const char open = rest_.front();
    if (open == '"' || open == '\'') return put(json_string(take_quoted()));
    if (open != '[' && open != '{') return put(json_scalar(take_plain(",]}")));
    const char close = open == '[' ? ']' : '}';
    put(std::string_view(&open, 1));
    rest_.remove_prefix(1);
    for (bool is_first = true; !has_failed_ && skip_to_flow(); is_first = false) {
      if (rest_.front() == close) break;
      if (!is_first) {
        if (rest_.front() != ',')
          return fail(fmt::format("expected ',' or '{}', got {}", close, in_quotes(rest_)));
        rest_.remove_prefix(1);
        if (!skip_to_flow()) return;
        if (rest_.front() == close) break;
        put(",");
      }
      if (open == '{') flow_key();
      if (!has_failed_) flow(depth + 1);
    }
    if (has_failed_) return;
    put(std::string_view(&close, 1));
    rest_.remove_prefix(1);
    rest_ = trimmed(rest_);
  }

  void flow_key() {
    const bool is_quoted = rest_.front() == '"' || rest_.front() == '\'';
    put(json_string(is_quoted ? take_quoted() : std::string(take_plain(":,}"))) + ":");
    rest_ = trimmed(rest_);
    if (has_failed_) return;
    if (rest_.empty() || rest_.front() != ':')
      return fail(fmt::format("expected ':', got {}", in_quotes(rest_)));
    rest_.remove_prefix(1);
  }

  std::string_view take_plain(std::string_view ends) {
    const std::size_t end = std::min(rest_.find_first_of(ends), rest_.size());
    const std::string_view plain = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end);
    return plain;
  }

  std::string take_quoted() {
    const char quote = rest_.front();
    std::string text;
    for (std::size_t i = 1; i < rest_.size(); ++i) {
      const char c = rest_[i];
      const char following = i + 1 < rest_.size() ? rest_[i + 1] : '\0';
      if (c == '\\' && quote == '"') {
        text += following == 'n' ? '\n' : following == 't' ? '\t' : following;
        ++i;
      } else if (c == quote && quote == '\'' && following == quote) {
        text += quote;
        ++i;
      } else if (c == quote) {
        rest_ = trimmed(rest_.substr(i + 1));
        return text;
      } else {
        text += c;
      }
    }
    fail("a quoted text does not end on its line");
    return text;
  }

  // The line behind has been reached, or the end.
  void put_closing(std::string_view token) { json_ += token; }

  FaultList& faults_;
  std::vector<Line> lines_;
  std::size_t at_ = 0;
  std::string_view rest_;  // of a flow collection's line
  std::string json_;
  std::size_t written_lines_ = 0;
  bool has_failed_ = false;
};

}  // namespace

std::optional<std::string> json_from_opencv_yaml(std::string_view yaml, FaultList& faults) {
  return Transcriber(yaml, faults).run();
}

}  // namespace laterna
