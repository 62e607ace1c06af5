#include "bake/part_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "base/output_file.h"
#include "laterna/bake.h"

namespace laterna {
namespace bake {
namespace {

// Changes whenever the same scene would be baked otherwise.
constexpr std::uint64_t kVersion = 5;
constexpr std::array<char, 8> kMagic = {'L', 'A', 'T', 'B', 'A', 'K', 'E', '1'};
constexpr std::string_view kInfix = ".bake-";
// What write_file() names a file that is not whole yet.
constexpr std::string_view kUnfinished = ".part";

// A file is this and the numbers, as the machine has them: it stays where it was made.
struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint64_t version = kVersion;
  std::array<std::uint64_t, 2> key{};
  std::uint64_t sum = 0;  // over the numbers
};

std::uint64_t sum_of(std::span<const std::byte> bytes) {
  image::ContentKey content;
  content.add(bytes);
  return content.words()[0];
}

// Whether a name is that of a part of a bake of `file`, or of one that was being written when its program was killed.
bool is_name_of_part(std::string_view name, const std::string& file) {
  const bool is_unfinished = name.starts_with('.') && name.ends_with(kUnfinished);
  if (is_unfinished) name.remove_prefix(1);
  if (!name.starts_with(file + std::string(kInfix))) return false;
  name.remove_prefix(file.size() + kInfix.size());
  const auto belongs = [&](char c) {
    return c == '-' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (is_unfinished && c == '.');
  };
  return !name.empty() && std::ranges::all_of(name, belongs);
}

// Begins as ours do: an empty file may be anybody's.
bool begins_as_part(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::array<char, kMagic.size()> begin{};
  stream.read(begin.data(), begin.size());
  return begin == kMagic;
}

}  // namespace

PartFiles PartFiles::with(std::initializer_list<double> numbers) const {
  return with(std::as_bytes(std::span(numbers.begin(), numbers.size())));
}

PartFiles PartFiles::with(std::span<const std::byte> bytes) const {
  PartFiles other = *this;
  if (!file_.empty()) other.key_.add(bytes);
  return other;
}

std::filesystem::path PartFiles::path_of(std::string_view part) const {
  return file_.string() + fmt::format("{}{}", kInfix, part);
}

bool PartFiles::find(std::string_view part, const Values& values) const {
  ++tally_->asked;
  const bool is_found = !file_.empty() && resume_ && read(part, values);
  if (is_found) ++tally_->found;
  return is_found;
}

bool PartFiles::read(std::string_view part, const Values& values) const {
  std::size_t size = sizeof(Header);
  for (const std::span<std::byte> value : values) size += value.size();
  const std::filesystem::path path = path_of(part);
  std::error_code failed;
  if (std::filesystem::file_size(path, failed) != size || failed) return false;
  const Result<std::vector<std::byte>> bytes = read_file(path);
  if (!bytes || bytes->size() != size) return false;
  Header header;
  std::memcpy(&header, bytes->data(), sizeof header);
  std::span<const std::byte> numbers = std::span(*bytes).subspan(sizeof header);
  if (header.magic != kMagic || header.version != kVersion || header.key != key_.words() ||
      header.sum != sum_of(numbers)) {
    return false;
  }
  for (const std::span<std::byte> value : values) {
    std::ranges::copy(numbers.first(value.size()), value.begin());
    numbers = numbers.subspan(value.size());
  }
  return true;
}

void PartFiles::keep(std::string_view part, const Values& values) const {
  if (file_.empty()) return;
  std::vector<std::byte> bytes(sizeof(Header));
  for (const std::span<std::byte> value : values) bytes.insert(bytes.end(), value.begin(), value.end());
  Header header;
  header.key = key_.words();
  header.sum = sum_of(std::span(bytes).subspan(sizeof header));
  std::memcpy(bytes.data(), &header, sizeof header);
  const Result<void> written = write_file(path_of(part), bytes);
  if (written) {
    ++tally_->kept;
  } else if (!tally_->not_kept) {
    tally_->not_kept = written.error();
  }
}

}  // namespace bake

void remove_bake_parts(const std::filesystem::path& work_file) {
  if (work_file.empty()) return;
  const std::filesystem::path folder = work_file.has_parent_path() ? work_file.parent_path() : ".";
  const std::string name = work_file.filename().string();
  std::error_code failed;
  std::vector<std::filesystem::path> parts;
  for (std::filesystem::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    std::error_code unknown;
    if (entry->is_regular_file(unknown) && !entry->is_symlink(unknown) &&
        bake::is_name_of_part(entry->path().filename().string(), name) && bake::begins_as_part(entry->path()))
      parts.push_back(entry->path());
  }
  for (const std::filesystem::path& part : parts) std::filesystem::remove(part, failed);
}

}  // namespace laterna
