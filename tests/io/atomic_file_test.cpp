#include "majorant/io/atomic_file.h"

#include <sys/stat.h>

#include <cstdlib>
#include <thread>

#include "io_test_helpers.h"

namespace majorant {
namespace {

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
    EXPECT_EQ(error_message(ErrorKind::Usage, [&] { require_writable_file(path); })
                  .starts_with("cannot write " + path),
              true);
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

TEST(AtomicFile, DanglingLinkIsFollowed) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("second", folder.file("first"));
  std::filesystem::create_symlink("target", folder.file("second"));
  require_writable_file(folder.file("first"));
  EXPECT_EQ(entries(folder), 2u);
  write_file_atomically(folder.file("first"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("first")));
  EXPECT_TRUE(
      std::filesystem::is_regular_file(std::filesystem::symlink_status(folder.file("target"))));
  EXPECT_EQ(content_of(folder.file("target")), "new");
}

TEST(AtomicFile, LongestNameAndItsPermissions) {
  const TemporaryFolder folder;
  const std::string path = folder.file(std::string(251, 'x') + ".vtu");
  require_writable_file(path);
  write_file_atomically(path, "one");
  ASSERT_EQ(::chmod(path.c_str(), 0666), 0);
  write_file_atomically(path, "two");
  EXPECT_EQ(content_of(path), "two");
  EXPECT_EQ(static_cast<unsigned>(std::filesystem::status(path).permissions()), 0666u);
}

TEST(AtomicFile, VerificationSeesTheBytesBeforeTheyTakeTheName) {
  const TemporaryFolder folder;
  folder.write("a.obj", "old");
  const std::string path = folder.file("a.obj");
  std::string seen;
  write_file_atomically(path, "new", [&](const std::string& temporary) {
    seen = temporary;
    EXPECT_EQ(content_of(temporary), "new");
    EXPECT_EQ(content_of(path), "old");
  });
  EXPECT_TRUE(seen.ends_with(".tmp.obj")) << seen;
  EXPECT_EQ(std::filesystem::path(seen).parent_path(), folder.path());
  EXPECT_EQ(content_of(path), "new");
}

TEST(AtomicFile, UnverifiedFilesAreNotWritten) {
  const TemporaryFolder folder;
  folder.write("a.obj", "old");
  const auto refuse = [](const std::string&) { throw Error(ErrorKind::Invalid, "cell 7"); };
  for (const std::string name : {"a.obj", "absent.obj"})
    EXPECT_EQ(error_message(ErrorKind::Invalid,
                            [&] { write_file_atomically(folder.file(name), "new", refuse); }),
              "cell 7");
  EXPECT_EQ(content_of(folder.file("a.obj")), "old");
  EXPECT_EQ(entries(folder), 1u);
}

TEST(AtomicFile, SpecialFilesAreVerifiedElsewhere) {
  const TemporaryFolder folder, elsewhere;
  const std::string fifo = folder.file("fifo.vtu");
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  ASSERT_EQ(::setenv("TMPDIR", elsewhere.path().c_str(), 1), 0);
  std::string seen;
  const auto look = [&](const std::string& temporary) {
    seen = temporary;
    EXPECT_EQ(content_of(temporary), "through");
  };
  std::thread reader([&] { EXPECT_EQ(content_of(fifo), "through"); });
  write_file_atomically(fifo, "through", look);
  reader.join();
  EXPECT_EQ(std::filesystem::path(seen).parent_path(), elsewhere.path());
  EXPECT_TRUE(seen.ends_with(".vtu"));
  error_message(ErrorKind::Invalid, [&] {  // opens no FIFO, which would wait for a reader
    write_file_atomically(fifo, "x",
                          [](const std::string&) { throw Error(ErrorKind::Invalid, "refused"); });
  });
  EXPECT_EQ(entries(elsewhere), 0u);
  EXPECT_EQ(entries(folder), 1u);
  ::unsetenv("TMPDIR");
}

TEST(PendingFile, AppearsWhenItTakesItsPlace) {
  const TemporaryFolder folder;
  folder.write("a", "old");
  std::filesystem::create_symlink("a", folder.file("link"));
  {
    const PendingFile forgotten(folder.file("a"), "new");
    EXPECT_EQ(content_of(folder.file("a")), "old");
    EXPECT_EQ(entries(folder), 3u);
  }
  EXPECT_EQ(entries(folder), 2u);
  PendingFile first(folder.file("link"), "one"), second(folder.file("b"), "two");
  EXPECT_FALSE(std::filesystem::exists(folder.file("b")));
  first.take_place();
  EXPECT_EQ(content_of(folder.file("a")), "one");
  second.take_place();
  EXPECT_EQ(content_of(folder.file("b")), "two");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(entries(folder), 3u);
}

TEST(PendingFile, AFailedWriteLeavesNothing) {
  const TemporaryFolder folder;
  error_message(ErrorKind::Usage, [] { PendingFile("/dev/null", "x"); });
  error_message(ErrorKind::Usage, [&] { PendingFile(folder.file("absent/a"), "x"); });
  error_message(ErrorKind::Invalid, [&] {
    PendingFile(folder.file("a"), "x",
                [](const std::string&) { throw Error(ErrorKind::Invalid, "refused"); });
  });
  EXPECT_EQ(entries(folder), 0u);
  {
    PendingFile late(folder.file("a"), "x");
    std::filesystem::create_directory(folder.file("a"));
    EXPECT_TRUE(error_message(ErrorKind::Usage, [&] {
                  late.take_place();
                }).starts_with("cannot write " + folder.file("a")));
  }
  EXPECT_EQ(entries(folder), 1u);
}

TEST(AtomicFile, NamesOfOneFile) {
  const TemporaryFolder folder;
  folder.write("a", "");
  std::filesystem::create_symlink("a", folder.file("link"));
  std::filesystem::create_hard_link(folder.file("a"), folder.file("hard"));
  std::filesystem::create_symlink("b", folder.file("dangling"));
  const auto same = [&](const char* first, const char* second) {
    return identify_file(folder.file(first)) == identify_file(folder.file(second));
  };
  EXPECT_TRUE(same("a", "./a") && same("a", "link") && same("a", "hard"));
  EXPECT_TRUE(same("b", "./b") && same("b", "dangling"));
  EXPECT_FALSE(same("a", "b") || same("b", "c"));
  EXPECT_FALSE(identify_file(folder.file("absent/a")).has_value());
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
