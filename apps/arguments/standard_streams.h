// The word - on the command line: standard input as an input, standard output as an output.
//
//   const std::vector<std::string> words =
//       with_standard_streams({"-", "-o", "-", "--format", "obj"});
//   // "/dev/stdin.obj", "-o", "/dev/stdout.obj", "--format", "obj"
#pragma once

#include <string>
#include <vector>

namespace majorant::app {

// `words` with names of the streams (io/files/standard_stream.h) in place of each -, but for that
// of
// --report. --format EXT says the format of both, --format IN,OUT that of each. Throws Error(Usage)
// where --format is missing, and for an output beside `--report -`.
std::vector<std::string> with_standard_streams(std::vector<std::string> words);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
