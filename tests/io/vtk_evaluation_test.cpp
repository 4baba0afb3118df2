// Writes maps of several degrees, which VTK evaluates (vtk_evaluation.py).
#include <sys/wait.h>

#include <cstdlib>

#include "io_test_helpers.h"
#include "majorant/io/io.h"

namespace majorant {
namespace {

constexpr int kNoVtk = 77;

TEST(VtkEvaluation, AgreesWithTheOrderOfControlPoints) {
  const TemporaryFolder folder;
  const std::string script = MAJORANT_SOURCE_DIR "/tests/io/vtk_evaluation.py";
  ASSERT_TRUE(std::filesystem::exists(script)) << script;
  std::string command = "/usr/bin/python3 '" + script + "'";
  for (int degree = 1; degree <= 8; ++degree) {
    const std::string path = folder.file("degree" + std::to_string(degree) + ".vtu");
    write_vtu(path, random_strip(degree, 3, static_cast<unsigned>(degree)));
    command += " '" + path + "'";
  }
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == kNoVtk) GTEST_SKIP() << "no python3-vtk9";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
