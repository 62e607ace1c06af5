// Text as JSON holds it.
#pragma once

#include <string>
#include <string_view>

namespace laterna {

/// In quotation marks, with what may not stand between them escaped (RFC 8259, section 7). UTF-8 stays as it is.
std::string json_string(std::string_view text);

}  // namespace laterna
