#include "scene/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/lower_case.h"

namespace laterna {
namespace {

constexpr std::size_t kMaxQuotedBytes = 80;
constexpr std::size_t kMaxComparedBytes =
    40;  // no key is longer; keeps the comparison cheap for hostile input

// Levenshtein's distance, blind to case; a swap of neighbours counts as one slip (Damerau).
std::size_t slips_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower_case(a[i - 1]) == lower_case(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower_case(a[i - 1]) == lower_case(b[j - 2]) &&
          lower_case(a[i - 2]) == lower_case(b[j - 1])) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

bool holds_word(std::string_view longer, std::string_view shorter) {
  return shorter.size() >= 3 && longer.find(shorter) != std::string_view::npos;
}

}  // namespace

std::string path_in_quotes(std::string_view path) {
  std::string text = "\"";
  for (const char c : path) text += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
  return text + "\"";
}

std::string in_quotes(std::string_view name) {
  if (name.size() <= kMaxQuotedBytes) return path_in_quotes(name);
  std::size_t length = kMaxQuotedBytes;
  // Never cut between the bytes of one UTF-8 character.
  while (length > 0 && (static_cast<unsigned char>(name[length]) & 0xC0U) == 0x80U) --length;
  std::string text = path_in_quotes(name.substr(0, length));
  text.insert(text.size() - 1, "…");
  return text;
}

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known) {
  if (word.size() > kMaxComparedBytes) return {};
  std::string_view best;
  std::size_t fewest = 1 + std::max<std::size_t>(1, word.size() / 3);
  for (const std::string_view candidate : known) {
    const std::size_t slips = slips_between(word, candidate);
    if (slips < fewest) {
      fewest = slips;
      best = candidate;
    }
  }
  if (!best.empty()) return best;
  for (const std::string_view candidate : known) {
    if (holds_word(candidate, word) || holds_word(word, candidate)) return candidate;
  }
  return {};
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known) {
  const std::string_view nearest = nearest_word(word, known);
  return nearest.empty() ? std::string() : fmt::format(" (did you mean \"{}\"?)", nearest);
}

}  // namespace laterna
