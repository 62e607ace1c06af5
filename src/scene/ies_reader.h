// ANSI/IES LM-63: 1986, 1991, 1995, 2002 and 2019; types A, B and C; TILT.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "laterna/lamps.h"

namespace laterna {

/// Whether the text has a TILT= line, which every version has.
bool looks_like_ies(std::string_view text);

/// `file` stands in messages; a file that TILT names is looked for in `folder`.
Result<LightDistribution> read_ies(std::string_view text, const std::string& file,
                                   const std::filesystem::path& folder);

}  // namespace laterna
