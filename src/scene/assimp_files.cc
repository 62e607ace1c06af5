#include "scene/assimp_files.h"

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "base/file_io.h"

namespace laterna {
namespace {

// A file in memory. Assimp's PLY reader, for one, goes back to the start of a cut file for ever; no sound parser makes
// several calls for each byte there is.
class WatchedStream : public Assimp::IOStream {
 public:
  explicit WatchedStream(std::vector<std::byte> bytes)
      : bytes_(std::move(bytes)), calls_left_(kCallsOfAnyFile + 4 * bytes_.size()) {}

  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    count_call();
    if (size == 0) return 0;
    const std::size_t elements = std::min(count, (bytes_.size() - at_) / size);
    if (elements > 0) std::memcpy(to, bytes_.data() + at_, elements * size);
    at_ += elements * size;
    return elements;
  }

  std::size_t Write(const void* /*from*/, std::size_t /*size*/, std::size_t /*count*/) override { return 0; }

  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    count_call();
    // Backward offsets arrive as huge numbers and wrap round, as fseek's do.
    const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    const std::size_t target = base + offset;
    if (target > bytes_.size()) return aiReturn_FAILURE;
    at_ = target;
    return aiReturn_SUCCESS;
  }

  [[nodiscard]] std::size_t Tell() const override { return at_; }
  [[nodiscard]] std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  static constexpr std::size_t kCallsOfAnyFile = 4096;

  void count_call() {
    if (calls_left_ == 0)
      throw std::runtime_error("the file ends too early, or its parser is caught in a loop");
    --calls_left_;
  }

  std::vector<std::byte> bytes_;
  std::size_t calls_left_;
  std::size_t at_ = 0;
};

bool is_material_library(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".mtl" || ending == ".MTL";
}

}  // namespace

Assimp::IOStream* AssimpFiles::Open(const char* file, const char* mode) {
  std::error_code ignored;
  const bool is_readable =
      std::strchr(mode, 'w') == nullptr && std::filesystem::is_regular_file(file, ignored);
  Result<std::vector<std::byte>> bytes =
      is_readable ? read_file(file) : tl::unexpected(Error(Failure::bad_input, Diagnostic{}));
  if (is_material_library(file)) {
    libraries_.any_was_read |= bytes.has_value();
    if (!bytes) libraries_.missing.insert(file);
  }
  return bytes ? new WatchedStream(std::move(*bytes)) : nullptr;  // Close() deletes it
}

void AssimpFiles::Close(Assimp::IOStream* stream) { delete stream; }

}  // namespace laterna
