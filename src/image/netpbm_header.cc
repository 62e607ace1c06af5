#include "image/netpbm_header.h"

#include <charconv>

namespace laterna::image {
namespace {

constexpr std::size_t kLongestWord = 32;
constexpr std::size_t kMostDigits = 8;

}  // namespace

bool is_netpbm_space(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string read_netpbm_word(ByteReader& in) {
  std::string word;
  bool is_comment = false;
  while (in.remaining() > 0 && word.size() < kLongestWord) {
    const char c = static_cast<char>(in.u8());
    if (is_comment) {
      is_comment = c != '\n' && c != '\r';
    } else if (c == '#' && word.empty()) {
      is_comment = true;
    } else if (!is_netpbm_space(c)) {
      word += c;
    } else if (!word.empty()) {
      break;
    }
  }
  if (word.empty()) in.skip(1);  // beyond the end
  return word;
}

int read_netpbm_number(ByteReader& in) {
  const std::string word = read_netpbm_word(in);
  int number = -1;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool is_whole = !word.empty() && word.size() <= kMostDigits && fault == std::errc() && number >= 0 &&
                        end == word.data() + word.size() && word[0] != '-';
  return is_whole ? number : -1;
}

}  // namespace laterna::image
