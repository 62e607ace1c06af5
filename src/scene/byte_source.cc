#include "scene/byte_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace laterna {
namespace {

std::string reason(int error) { return std::system_category().message(error); }

}  // namespace

class ByteSource::OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

ByteSource ByteSource::in_memory(SharedBytes bytes) {
  ByteSource source;
  source.size_ = bytes->size();
  source.memory_ = std::move(bytes);
  return source;
}

tl::expected<ByteSource, std::string> ByteSource::open(const std::filesystem::path& path) {
  // Without O_NONBLOCK, opening a pipe would wait for its other end.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return tl::unexpected(fmt::format("cannot open: {}", reason(errno)));
  ByteSource source;
  source.file_ = std::make_shared<const OpenFile>(descriptor);
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0) return tl::unexpected(fmt::format("cannot read: {}", reason(errno)));
  if (!S_ISREG(status.st_mode)) return tl::unexpected<std::string>("is no regular file");
  source.size_ = static_cast<std::uint64_t>(status.st_size);
  return source;
}

ByteSource ByteSource::slice(std::uint64_t offset, std::uint64_t size) const {
  ByteSource part = *this;
  part.offset_ += offset;
  part.size_ = size;
  return part;
}

tl::expected<OwnedSpan, std::string> ByteSource::read(std::uint64_t offset, std::uint64_t size) const {
  if (memory_) return OwnedSpan{memory_, std::span(*memory_).subspan(offset_ + offset, size)};
  auto bytes = std::make_shared<std::vector<std::byte>>(size);
  std::uint64_t done = 0;
  while (file_ && done < size) {
    const ssize_t count = ::pread(file_->descriptor(), bytes->data() + done, size - done,
                                  static_cast<off_t>(offset_ + offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return tl::unexpected(fmt::format("cannot read: {}", reason(errno)));
    if (count == 0) return tl::unexpected<std::string>("the file was cut while it was read");
    done += static_cast<std::uint64_t>(count);
  }
  const std::span<const std::byte> all(*bytes);
  return OwnedSpan{std::move(bytes), all};
}

}  // namespace laterna
