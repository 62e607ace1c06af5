#include "base/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <string>
#include <system_error>

namespace laterna {
namespace {

// File systems allow names of 255 bytes: this many of the target's, and our own part.
constexpr std::size_t kLongestNamePart = 200;
constexpr unsigned kPermissionBits = 0777;

tl::unexpected<Error> cannot_write(const std::filesystem::path& target, std::string message) {
  const std::string name = target == "-" ? "stdout" : target.string();
  return tl::unexpected(Error(Failure::cannot_write, Diagnostic{name, {}, std::move(message)}));
}

// Hidden, beside the target, and of a name that no other process uses: the clock is for the same process
// number on another machine that shares the directory.
std::filesystem::path temporary_path(const std::filesystem::path& destination) {
  const std::string name = destination.filename().string().substr(0, kLongestNamePart);
  const auto nanoseconds = std::chrono::steady_clock::now().time_since_epoch().count();
  return destination.parent_path() /
         ("." + name + "." + std::to_string(::getpid()) + "." + std::to_string(nanoseconds) + ".part");
}

}  // namespace

int OutputFile::open_stdout() {
  descriptor_ = FileDescriptor(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0));
  return descriptor_.is_open() ? 0 : errno;
}

int OutputFile::open_in_place() {
  descriptor_ = FileDescriptor(::open(destination_.c_str(), O_WRONLY | O_CLOEXEC));
  return descriptor_.is_open() ? 0 : errno;
}

int OutputFile::open_beside(bool target_exists, unsigned target_mode) {
  for (;;) {
    temporary_ = PendingOutput(temporary_path(destination_).string());
    if (!temporary_.is_registered()) return ENAMETOOLONG;
    descriptor_ = FileDescriptor(::open(temporary_.path(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (descriptor_.is_open()) break;
    const int number = errno;
    temporary_.release();  // before anything else: the path may be another's
    if (number != EEXIST) return number;
  }
  if (target_exists) ::fchmod(descriptor_.get(), target_mode & kPermissionBits);
  return 0;
}

Result<OutputFile> OutputFile::create(const std::filesystem::path& target) {
  OutputFile output(target);
  if (target.empty()) return cannot_write(target, "the name of the output file is empty");
  int number = 0;
  if (target == "-") {
    number = output.open_stdout();
  } else {
    std::error_code fault;
    const std::filesystem::path absolute = std::filesystem::absolute(target, fault);
    if (!fault) output.destination_ = std::filesystem::weakly_canonical(absolute, fault);
    if (fault) return cannot_write(target, "cannot create: " + fault.message());
    struct stat status = {};
    const bool exists = ::stat(output.destination_.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) return cannot_write(target, "expected a file, found a directory");
    number = exists && !S_ISREG(status.st_mode) ? output.open_in_place()
                                                : output.open_beside(exists, status.st_mode);
  }
  if (number != 0) return cannot_write(target, "cannot create: " + describe_errno(number));
  return output;
}

Result<void> OutputFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_.get(), bytes.data(), bytes.size());
    if (count >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      return cannot_write(target_, "cannot write: " + describe_errno(errno));
    }
  }
  return {};
}

Result<void> OutputFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(descriptor_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(count));
      offset += static_cast<std::uint64_t>(count);
    } else if (errno != EINTR) {
      return cannot_write(target_, "cannot write: " + describe_errno(errno));
    }
  }
  return {};
}

Result<std::uint64_t> OutputFile::size() const {
  struct stat status = {};
  if (::fstat(descriptor_.get(), &status) != 0)
    return cannot_write(target_, "cannot write: " + describe_errno(errno));
  return static_cast<std::uint64_t>(status.st_size);
}

Result<void> OutputFile::truncate(std::uint64_t size) {
  if (::ftruncate(descriptor_.get(), static_cast<off_t>(size)) != 0)
    return cannot_write(target_, "cannot write: " + describe_errno(errno));
  return {};
}

Result<void> OutputFile::commit_as(const std::filesystem::path& other) {
  std::error_code fault;
  destination_ = std::filesystem::absolute(other, fault);
  target_ = other;
  if (fault) return cannot_write(target_, "cannot rename into place: " + fault.message());
  return commit();
}

Result<void> OutputFile::commit() {
  if (const int number = descriptor_.close(); number != 0) {
    return cannot_write(target_, "cannot write: " + describe_errno(number));
  }
  if (!temporary_.is_registered()) return {};
  if (std::rename(temporary_.path(), destination_.c_str()) != 0) {
    return cannot_write(target_, "cannot rename into place: " + describe_errno(errno));
  }
  temporary_.release();
  return {};
}

Result<void> write_file(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  Result<OutputFile> output = OutputFile::create(file);
  if (!output) return tl::unexpected(std::move(output.error()));
  if (Result<void> written = output->write(bytes); !written) return written;
  return output->commit();
}

}  // namespace laterna
