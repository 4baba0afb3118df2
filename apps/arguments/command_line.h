// Completes a command line, and explains command lines that are wrong.
//
//   CLI::App command;
//   std::vector<std::string> words = completed_words(command, {"in.obj", "out.obj"});
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

// Returns `words`, the arguments of the command, beginning with a verb. `help VERB` becomes `VERB
// --help` and `version` becomes `--version`. If the first word that is no option names a mesh,
// another file or a directory, the verb is unwrap. Throws Error(Usage) that names the nearest verb
// if there is none, and for words that the parser would misread: an option in the place of a value,
// `--seams sharp 40`.
std::vector<std::string> completed_words(const CLI::App& app, std::vector<std::string> words);

// Throws Error(Usage) if an option of the parsed verb has an empty value, as from an unset shell
// variable. Empty input names are refused by their readers.
void require_values(const CLI::App& app);

// Returns one line about arguments that app.parse refused: the nearest option, the verbs that have
// this option, or the parser's message, and the command that prints the help.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
