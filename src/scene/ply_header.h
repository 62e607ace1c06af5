// What a PLY file's header claims, checked before Assimp takes memory for it.
#pragma once

#include <cstdint>
#include <filesystem>

#include "laterna/result.h"

namespace laterna {

/// Error: the header claims more elements than the file has bytes; every element takes at least one. Everything else
/// that may be wrong with the header is left to the importer.
Result<void> check_ply_header(const std::filesystem::path& file, std::uintmax_t file_size);

}  // namespace laterna
