#include "scene/uri.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <system_error>

#include "scene/spelling.h"

namespace laterna {
namespace {

int hexadecimal_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

constexpr std::uint8_t kNotBase64 = 64;

constexpr std::string_view kBase64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<std::uint8_t, 256> make_base64_digits() {
  std::array<std::uint8_t, 256> digits{};
  digits.fill(kNotBase64);
  for (std::size_t i = 0; i < kBase64.size(); ++i) {
    digits[static_cast<unsigned char>(kBase64[i])] = static_cast<std::uint8_t>(i);
  }
  digits['-'] = 62;  // RFC 4648's alphabet for URLs, which some exporters write
  digits['_'] = 63;
  return digits;
}

constexpr std::array<std::uint8_t, 256> kBase64Digits = make_base64_digits();

tl::expected<std::vector<std::byte>, std::string> decode_base64(std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return tl::unexpected<std::string>("the base64 data is cut short");
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int held = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::uint8_t digit = kBase64Digits[static_cast<unsigned char>(text[i])];
    if (digit == kNotBase64) {
      return tl::unexpected(fmt::format("character {} of the base64 data is no base64 digit", i));
    }
    bits = bits << 6 | digit;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::byte>(bits >> held & 0xFFU));
  }
  return bytes;
}

// RFC 3986: a letter, then letters, digits, '+', '-', '.', then a colon. "C:\…" counts as one too.
bool has_scheme(std::string_view reference) {
  const std::size_t colon = reference.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (!is_letter(reference.front())) return false;
  return std::all_of(reference.begin(), reference.begin() + static_cast<std::ptrdiff_t>(colon), [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
  });
}

bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  // Devices and pipes could deliver bytes for ever.
  return std::filesystem::is_regular_file(path, ignored);
}

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.substr(0, 5) == "data:"; }

std::string percent_decoded(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      const int high = hexadecimal_digit(text[i + 1]), low = hexadecimal_digit(text[i + 2]);
      if (high >= 0 && low >= 0) {
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
        continue;
      }
    }
    decoded += text[i];
  }
  return decoded;
}

std::string percent_encoded(std::string_view path) {
  constexpr std::string_view kPlain = "-._~/";
  std::string encoded;
  for (const char c : path) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                          kPlain.find(c) != std::string_view::npos;
    if (is_plain) {
      encoded += c;
    } else {
      encoded += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    }
  }
  return encoded;
}

std::string data_uri(std::string_view media_type, std::span<const std::byte> bytes) {
  std::string uri = fmt::format("data:{};base64,", media_type);
  uri.reserve(uri.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      bits = bits << 8 | (k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      uri += i + k > bytes.size() ? '=' : kBase64[bits >> (18 - 6 * k) & 63U];
  }
  return uri;
}

tl::expected<std::vector<std::byte>, std::string> decode_data_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!is_data_uri(uri) || comma == std::string_view::npos)
    return tl::unexpected<std::string>("the data URI has no comma");
  const std::string_view header = uri.substr(5, comma - 5);
  const std::string_view payload = uri.substr(comma + 1);
  constexpr std::string_view base64 = ";base64";
  const bool is_base64 =
      header.size() >= base64.size() && header.substr(header.size() - base64.size()) == base64;
  const bool has_escapes = payload.find('%') != std::string_view::npos;
  if (is_base64) return has_escapes ? decode_base64(percent_decoded(payload)) : decode_base64(payload);
  const std::string decoded = percent_decoded(payload);
  const auto* first = reinterpret_cast<const std::byte*>(decoded.data());
  return std::vector<std::byte>(first, first + decoded.size());
}

tl::expected<std::filesystem::path, std::string> resolve_file(const std::filesystem::path& folder,
                                                              std::string_view reference) {
  if (reference.empty()) return tl::unexpected<std::string>("the file name is empty");
  const std::string decoded = percent_decoded(reference);
  if (decoded.find('\0') != std::string::npos)
    return tl::unexpected<std::string>("the file name holds a NUL character");
  if (has_scheme(reference)) {
    return tl::unexpected(
        fmt::format("{} is a URL or has a drive letter; only files given relative to the scene are read",
                    in_quotes(reference)));
  }
  if (decoded.front() == '/' || decoded.front() == '\\') {
    return tl::unexpected(fmt::format(
        "{} is an absolute path; only files given relative to the scene are read", in_quotes(reference)));
  }
  std::string with_slashes = decoded;
  std::replace(with_slashes.begin(), with_slashes.end(), '\\', '/');
  for (const std::string& spelling : {decoded, std::string(reference), with_slashes}) {
    if (const std::filesystem::path path = folder / spelling; is_file(path)) return path;
  }
  return tl::unexpected(fmt::format("{} not found (tried {})", in_quotes(reference),
                                    path_in_quotes((folder / decoded).string())));
}

tl::expected<std::filesystem::path, std::string> resolve_typed_file(const std::filesystem::path& folder,
                                                                    std::string_view name) {
  if (name.empty()) return tl::unexpected<std::string>("the file name is empty");
  if (name.find('\0') != std::string_view::npos)
    return tl::unexpected<std::string>("the file name holds a NUL character");
  std::filesystem::path path = folder / name;
  if (is_file(path)) return path;
  return tl::unexpected(
      fmt::format("{} not found (tried {})", in_quotes(name), path_in_quotes(path.string())));
}

}  // namespace laterna
