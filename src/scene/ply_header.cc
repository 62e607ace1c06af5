#include "scene/ply_header.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#include "scene/spelling.h"

namespace laterna {

Result<void> check_ply_header(const std::filesystem::path& file, std::uintmax_t file_size) {
  constexpr int kMostLines = 10000;
  std::ifstream in(file, std::ios::binary);
  std::uintmax_t room = file_size;
  std::string line;
  for (int number = 1; number <= kMostLines && std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string keyword, name;
    words >> keyword;
    if (keyword == "end_header") break;
    if (keyword != "element") continue;
    std::uintmax_t count = 0;
    words >> name >> count;  // too large for its type: the largest value there is
    if (count > room) {
      return tl::unexpected(Error(
          Failure::bad_input,
          Diagnostic{file.string(), fmt::format("line {}", number),
                     fmt::format("the header claims {} elements {}, more than a file of {} bytes can hold",
                                 count, in_quotes(name), file_size)}));
    }
    room -= count;
  }
  return {};
}

}  // namespace laterna
