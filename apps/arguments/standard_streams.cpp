#include "apps/arguments/standard_streams.h"

#include <algorithm>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/standard_stream.h"

namespace majorant::app {
namespace {

constexpr const char* kFormat = "--format";
constexpr const char* kStream = "-";

// Returns the formats of input and output; empty without --format.
std::pair<std::string, std::string> formats_in(const std::vector<std::string>& words) {
  const std::string joined = std::string(kFormat) + "=";
  std::string value;
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (words[k] == kFormat && k + 1 < words.size()) value = words[k + 1];
    if (words[k].starts_with(joined)) value = words[k].substr(joined.size());
  }
  const std::size_t comma = value.find(',');
  if (comma == std::string::npos) return {value, value};
  return {value.substr(0, comma), value.substr(comma + 1)};
}

}  // namespace

std::vector<std::string> with_standard_streams(std::vector<std::string> words) {
  const auto [input, output] = formats_in(words);
  bool has_input = false, has_output = false, has_report = false;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string before = k == 0 ? "" : words[k - 1];
    if (words[k] == "-o-" || words[k] == "--output=-")
      words[k] = "--output=" + standard_output(output);
    has_report = has_report || words[k] == "--report=-";
    if (words[k].starts_with("--output=" + standard_output(""))) has_output = true;
    if (words[k] != kStream) continue;
    if (before == "--report") {
      has_report = true;
    } else if (before == "-o" || before == "--output" || has_input) {
      words[k] = standard_output(output);
      has_output = true;
    } else {
      words[k] = standard_input(input);
      has_input = true;
    }
  }
  if ((has_input || has_output) && (input.empty() || output.empty()))
    throw Error(ErrorKind::Usage,
                "-: the format of standard input and output is not known; add --format obj, or "
                "--format obj,glb for input and output");
  if (!has_input && !has_output && !input.empty())
    throw Error(ErrorKind::Usage,
                "--format applies to standard input and output, and no file is -; leave it out");
  if (has_output && has_report)
    throw Error(ErrorKind::Usage,
                "-o - and --report - would write into each other; give one of them a file");
  return words;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
