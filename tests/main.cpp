// Runs the tests of a folder, or those of single files of it:
//
//   framework_tests                           everything
//   framework_tests newton_test.cpp           the tests written in that file; gtest's options also
//   work
//
// A file without tests fails, and so do two tests of one name. Each skipped test is a line `skipped
// Suite.Name: no ...`. If all were skipped, the last line is `skipped: no ...` and the exit code
// 77, as in main.py.
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

// Returns gtest's filter for the tests of one file; empty if there are none.
std::string filter_of(const std::string& file) {
  std::string filter;
  for (const testing::TestInfo* test : all_tests())
    if (std::filesystem::path(test->file()).filename() == file) filter += full_name(*test) + ":";
  return filter;
}

// Returns the message of GTEST_SKIP(); empty if it was not called.
std::string reason_skipped(const testing::TestInfo& test) {
  const testing::TestResult& result = *test.result();
  if (!test.should_run() || !result.Skipped()) return "";
  for (int k = 0; k < result.total_part_count(); ++k)
    if (result.GetTestPartResult(k).skipped()) return result.GetTestPartResult(k).message();
  return "no reason given";
}

// Prints the skipped tests. Returns whether all were skipped.
bool nothing_was_run() {
  std::set<std::string> reasons;
  for (const testing::TestInfo* test : all_tests()) {
    const std::string reason = reason_skipped(*test);
    if (reason.empty()) continue;
    std::cout << "skipped " << full_name(*test) << ": " << reason << "\n";
    reasons.insert(reason);
  }
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  if (reasons.empty() || program.skipped_test_count() < program.test_to_run_count()) return false;
  std::cout << "skipped:";
  for (const std::string& reason : reasons) std::cout << ' ' << reason;
  std::cout << std::endl;
  return true;
}

constexpr int kSkipped = 77;  // exit code of skipped tests in ctest

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
  const bool none = nothing_was_run();
  if (failed != 0) return 1;
  return none ? kSkipped : 0;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
