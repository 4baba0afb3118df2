#include "majorant/io/temporary_file.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <memory>
#include <system_error>
#include <vector>

#include "io_test_helpers.h"

namespace majorant {
namespace {

TEST(TemporaryFile, LivesUntilItIsRenamedOrForgotten) {
  const TemporaryFolder folder;
  {
    TemporaryFile file(folder.path().string(), ".vtu", 0600);
    EXPECT_EQ(file.write_and_close("abc"), 0);
    EXPECT_EQ(content_of(file.path()), "abc");
    const std::string name = std::filesystem::path(file.path()).filename().string();
    EXPECT_TRUE(name.starts_with(".majorant-") && name.ends_with(".tmp.vtu")) << name;
    EXPECT_LT(name.size(), 40u);
  }
  EXPECT_EQ(entries(folder), 0u);
  {
    TemporaryFile file(folder.path().string() + "/", std::string(200, 'x'), 0600);
    EXPECT_TRUE(file.path().ends_with(".tmp")) << file.path();
    EXPECT_EQ(file.write_and_close("abc"), 0);
    EXPECT_EQ(file.rename_to(folder.file("kept")), 0);
  }
  EXPECT_EQ(content_of(folder.file("kept")), "abc");
  EXPECT_THROW(TemporaryFile(folder.file("absent"), "", 0600), std::system_error);
}

// In a child process, which has files like a run that a signal ends.
TEST(TemporaryFile, HandlersRemoveAllUnfinishedFiles) {
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGTERM, [](int) {
      remove_temporary_files();
      ::_exit(7);
    });
    { const TemporaryFile forgotten(folder.path().string(), ".obj", 0600); }
    TemporaryFile renamed(folder.path().string(), ".obj", 0600);
    renamed.rename_to(folder.file("kept.obj"));
    std::vector<std::unique_ptr<TemporaryFile>> unfinished;
    for (int i = 0; i < 5; ++i)
      unfinished.push_back(std::make_unique<TemporaryFile>(folder.path().string(), ".obj", 0600));
    ::_exit(entries(folder) == 6 ? ::raise(SIGTERM) : 8);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(entries(folder), 1u);
  EXPECT_TRUE(std::filesystem::exists(folder.file("kept.obj")));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
