#include "base/file_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <system_error>

namespace laterna {
namespace {

// Room for what comes beyond the size that fstat() gave: pipes and devices give none.
constexpr std::size_t kLeastGrowth = 1 << 16;

tl::unexpected<Error> cannot_read(const std::filesystem::path& file, std::string message) {
  return tl::unexpected(Error(Failure::bad_input, Diagnostic{file.string(), {}, std::move(message)}));
}

Result<std::vector<std::byte>> read_to_end(int descriptor, std::size_t expected,
                                           const std::filesystem::path& file) {
  std::vector<std::byte> bytes(expected +
                               1);  // one more, so that the end of the file is seen without growing
  std::size_t size = 0;
  for (;;) {
    if (size == bytes.size()) bytes.resize(bytes.size() + std::max(bytes.size(), kLeastGrowth));
    const ssize_t count = ::read(descriptor, bytes.data() + size, bytes.size() - size);
    if (count == 0) break;
    if (count > 0) {
      size += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      return cannot_read(file, "cannot read: " + describe_errno(errno));
    }
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::filesystem::path& file) {
  const FileDescriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!descriptor.is_open()) return cannot_read(file, "cannot open: " + describe_errno(errno));
  struct stat status = {};
  if (::fstat(descriptor.get(), &status) != 0)
    return cannot_read(file, "cannot read: " + describe_errno(errno));
  if (S_ISDIR(status.st_mode)) return cannot_read(file, "expected a file, found a directory");
  try {
    return read_to_end(descriptor.get(), static_cast<std::size_t>(std::max<off_t>(status.st_size, 0)), file);
  } catch (const std::exception&) {  // std::bad_alloc or std::length_error
    return cannot_read(file, "not enough memory for " + std::to_string(status.st_size) + " bytes");
  }
}

std::string describe_errno(int number) { return std::generic_category().message(number); }

int FileDescriptor::close() {
  if (!is_open()) return 0;
  // Not repeated on EINTR: Linux has closed the descriptor even then.
  return ::close(std::exchange(descriptor_, -1)) == 0 || errno == EINTR ? 0 : errno;
}

}  // namespace laterna
