// Which kind of lamp file it is, and what all kinds share.
#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "base/file_io.h"
#include "base/lower_case.h"
#include "laterna/lamps.h"
#include "scene/eulumdat_reader.h"
#include "scene/ies_reader.h"

namespace laterna {
namespace {

// Four million values of twenty characters.
constexpr std::size_t kMostBytes = std::size_t{80} << 20U;

tl::unexpected<Error> fault(const std::string& file, std::string place, std::string message) {
  return tl::unexpected(Error(Failure::bad_input, Diagnostic{file, std::move(place), std::move(message)}));
}

bool is_rubbish(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code < 0x20 && std::string_view("\t\r\n\f\v\x1A").find(c) == std::string_view::npos && c != '\0';
}

// IES and EULUMDAT are text; NUL is let pass at the end only, where old programs filled up blocks with it.
std::optional<std::size_t> find_rubbish(std::string_view text) {
  const std::size_t end = text.find_last_not_of('\0') + 1;
  for (std::size_t i = 0; i < end; ++i) {
    if (is_rubbish(text[i]) || text[i] == '\0') return i;
  }
  return std::nullopt;
}

bool has_eulumdat_ending(const std::string& name) {
  return lower_case(std::filesystem::path(name).extension().string()) == ".ldt";
}

// The third line of EULUMDAT is its symmetry, and nothing else.
bool looks_like_eulumdat(std::string_view text, const std::string& name) {
  if (has_eulumdat_ending(name)) return true;
  if (looks_like_ies(text)) return false;
  for (int line = 0; line < 2; ++line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return false;
    text.remove_prefix(end + 1);
  }
  return !text.empty() && text[0] >= '0' && text[0] <= '4' &&
         (text.size() == 1 || text[1] == '\r' || text[1] == '\n');
}

Result<LightDistribution> read(std::string_view text, const std::string& name,
                               const std::filesystem::path& folder) {
  if (text.size() > kMostBytes)
    return fault(name, "",
                 fmt::format("{} bytes are more than {}: no lamp file is so large", text.size(), kMostBytes));
  if (const std::optional<std::size_t> at = find_rubbish(text))
    return fault(name, fmt::format("byte {}", *at), "no lamp file: expected text, got binary data");
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
  Result<LightDistribution> lamp =
      looks_like_eulumdat(text, name) ? read_eulumdat(text, name) : read_ies(text, name, folder);
  if (!lamp) return lamp;
  lamp->name = name;
  if (std::string message = find_fault(*lamp); !message.empty()) return fault(name, "", std::move(message));
  if (*std::max_element(lamp->candela.begin(), lamp->candela.end()) <= 0)
    return fault(name, "", "every candela value is 0: the lamp gives no light");
  return lamp;
}

}  // namespace

Result<LightDistribution> read_lamp(std::span<const std::byte> bytes, const std::string& name,
                                    const std::filesystem::path& folder) {
  try {
    return read({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name, folder);
  } catch (const std::exception& exception) {
    return fault(name, "", exception.what());
  }
}

Result<LightDistribution> read_lamp_file(const std::filesystem::path& file) {
  const Result<std::vector<std::byte>> bytes = read_file(file);
  if (!bytes) return tl::unexpected(bytes.error());
  return read_lamp(*bytes, file.string(), file.parent_path());
}

}  // namespace laterna
