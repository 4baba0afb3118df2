// Guesses which word was meant by one that nothing is called: for options, choices and verbs.
//
//   std::string boundary = nearest("frea", {"free", "fixed"});    // "free"
//   verb.add_option("--boundary", boundary, "...")->check(one_of({"free", "fixed"}));
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace majorant::app {

// Returns the name that is one letter put in, left out or changed away from `word`; else the first
// one that begins with `word`; else the nearest that is two letters away, of words that are not
// short. Capitals count as small letters. Empty if there is none.
std::string nearest(const std::string& word, const std::vector<std::string>& names);
// For the end of a message: " (did you mean 'NAME'?)", or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

// Refuses a word that names no file and is near one of `words`, for an option that takes these and
// files. What is near none is left to the reader of the file.
CLI::Validator word_or_file(std::vector<std::string> words);

// As CLI::IsMember, with that end.
CLI::Validator one_of(std::vector<std::string> choices);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
