// glTF's URIs: data URIs, and references to files beside the scene.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "laterna/result.h"

namespace laterna {

bool is_data_uri(std::string_view uri);

/// The bytes of "data:[media type][;base64],…", percent-encoded or base64. Error: the reason, without a
/// place.
tl::expected<std::vector<std::byte>, std::string> decode_data_uri(std::string_view uri);

/// "%20" → " "; what is no valid escape stays as it is.
std::string percent_decoded(std::string_view text);
/// The reverse for a path: what is neither unreserved (RFC 3986) nor "/" is escaped.
std::string percent_encoded(std::string_view path);

/// "data:MEDIA;base64,…".
std::string data_uri(std::string_view media_type, std::span<const std::byte> bytes);

/// The file that a relative reference names: tried percent-decoded, as written, and with backslashes read as
/// slashes.
/// `../` is followed, as real files use it. Error: it is an absolute path or a URL, or no such file is there.
tl::expected<std::filesystem::path, std::string> resolve_file(const std::filesystem::path& folder,
                                                              std::string_view reference);

/// The file that a person typed in a rig: as written, relative to `folder` or absolute. A rig is its user's own text,
/// so unlike a downloaded scene it may name any file. Error: no such file is there.
tl::expected<std::filesystem::path, std::string> resolve_typed_file(const std::filesystem::path& folder,
                                                                    std::string_view name);

}  // namespace laterna
