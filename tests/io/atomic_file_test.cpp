#include "majorant/io/atomic_file.h"

#include <sys/stat.h>

#include <thread>

#include "io_test_helpers.h"

namespace majorant {
namespace {

std::size_t entries(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder.path()), {}));
}

TEST(AtomicFile, WritesAndReplaces) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.txt");
  write_file_atomically(path, "one");
  EXPECT_EQ(content_of(path), "one");
  ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
  write_file_atomically(path, std::string("two\0x", 5));
  EXPECT_EQ(content_of(path), std::string("two\0x", 5));
  EXPECT_EQ(static_cast<unsigned>(std::filesystem::status(path).permissions()), 0640u);
  EXPECT_EQ(entries(folder), 1u);
}

TEST(AtomicFile, SymbolicLinkStays) {
  const TemporaryFolder folder;
  folder.write("target", "old");
  std::filesystem::create_symlink("target", folder.file("link"));
  write_file_atomically(folder.file("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(content_of(folder.file("target")), "new");
  EXPECT_EQ(entries(folder), 2u);
}

TEST(AtomicFile, FailureLeavesNothing) {
  const TemporaryFolder folder;
  for (const std::string& path : {folder.file("absent/a.txt"), folder.path().string(),
                                  folder.file(std::string(300, 'x')), std::string()}) {
    const std::string message =
        error_message(ErrorKind::Usage, [&] { write_file_atomically(path, "x"); });
    EXPECT_TRUE(message.starts_with("cannot write " + path)) << message;
  }
  error_message(ErrorKind::Usage, [] { write_file_atomically("/dev/full", "x"); });
  EXPECT_EQ(entries(folder), 0u);
}

TEST(AtomicFile, SpecialFilesAreWrittenDirectly) {
  const TemporaryFolder folder;
  write_file_atomically("/dev/null", "x");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  const std::string fifo = folder.file("fifo");
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = content_of(fifo); });
  write_file_atomically(fifo, "through");
  reader.join();
  EXPECT_EQ(received, "through");
  EXPECT_EQ(entries(folder), 1u);
}

}  // namespace
}  // namespace majorant
