#include "majorant/apps/jobs/petsc_fallback.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>

#include "majorant/framework/error.h"

namespace majorant {

Json linear_solver_section(const std::string& name, OwnSolver own, const FallbackRecord& record) {
  std::vector<std::string_view> used;
  if (own == OwnSolver::Used) used.emplace_back("direct");
  for (std::size_t k = 0; k < kPetscMethodNames.size(); ++k)
    if (record.methods[k].solves > 0) used.push_back(kPetscMethodNames[k]);
  Json section{{"requested", name}, {"used", nullptr}};
  if (!used.empty()) section["used"] = fmt::format("{}", fmt::join(used, " + "));
  const auto is_set_up = [](const FallbackRecord::Use& use) { return use.set_ups > 0; };
  if (std::none_of(record.methods.begin(), record.methods.end(), is_set_up)) return section;
  section["indefinite"] = record.indefinite;
  for (std::size_t k = 0; k < kPetscMethodNames.size(); ++k) {
    const FallbackRecord::Use& use = record.methods[k];
    section[std::string(kPetscMethodNames[k])] = {{"set_ups", use.set_ups},
                                                  {"solves", use.solves},
                                                  {"iterations", use.iterations},
                                                  {"most_iterations", use.most_iterations},
                                                  {"falls", use.falls}};
  }
  return section;
}

std::vector<std::string> petsc_words(const std::string& text) {
  // Follows PETSc: "-5" is a value, not an option.
  const auto is_option = [](const std::string& word) {
    const std::size_t name = word.starts_with("--") ? 2 : 1;
    return word.starts_with('-') && std::isalpha(static_cast<unsigned char>(word[name])) != 0;
  };
  std::istringstream stream(text);
  std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string& word = words[k];
    if (!is_option(word) && (k == 0 || !is_option(words[k - 1])))
      throw Error(ErrorKind::Usage,
                  fmt::format("'{}' is neither an option of PETSc, which begins with -, nor the "
                              "value of one",
                              word));
    for (const char* end : {"-help", "-h", "-version", "-v"})
      if (word.substr(word.starts_with("--") ? 1 : 0) == end)
        throw Error(ErrorKind::Usage,
                    fmt::format("'{}' makes PETSc end the program; leave it out", word));
  }
  return words;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
