#include "image/environment_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <system_error>

#include "base/output_file.h"

namespace laterna::image {
namespace {

// Changes whenever other maps would be made of the same picture.
constexpr std::uint64_t kVersion = 1;
constexpr std::string_view kEnding = ".environment";

// A file is this, the sides of the levels as 32-bit numbers, their planes r, g and b, the 27 coefficients, and a sum over
// all before it. Numbers are as the machine has them: the folder is its own.
struct Header {
  std::array<char, 8> magic = {'L', 'A', 'T', 'E', 'R', 'N', 'A', 'E'};
  std::uint64_t version = kVersion;
  std::array<std::uint64_t, 2> key{};
  std::uint64_t level_count = 0;
};

template <class T>
std::span<const std::byte> bytes_of(const T* values, std::size_t count) {
  return std::as_bytes(std::span(values, count));
}

// Takes numbers off the front of a file; once one is missing, all are.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  bool read(T* values, std::size_t count) {
    if (bytes_.size() / sizeof(T) < count) return false;
    std::memcpy(values, bytes_.data(), count * sizeof(T));
    bytes_ = bytes_.subspan(count * sizeof(T));
    return true;
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
};

std::optional<EnvironmentMap> parse(std::span<const std::byte> bytes, const ContentKey& key) {
  std::uint64_t sum = 0;
  if (bytes.size() < sizeof sum) return std::nullopt;
  ContentKey content;
  content.add(bytes.first(bytes.size() - sizeof sum));
  std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
  if (sum != content.words()[0]) return std::nullopt;
  Reader reader(bytes.first(bytes.size() - sizeof sum));
  const Header expected;
  Header header;
  if (!reader.read(&header, 1) || header.magic != expected.magic || header.version != kVersion ||
      header.key != key.words() || header.level_count < 1 || header.level_count > 64) {
    return std::nullopt;
  }
  std::vector<std::int32_t> sides(header.level_count);
  if (!reader.read(sides.data(), sides.size())) return std::nullopt;
  EnvironmentMap map;
  for (const std::int32_t side : sides) {
    if (side < 1 || side > kLargestMirrorSide) return std::nullopt;
    map.mirrored.add_level(side);
  }
  OctahedralLevels& m = map.mirrored;
  for (AlignedVector<float>* plane : {&m.r, &m.g, &m.b}) {
    if (!reader.read(plane->data(), plane->size())) return std::nullopt;
  }
  if (!reader.read(map.irradiance.data(), map.irradiance.size()) || reader.left() != 0) return std::nullopt;
  return map;
}

}  // namespace

// Two multiplicative hashes of 64-bit words (after Fowler, Noll & Vo), apart in their constants and in how they are mixed.
void ContentKey::add(std::uint64_t number) {
  words_[0] = (words_[0] ^ number) * 0x00000100000001B3ULL;
  words_[0] ^= words_[0] >> 29U;
  words_[1] = (std::rotl(words_[1], 23) + number) * 0x9FB21C651E98DF25ULL;
  words_[1] ^= words_[1] >> 35U;
}

void ContentKey::add(std::span<const std::byte> bytes) {
  add(bytes.size());
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t count = std::min(bytes.size(), sizeof word);
    std::memcpy(&word, bytes.data(), count);
    add(word);
    bytes = bytes.subspan(count);
  }
}

std::string ContentKey::text() const { return fmt::format("{:016x}{:016x}", words_[0], words_[1]); }

ContentKey environment_key(EnvironmentChart chart, int width, int height,
                           const std::vector<glm::vec3>& texels) {
  ContentKey key;
  key.add(kVersion);
  key.add(static_cast<std::uint64_t>(chart));
  key.add(static_cast<std::uint64_t>(width));
  key.add(static_cast<std::uint64_t>(height));
  key.add(bytes_of(texels.data(), texels.size()));
  return key;
}

std::filesystem::path EnvironmentCache::file_of(const ContentKey& key) const {
  return folder_ / (key.text() + std::string(kEnding));
}

std::optional<EnvironmentMap> EnvironmentCache::find(const ContentKey& key) const {
  if (folder_.empty()) return std::nullopt;
  const std::filesystem::path file = file_of(key);
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (failed || size > most_bytes_) return std::nullopt;
  const Result<std::vector<std::byte>> bytes = read_file(file);
  if (!bytes) return std::nullopt;
  std::optional<EnvironmentMap> map = parse(*bytes, key);
  if (map) std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), failed);
  return map;
}

void EnvironmentCache::keep(const ContentKey& key, const EnvironmentMap& map) const {
  if (folder_.empty()) return;
  std::error_code failed;
  std::filesystem::create_directories(folder_, failed);
  if (failed) return;
  Header header;
  header.key = key.words();
  header.level_count = map.mirrored.levels.size();
  std::vector<std::byte> bytes;
  const auto append = [&](std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  append(bytes_of(&header, 1));
  for (const OctahedralLevels::Level& level : map.mirrored.levels) append(bytes_of(&level.side, 1));
  for (const AlignedVector<float>* plane : {&map.mirrored.r, &map.mirrored.g, &map.mirrored.b})
    append(bytes_of(plane->data(), plane->size()));
  append(bytes_of(map.irradiance.data(), map.irradiance.size()));
  ContentKey content;
  content.add(std::span<const std::byte>(bytes));
  append(bytes_of(content.words().data(), 1));
  if (bytes.size() > most_bytes_) return;
  // A disk that is full costs time, not the picture.
  if (write_file(file_of(key), bytes)) trim();
}

void EnvironmentCache::trim() const {
  struct Kept {
    std::filesystem::path file;
    std::filesystem::file_time_type used;
    std::uintmax_t bytes;
  };
  std::vector<Kept> files;
  std::uintmax_t total = 0;
  std::error_code failed;
  for (std::filesystem::directory_iterator entry(folder_, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    if (entry->path().extension() != kEnding) continue;
    std::error_code gone;  // by another run, meanwhile
    const Kept kept = {entry->path(), entry->last_write_time(gone), entry->file_size(gone)};
    if (gone) continue;
    total += kept.bytes;
    files.push_back(kept);
  }
  std::sort(files.begin(), files.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  for (const Kept& kept : files) {
    if (total <= most_bytes_) return;
    std::error_code gone;
    std::filesystem::remove(kept.file, gone);
    total -= kept.bytes;
  }
}

}  // namespace laterna::image
