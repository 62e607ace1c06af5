#include "numbered_name.h"

#include <fmt/format.h>

#include "scene_options.h"

namespace laterna::app {

Result<NumberedName> NumberedName::parse(const char* option, const std::string& output, bool takes_films) {
  const std::size_t begin = output.find('#');
  if (begin == std::string::npos) {
    return tl::unexpected(bad_option(fmt::format(
        "{}: the output needs # where the frame's number goes, such as out.####.png{}, got \"{}\"", option,
        takes_films ? ", or a film's ending (.mp4, .mkv, .webm or .gif)" : "", output)));
  }
  const std::size_t found = output.find_first_not_of('#', begin);
  const std::size_t end = found == std::string::npos ? output.size() : found;
  if (output.find('#', end) != std::string::npos || output.find('/', begin) != std::string::npos) {
    return tl::unexpected(bad_option(
        fmt::format("{}: expected one run of # in the name of the output file, got \"{}\"", option, output)));
  }
  return NumberedName(output.substr(0, begin), end - begin, output.substr(end));
}

std::string NumberedName::with(std::int64_t number) const {
  return fmt::format("{}{:0{}}{}", before_, number, digits_, after_);
}

}  // namespace laterna::app
