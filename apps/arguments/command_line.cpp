#include "apps/arguments/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <utility>

#include "apps/arguments/suggestion.h"
#include "majorant/framework/error.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {
namespace {

constexpr const char* kDefaultVerb = "unwrap";

using OtherName = std::pair<const char*, const char*>;

// Names that other tools have for a verb of ours.
constexpr std::array<OtherName, 7> kOtherVerbs = {{
    {"pack", kDefaultVerb},
    {"flatten", kDefaultVerb},
    {"unfold", kDefaultVerb},
    {"uv", kDefaultVerb},
    {"verify", "check"},
    {"export", "convert"},
    {"describe", "info"},
}};

// And for an option: of several, the first that the verb has.
constexpr std::array<OtherName, 35> kOtherOptions = {{
    {"--margin", "--padding"},
    {"--island-margin", "--padding"},
    {"--gutter", "--padding"},
    {"--spacing", "--padding"},
    {"--bleed", "--padding"},
    {"--texture-size", "--resolution"},
    {"--texture-size", "--size"},
    {"--texture-resolution", "--resolution"},
    {"--texture-resolution", "--size"},
    {"--image-size", "--resolution"},
    {"--image-size", "--size"},
    {"--max-charts", "--charts"},
    {"--num-charts", "--charts"},
    {"--chart-count", "--charts"},
    {"--islands", "--charts"},
    {"--stretch", "--max-stretch"},
    {"--max-distortion", "--max-stretch"},
    {"--sharp", "--seams"},
    {"--angle-limit", "--seams"},
    {"--pack", "--keep-shape"},
    {"--pack-only", "--keep-shape"},
    {"--rotate", "--upright"},
    {"--rotation", "--upright"},
    {"--cut", "--seams"},
    {"--order", "--degree"},
    {"--injective", "--bijective"},
    {"--no-overlap", "--bijective"},
    {"--no-overlaps", "--bijective"},
    {"--iterations", "--max-iterations"},
    {"--timeout", "--time-limit"},
    {"--jobs", "--threads"},
    {"-j", "--threads"},
    {"--overwrite", "--force"},
    {"--checker", "--view"},
    {"--checkerboard", "--view"},
}};

bool is_option(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

// Or will be one.
bool is_file(const std::string& word) {
  std::error_code ignored;
  return is_mesh_name(word) || !foreign_format(word).empty() ||
         std::filesystem::is_regular_file(word, ignored);
}

std::vector<std::string> verbs_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& word) {
  return std::find(names.begin(), names.end(), word) != names.end();
}

// The one of `names` that other tools call `word`; empty if there is none.
std::string other_name(const std::string& word, std::span<const OtherName> others,
                       const std::vector<std::string>& names) {
  for (const auto& [other, ours] : others)
    if (word == other && contains(names, ours)) return ours;
  return {};
}

std::string verb_near(const std::string& word, const std::vector<std::string>& verbs) {
  const std::string verb = other_name(word, kOtherVerbs, verbs);
  return verb.empty() ? nearest(word, verbs) : verb;
}

[[noreturn]] void refuse_verb(const std::string& word, const std::vector<std::string>& verbs) {
  const std::string verb = verb_near(word, verbs);
  throw Error(ErrorKind::Usage,
              verb.empty() ? fmt::format("no verb is called '{}'; use one of {} (see majorant "
                                         "--help)",
                                         word, fmt::join(verbs, ", "))
                           : fmt::format("no verb is called '{}'; did you mean '{}' (see majorant "
                                         "{} --help)?",
                                         word, verb, verb));
}

std::vector<std::string> long_options(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> verbs_with(const CLI::App& app, const std::string& option) {
  std::vector<std::string> names;
  for (const std::string& name : verbs_of(app))
    if (contains(long_options(*app.get_subcommand(name)), option)) names.push_back(name);
  return names;
}

// The message about a word that the verb has no place for.
std::string about_extra(const CLI::App& app, const CLI::App& verb, const std::string& word) {
  if (!is_option(word)) return fmt::format("one word too many: '{}'", word);
  const std::string option = word.substr(0, word.find('='));
  const std::string problem = fmt::format("{} has no option '{}'", verb.get_name(), option);
  const std::vector<std::string> names = long_options(verb);
  if (const std::string ours = other_name(option, kOtherOptions, names); !ours.empty())
    return problem + did_you_mean(ours, {ours});
  const std::vector<std::string> others = verbs_with(app, option);
  if (!others.empty()) return fmt::format("{}, {} has", problem, fmt::join(others, ", "));
  return problem + did_you_mean(option, names);
}

}  // namespace

std::vector<std::string> meant_words(const CLI::App& app, std::vector<std::string> words) {
  const auto first = std::find_if_not(words.begin(), words.end(), is_option);
  const std::vector<std::string> verbs = verbs_of(app);
  const std::vector<std::string> questions{"--help", "-h", "--version", "-V", "--licenses"};
  if (first == words.end()) {
    for (const std::string& question : questions)
      if (contains(words, question)) return words;
    throw Error(ErrorKind::Usage, fmt::format("name a verb: one of {} (see majorant --help)",
                                              fmt::join(verbs, ", ")));
  }
  const auto verb = std::find_if(words.begin(), words.end(),
                                 [&](const std::string& word) { return contains(verbs, word); });
  if (verb != words.end() && is_option(words.front()) && !contains(questions, words.front()))
    throw Error(ErrorKind::Usage,
                fmt::format("'{0}' comes after the verb: majorant {1} ... {0} (see majorant {1} "
                            "--help)",
                            words.front(), *verb));
  if (contains(verbs, *first)) return words;
  if (*first == "help") {
    const auto topic = std::find_if_not(first + 1, words.end(), is_option);
    if (topic == words.end()) return {"--help"};
    if (!contains(verbs, *topic)) refuse_verb(*topic, verbs);
    return {*topic, "--help"};
  }
  // Behind an option may be its value.
  const auto last = first == words.begin() ? first + 1 : words.end();
  const auto file = std::find_if(first, last, is_file);
  if (file != last) {
    if (!contains(verbs, kDefaultVerb))
      throw Error(ErrorKind::Usage,
                  fmt::format("'{0}' is a file; name a verb first, as in majorant parametrize {0} "
                              "-o OUT.obj (see majorant --help)",
                              *file));
    words.insert(words.begin(), kDefaultVerb);
    return words;
  }
  refuse_verb(*first, verbs);
}

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) return fmt::format("{} (see majorant --help)", error.what());
  const CLI::App* innermost = chosen.front();
  std::string name = innermost->get_name();
  while (!innermost->get_subcommands().empty()) {
    innermost = innermost->get_subcommands().front();
    name += " " + innermost->get_name();
  }
  const CLI::App& verb = *innermost;
  std::string problem = error.what();
  const std::vector<std::string> extra = verb.remaining();
  // An unknown option explains what else is wrong: its value is taken for a file.
  const auto option = std::find_if(extra.begin(), extra.end(), is_option);
  if (option != extra.end())
    problem = about_extra(app, verb, *option);
  else if (!extra.empty())
    problem = about_extra(app, verb, extra.front());
  return fmt::format("{} (see majorant {} --help)", problem, name);
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
