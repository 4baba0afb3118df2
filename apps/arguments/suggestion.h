// Guesses which word was meant by one that nothing is called: for options, choices and verbs.
//
//   std::string boundary = nearest("frea", {"free", "fixed"});    // "free"
//   verb.add_option("--boundary", boundary, "...")->check(one_of({"free", "fixed"}));
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace majorant::app {

// The name that is at most two letters (of short words: one) put in, left out or changed away from
// `word`, the nearest of them; else the first one that begins with `word`. Empty if there is none.
std::string nearest(const std::string& word, const std::vector<std::string>& names);
// For the end of a message: " (did you mean 'NAME'?)", or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

// As CLI::IsMember, with that end.
CLI::Validator one_of(std::vector<std::string> choices);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
