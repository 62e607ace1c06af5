#include "bake/strip_files.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "base/output_file.h"

namespace laterna::bake {
namespace {

// Changes whenever the same scene would be baked otherwise.
constexpr std::uint64_t kVersion = 1;

// A file is this and the numbers, as the machine has them: it stays where it was made.
struct Header {
  std::array<char, 8> magic = {'L', 'A', 'T', 'B', 'A', 'K', 'E', '1'};
  std::uint64_t version = kVersion;
  std::array<std::uint64_t, 2> key{};
  std::uint64_t sum = 0;  // over the numbers
};

std::uint64_t sum_of(std::span<const std::byte> bytes) {
  image::ContentKey content;
  content.add(bytes);
  return content.words()[0];
}

}  // namespace

std::filesystem::path StripFiles::path_of(std::size_t page, std::size_t strip) const {
  return file_.string() + fmt::format(".bake-{}-{}", page, strip);
}

bool StripFiles::find(std::size_t page, std::size_t strip, std::span<float> values) {
  if (file_.empty() || !resume_) return false;
  const std::filesystem::path path = path_of(page, strip);
  std::error_code failed;
  const std::span<std::byte> target = std::as_writable_bytes(values);
  if (std::filesystem::file_size(path, failed) != sizeof(Header) + target.size() || failed) return false;
  const Result<std::vector<std::byte>> bytes = read_file(path);
  if (!bytes || bytes->size() != sizeof(Header) + target.size()) return false;
  const Header expected;
  Header header;
  std::memcpy(&header, bytes->data(), sizeof header);
  const std::span<const std::byte> numbers = std::span(*bytes).subspan(sizeof header);
  if (header.magic != expected.magic || header.version != kVersion || header.key != key_.words() ||
      header.sum != sum_of(numbers)) {
    return false;
  }
  std::memcpy(target.data(), numbers.data(), numbers.size());
  there_.push_back(path);
  return true;
}

void StripFiles::keep(std::size_t page, std::size_t strip, std::span<const float> values) {
  if (file_.empty()) return;
  Header header;
  header.key = key_.words();
  const std::span<const std::byte> numbers = std::as_bytes(values);
  header.sum = sum_of(numbers);
  std::vector<std::byte> bytes(sizeof header + numbers.size());
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, numbers.data(), numbers.size());
  const std::filesystem::path path = path_of(page, strip);
  if (write_file(path, bytes)) there_.push_back(path);
}

void StripFiles::remove() {
  std::error_code gone;
  for (const std::filesystem::path& path : there_) std::filesystem::remove(path, gone);
  there_.clear();
}

}  // namespace laterna::bake
