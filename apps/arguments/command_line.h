// Guesses what a command line means, and says what is wrong where that cannot be known.
//
//   CLI::App command;
//   std::vector<std::string> words = meant_words(command, {"in.obj", "out.obj"});
//   std::reverse(words.begin(), words.end());    // as CLI11 wants them
//   try {
//     command.parse(words);
//   } catch (const CLI::ParseError& e) {
//     say("majorant: {}\n", usage_message(command, e));
//   }
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace majorant::app {

// `words`, the arguments of the command, with the verb in front: `help VERB` is `VERB --help`, and
// where the first word that is no option names a mesh or another file, the verb is unwrap.
// Throws Error(Usage) that names the nearest verb where there is none.
std::vector<std::string> meant_words(const CLI::App& app, std::vector<std::string> words);

// One line for a line that app.parse refused: the nearest option, who has that option, or what the
// parser says; and where help is.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
