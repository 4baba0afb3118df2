// Suggests the nearest known name for a misspelt option, choice or verb.
//
//   std::string boundary = nearest("frea", {"free", "fixed"});    // "free"
//   verb.add_option("--boundary", boundary, "...")->check(one_of({"free", "fixed"}));
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace majorant::app {

// Returns the name that differs from `word` by one inserted, deleted or changed letter; else the
// first name that begins with `word`; else the nearest name that differs by two letters, if `word`
// is not short. Case is ignored. Empty if there is none.
std::string nearest(const std::string& word, const std::vector<std::string>& names);
// Returns the end of a message, " (did you mean 'NAME'?)", or an empty string.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

// Refuses a word that names no file but is near one of `words`, for options that take these words
// or files. The reader of the file refuses all other words.
CLI::Validator word_or_file(std::vector<std::string> words);

// Accepts the same words as CLI::IsMember; the message ends with a suggestion.
CLI::Validator one_of(std::vector<std::string> choices);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
