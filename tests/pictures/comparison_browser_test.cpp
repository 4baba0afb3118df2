#include <sys/wait.h>

#include <cstdlib>

#include "framework/comparison/comparison_samples.h"
#include "io/io_test_helpers.h"
#include "majorant/pictures/write_comparison.h"

namespace majorant {
namespace {

constexpr int kNoBrowser = 77;

int status_in_a_browser() {
  const TemporaryFolder folder;
  const std::string script = MAJORANT_SOURCE_DIR "/tests/pictures/comparison_page.py";
  std::string command = "/usr/bin/python3 '" + script + "'";
  auto all = odd_comparisons();
  all.emplace_back("usual", usual_comparison());
  for (const auto& [name, comparison] : all) {
    const std::string path = folder.file(name + ".html");
    write_comparison_html(path, comparison);
    command += " '" + path + "'";
  }
  return std::system(command.c_str());
}

// Headless Chromium opens every page, uses its controls and checks for errors.
TEST(ComparisonPage, WorksInABrowser) {
  const int status = status_in_a_browser();
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == kNoBrowser) GTEST_SKIP() << "no chromium";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
