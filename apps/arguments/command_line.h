// Guesses what a command line means, and says what is wrong where that cannot be known.
//
//   CLI::App command;
//   std::vector<std::string> words = meant_words(command, {"in.obj", "out.obj"});
//   std::reverse(words.begin(), words.end());    // as CLI11 wants them
//   try {
//     command.parse(words);
//     require_values(command);
//   } catch (const CLI::ParseError& e) {
//     say("majorant: {}\n", usage_message(command, e));
//   }
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace majorant::app {

// Returns `words`, the arguments of the command, with the verb in front: `help VERB` is `VERB
// --help`, `version` is `--version`, and where the first word that is no option names a mesh,
// another file or a directory, the verb is unwrap. Throws Error(Usage) that names the nearest verb
// where there is none, and for what the parser would misunderstand: an option in the place of a
// value, `--seams sharp 40`.
std::vector<std::string> meant_words(const CLI::App& app, std::vector<std::string> words);

// Throws Error(Usage) if an option of the parsed verb has an empty value, as an unset variable of a
// shell makes it. Empty names of inputs are for their readers to refuse.
void require_values(const CLI::App& app);

// Returns one line for a line that app.parse refused: the nearest option, who has that option, or
// what the parser says; and where help is.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
