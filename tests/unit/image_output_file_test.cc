// Files that are either complete or not there.
#include "base/output_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <thread>

#include "laterna/output.h"
#include "unit/image_bytes.h"

namespace laterna {
namespace {

using namespace laterna::testing;
using Names = std::vector<std::string>;

std::string message(const Result<void>& result) { return result ? "no error" : to_string(result.error()); }

template <class T>
std::string creation_error(const Result<T>& result) {
  if (result) return "no error";
  EXPECT_EQ(result.error().failure, Failure::cannot_write);
  return to_string(result.error());
}

TEST(OutputFile, IsThereOnlyOnceCommitted) {
  const TemporaryFolder directory;
  Result<OutputFile> file = OutputFile::create(directory / "a.txt");
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->write(bytes("one ")));
  EXPECT_FALSE(std::filesystem::exists(directory / "a.txt"));
  EXPECT_EQ(directory.names().size(), 1U);  // the temporary file, in the same directory
  EXPECT_TRUE(file->write(bytes("two")));
  EXPECT_TRUE(file->commit());
  EXPECT_EQ(load(directory / "a.txt"), bytes("one two"));
  EXPECT_EQ(directory.names(), Names{"a.txt"});
}

TEST(OutputFile, LeavesNothingWhenNotCommitted) {
  const TemporaryFolder directory;
  store(directory / "a.txt", bytes("before"));
  {
    Result<OutputFile> file = OutputFile::create(directory / "a.txt");
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->write(bytes("after")));
    const OutputFile moved = std::move(*file);
  }
  EXPECT_EQ(load(directory / "a.txt"), bytes("before"));
  EXPECT_EQ(directory.names(), Names{"a.txt"});
}

TEST(OutputFile, ReplacesItsTargetAndKeepsItsPermissions) {
  const TemporaryFolder directory;
  store(directory / "a.txt", bytes("before"));
  ASSERT_EQ(::chmod((directory / "a.txt").c_str(), 0640), 0);
  EXPECT_TRUE(write_file(directory / "a.txt", bytes("after")));
  EXPECT_EQ(load(directory / "a.txt"), bytes("after"));
  struct stat status = {};
  ASSERT_EQ(::stat((directory / "a.txt").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640U);
}

TEST(OutputFile, FollowsASymbolicLink) {
  const TemporaryFolder directory;
  std::filesystem::create_directory(directory / "elsewhere");
  store(directory / "elsewhere/real.txt", bytes("before"));
  std::filesystem::create_symlink("elsewhere/real.txt", directory / "link.txt");
  EXPECT_TRUE(write_file(directory / "link.txt", bytes("after")));
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "link.txt"));
  EXPECT_EQ(load(directory / "elsewhere/real.txt"), bytes("after"));
}

TEST(OutputFile, TakesNamesAsLongAsTheSystemDoes) {
  const TemporaryFolder directory;
  const std::string name(255, 'n');
  EXPECT_TRUE(write_file(directory / name, bytes("x")));
  EXPECT_EQ(directory.names(), Names{name});
  EXPECT_EQ(creation_error(OutputFile::create(directory / std::string(5000, 'n'))),
            (directory / std::string(5000, 'n')).string() + ": cannot create: File name too long");
}

TEST(OutputFile, SaysWhyItCannotBeMade) {
  const TemporaryFolder directory;
  const std::string path = directory.path().string();
  EXPECT_EQ(creation_error(OutputFile::create(directory / "no/such/a.png")),
            path + "/no/such/a.png: cannot create: No such file or directory");
  EXPECT_EQ(creation_error(OutputFile::create(directory.path())),
            path + ": expected a file, found a directory");
  EXPECT_EQ(creation_error(OutputFile::create("")), "the name of the output file is empty");
  store(directory / "file", bytes("x"));
  EXPECT_EQ(creation_error(OutputFile::create(directory / "file/a.png")),
            path + "/file/a.png: cannot create: Not a directory");
  EXPECT_EQ(directory.names(), Names{"file"});
}

TEST(OutputFile, SaysThatADirectoryIsNotWritable) {
  constexpr uid_t kNobody = 65534;
  const TemporaryFolder directory;
  ASSERT_EQ(::chmod(directory.path().c_str(), 0555), 0);
  const int code = exit_code_of_child([&] {
    if (::geteuid() == 0 && ::seteuid(kNobody) != 0) return 2;  // the superuser may write everywhere
    const std::string expected = (directory / "a.png").string() + ": cannot create: Permission denied";
    return creation_error(OutputFile::create(directory / "a.png")) == expected ? 0 : 1;
  });
  EXPECT_EQ(code, 0);
  ASSERT_EQ(::chmod(directory.path().c_str(), 0755), 0);
}

TEST(OutputFile, AFullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  EXPECT_EQ(message(write_file("/dev/full", bytes("x"))), "/dev/full: cannot write: No space left on device");
  // By way of a link, pictures too; and the link stays.
  const TemporaryFolder directory;
  std::filesystem::create_symlink("/dev/full", directory / "full.png");
  const Result<void> result =
      write_image(Image(9, 9, 3, PixelType::u8, Transfer::srgb), directory / "full.png");
  EXPECT_EQ(message(result), (directory / "full.png").string() + ": cannot write: No space left on device");
  EXPECT_EQ(result.error().failure, Failure::cannot_write);
  EXPECT_EQ(directory.names(), Names{"full.png"});
}

TEST(OutputFile, ManyMayBeWrittenAtOnce) {
  const TemporaryFolder directory;
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 50; ++i) {
        const std::string text = std::to_string(t) + " " + std::to_string(i);
        EXPECT_TRUE(write_file(directory / std::to_string(t), bytes(text)));
        EXPECT_TRUE(write_file(directory / "shared", bytes(text)));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(directory.names(), (Names{"0", "1", "2", "3", "shared"}));
  EXPECT_EQ(load(directory / "3"), bytes("3 49"));
}

TEST(RemovePendingOutputs, RemovesWhatIsNotYetInPlace) {
  const TemporaryFolder directory;
  ASSERT_TRUE(write_file(directory / "done", bytes("done")));
  Result<OutputFile> first = OutputFile::create(directory / "first");
  Result<OutputFile> second = OutputFile::create(directory / "second");
  ASSERT_TRUE(first);
  ASSERT_TRUE(second);
  EXPECT_EQ(directory.names().size(), 3U);
  errno = 12345;
  remove_pending_outputs();
  EXPECT_EQ(errno, 12345);
  EXPECT_EQ(directory.names(), Names{"done"});
  EXPECT_EQ(message(first->commit()),
            (directory / "first").string() + ": cannot rename into place: No such file or directory");
  // Later files are not harmed.
  EXPECT_TRUE(write_file(directory / "later", bytes("x")));
  EXPECT_EQ(directory.names(), (Names{"done", "later"}));
}

TEST(RemovePendingOutputs, AnswersASignal) {
  const TemporaryFolder directory;
  const int code = exit_code_of_child([&] {
    std::signal(SIGINT, [](int) {
      remove_pending_outputs();
      ::_exit(7);
    });
    Result<OutputFile> file = OutputFile::create(directory / "a.png");
    if (!file || !file->write(bytes("half of it")) || directory.names().size() != 1) return 1;
    std::raise(SIGINT);
    return 2;
  });
  EXPECT_EQ(code, 7);
  EXPECT_TRUE(directory.names().empty());
}

TEST(ReadFile, GivesTheWholeContent) {
  const TemporaryFolder directory;
  const Bytes content(200'001, std::byte{42});
  store(directory / "a", content);
  EXPECT_EQ(*read_file(directory / "a"), content);
  store(directory / "empty", {});
  EXPECT_TRUE(read_file(directory / "empty")->empty());
}

TEST(ReadFile, ReadsPipesToTheirEnd) {
  int ends[2] = {};
  ASSERT_EQ(::pipe(ends), 0);
  const Bytes content(150'000, std::byte{7});
  std::thread writer([&] {
    for (std::size_t at = 0; at < content.size();) {
      const ssize_t count = ::write(ends[1], content.data() + at, content.size() - at);
      if (count <= 0) break;
      at += static_cast<std::size_t>(count);
    }
    ::close(ends[1]);
  });
  const Result<std::vector<std::byte>> read = read_file("/dev/fd/" + std::to_string(ends[0]));
  writer.join();
  ::close(ends[0]);
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(*read, content);
}

TEST(ReadFile, SaysWhyItCannot) {
  const TemporaryFolder directory;
  const auto error = [](const std::filesystem::path& file) {
    const Result<std::vector<std::byte>> read = read_file(file);
    return read ? "no error" : to_string(read.error());
  };
  EXPECT_EQ(error(directory / "none"),
            (directory / "none").string() + ": cannot open: No such file or directory");
  EXPECT_EQ(error(directory.path()), directory.path().string() + ": expected a file, found a directory");
}

}  // namespace
}  // namespace laterna
