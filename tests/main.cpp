// Runs the tests of a folder, or those of single files of it:
//
//   framework_tests                           everything
//   framework_tests newton_test.cpp           the tests written in that file; gtest's options also
//   work
//
// A skipped test fails, and so do a file without tests and two tests of one name.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <vector>

namespace {

std::vector<const testing::TestInfo*> all_tests() {
  std::vector<const testing::TestInfo*> tests;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int s = 0; s < program.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *program.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) tests.push_back(suite.GetTestInfo(t));
  }
  return tests;
}

std::string full_name(const testing::TestInfo& test) {
  return std::string(test.test_suite_name()) + "." + test.name();
}

// gtest's filter for the tests of one file; empty if there are none.
std::string filter_of(const std::string& file) {
  std::string filter;
  for (const testing::TestInfo* test : all_tests())
    if (std::filesystem::path(test->file()).filename() == file) filter += full_name(*test) + ":";
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  std::set<std::string> names;
  for (const testing::TestInfo* test : all_tests())
    if (!names.insert(full_name(*test)).second) {
      std::cerr << "two tests are called " << full_name(*test) << "\n";
      return 1;
    }
  std::string filter;
  for (int k = 1; k < argc; ++k) {
    const std::string of_file = filter_of(argv[k]);
    if (of_file.empty()) {
      std::cerr << argv[k] << " has no tests\n";
      return 1;
    }
    filter += of_file;
  }
  if (!filter.empty()) testing::GTEST_FLAG(filter) = filter;
  const int failed = RUN_ALL_TESTS();
  const int skipped = testing::UnitTest::GetInstance()->skipped_test_count();
  if (skipped > 0) std::cerr << skipped << " tests were skipped: a test runs or is not there\n";
  return failed != 0 || skipped > 0 ? 1 : 0;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
