// The words at the beginning of PNM and PFM files: separated by white space, with comments from "#" to the
// line's end.
#pragma once

#include <string>

#include "image/byte_reader.h"

namespace laterna::image {

/// True for the characters that separate words.
bool is_netpbm_space(int c);

/// The next word, at most 32 characters of it, and the one white space after it; empty at the end of the
/// file.
std::string read_netpbm_word(ByteReader& in);

/// The next word as a whole number from 0 to 99,999,999, or −1 where it is none.
int read_netpbm_number(ByteReader& in);

}  // namespace laterna::image
