// Replaces the word - on the command line by names of standard input and standard output.
//
//   const std::vector<std::string> words =
//       with_standard_streams({"-", "-o", "-", "--format", "obj"});
//   // "/dev/stdin.obj", "-o", "/dev/stdout.obj", "--format", "obj"
#pragma once

#include <string>
#include <vector>

namespace majorant::app {

// Returns `words` with the names of the streams (io/files/standard_stream.h) in place of each -,
// except after --report. --format EXT gives the format of both streams, --format IN,OUT that of
// each. Throws Error(Usage) if --format is missing, and for an output beside `--report -`.
std::vector<std::string> with_standard_streams(std::vector<std::string> words);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
