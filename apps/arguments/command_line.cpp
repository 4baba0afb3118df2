#include "apps/arguments/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <span>
#include <utility>

#include "apps/arguments/help_text.h"
#include "apps/arguments/suggestion.h"
#include "majorant/framework/error.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {
namespace {

constexpr const char* kDefaultVerb = "unwrap";

using OtherName = std::pair<const char*, const char*>;

// Verbs by the names that other tools use.
constexpr std::array<OtherName, 10> kOtherVerbs = {{
    {"pack", kDefaultVerb},
    {"flatten", kDefaultVerb},
    {"unfold", kDefaultVerb},
    {"uv", kDefaultVerb},
    {"verify", "check"},
    {"export", "convert"},
    {"describe", "info"},
    {"optimize", "mesh optimize"},
    {"untangle", "mesh optimize"},
    {"remesh", "quads"},
}};

// First words that stand for an option of the program.
constexpr std::array<OtherName, 4> kQuestionWords = {{
    {"help", "--help"},
    {"version", "--version"},
    {"licenses", "--licenses"},
    {"licences", "--licenses"},
}};

// Options with a word that takes a number: `--seams sharp=40`.
constexpr std::array<OtherName, 1> kWordsWithNumber = {{{"--seams", "sharp"}}};

// Options by the names that other tools use. A name may be listed twice: the first option that the
// verb has is meant.
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

// Returns whether the word names an existing or possible file, directory or device.
bool is_file(const std::string& word) {
  std::error_code ignored;
  return is_mesh_name(word) || !foreign_format(word).empty() ||
         word.find('/') != std::string::npos || std::filesystem::exists(word, ignored);
}

bool is_number(const std::string& word) {
  double number = 0;
  return !word.empty() && CLI::detail::lexical_cast(word, number);
}

[[noreturn]] void refuse_words(const std::string& problem, const std::string& verb = {}) {
  throw Error(ErrorKind::Usage,
              fmt::format("{} (see majorant {}{}--help)", problem, verb, verb.empty() ? "" : " "));
}

// Joins names as "a, b and c".
std::string list_text(const std::vector<std::string>& names) {
  if (names.size() < 2) return fmt::format("{}", fmt::join(names, ""));
  return fmt::format("{} and {}", fmt::join(names.begin(), std::prev(names.end()), ", "),
                     names.back());
}

std::vector<const CLI::App*> inner_verbs(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> verbs_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : inner_verbs(app)) names.push_back(verb->get_name());
  return names;
}

// A verb with all its words, "mesh check", and its parser.
struct WholeVerb {
  std::string name;
  const CLI::App* app;
};

std::vector<WholeVerb> whole_verbs(const CLI::App& app) {
  std::vector<WholeVerb> verbs;
  for (const CLI::App* verb : inner_verbs(app)) {
    const std::vector<const CLI::App*> inner = inner_verbs(*verb);
    if (inner.empty()) verbs.push_back({verb->get_name(), verb});
    for (const CLI::App* second : inner)
      verbs.push_back({verb->get_name() + " " + second->get_name(), second});
  }
  return verbs;
}

std::vector<std::string> whole_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const WholeVerb& verb : whole_verbs(app)) names.push_back(verb.name);
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& word) {
  return std::find(names.begin(), names.end(), word) != names.end();
}

// Returns the name among `names` that other tools call `word`; empty if there is none.
std::string other_name(const std::string& word, std::span<const OtherName> others,
                       const std::vector<std::string>& names) {
  for (const auto& [other, ours] : others)
    if (word == other && contains(names, ours)) return ours;
  return {};
}

[[noreturn]] void refuse_verb(const CLI::App& app, const std::string& word) {
  const std::vector<std::string> verbs = whole_names(app);
  if (word.empty()) refuse_words("the first word is empty; name a verb or a file");
  std::string verb = other_name(word, kOtherVerbs, verbs);
  if (verb.empty()) verb = nearest(word, verbs);
  if (verb.empty()) verb = nearest(word, verbs_of(app));
  if (verb.empty())
    refuse_words(fmt::format("no verb and no file is called '{}'; use one of {}", word,
                             fmt::join(verbs, ", ")));
  throw Error(ErrorKind::Usage,
              fmt::format("no verb is called '{}'; did you mean '{}' (see majorant {} --help)?",
                          word, verb, verb));
}

std::vector<std::string> option_names(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> long_options(const CLI::App& verb) {
  std::vector<std::string> names = option_names(verb);
  std::erase_if(names, [](const std::string& name) { return !name.starts_with("--"); });
  return names;
}

std::vector<std::string> verbs_with(const CLI::App& app, const std::string& option) {
  std::vector<std::string> names;
  for (const WholeVerb& verb : whole_verbs(app))
    if (contains(option_names(*verb.app), option)) names.push_back(verb.name);
  return names;
}

// Returns the message about an option that the verb lacks.
std::string about_option(const CLI::App& app, const WholeVerb& verb, const std::string& word) {
  const std::string option = word.substr(0, word.find('='));
  const std::string problem = fmt::format("{} has no option '{}'", verb.name, option);
  const std::vector<std::string> names = long_options(*verb.app);
  if (const std::string ours = other_name(option, kOtherOptions, names); !ours.empty())
    return problem + did_you_mean(ours, {ours});
  const std::vector<std::string> others = verbs_with(app, option);
  if (!others.empty())
    return fmt::format("{}; {} {} it", problem, list_text(others),
                       others.size() == 1 ? "has" : "have");
  return problem + did_you_mean(option, names);
}

// Returns the message about a word that the verb does not accept.
std::string about_extra(const CLI::App& app, const WholeVerb& verb, const std::string& word) {
  return is_option(word) ? about_option(app, verb, word)
                         : fmt::format("one word too many: '{}'", word);
}

std::string about_missing_value(const CLI::Option& option) {
  return fmt::format("{0}: its value is missing; write {0} {1}", option.get_name(),
                     value_words(option));
}

using Words = std::vector<std::string>;

// Refuses an option whose value is missing because the next option follows, and a number that is
// detached from its word. The parser would misread both.
void require_whole_values(const WholeVerb& verb, Words::const_iterator begin,
                          Words::const_iterator end) {
  const std::vector<std::string> names = option_names(*verb.app);
  for (auto word = begin; word != end && *word != "--"; ++word) {
    if (!is_option(*word)) continue;
    const auto behind = [&](int k) { return end - word > k ? word[k] : std::string(); };
    for (const auto& [option, value] : kWordsWithNumber) {
      const bool is_joined = *word == fmt::format("{}={}", option, value);
      const bool is_apart = *word == option && behind(1) == value;
      const std::string number = behind(is_apart ? 2 : 1);
      if (contains(names, option) && (is_joined || is_apart) && is_number(number))
        refuse_words(fmt::format("{0} {1} {2}: the number belongs to the word; write {0} {1}={2}",
                                 option, value, number),
                     verb.name);
    }
    const CLI::Option* option = verb.app->get_option_no_throw(*word);
    if (option != nullptr && option->get_expected_min() > 0 && option->get_type_size() != 0 &&
        contains(names, behind(1)))
      refuse_words(about_missing_value(*option), verb.name);
  }
}

// Returns the verb at the beginning of these words.
WholeVerb verb_of(const CLI::App& app, Words::const_iterator first, Words::const_iterator end) {
  const CLI::App* verb = app.get_subcommand(*first);
  const std::vector<std::string> inner = verbs_of(*verb);
  if (inner.empty()) return {*first, verb};
  const auto second = std::find_if_not(first + 1, end, is_option);
  if (second != end && contains(inner, *second))
    return {fmt::format("{} {}", *first, *second), verb->get_subcommand(*second)};
  return {*first, verb};
}

// Refuses a group of verbs without an inner verb, as in `mesh part.msh`.
void require_inner_verb(const CLI::App& app, const WholeVerb& verb, Words::const_iterator first,
                        Words::const_iterator end) {
  const std::vector<std::string> inner = verbs_of(*verb.app);
  if (inner.empty()) return;
  std::vector<std::string> names;
  for (const std::string& name : inner) names.push_back(fmt::format("{} {}", verb.name, name));
  const auto second = std::find_if_not(first + 1, end, is_option);
  if (second == end) {
    if (std::find_if(first, end, [](const std::string& word) {
          return word == "--help" || word == "-h";
        }) == end)
      refuse_words(fmt::format("name a verb: one of {}", fmt::join(names, ", ")), verb.name);
  } else if (is_file(*second)) {
    refuse_words(fmt::format("'{0}' is a file; name a verb first, as in majorant {1} {0}", *second,
                             names.front()),
                 verb.name);
  } else {
    refuse_verb(app, fmt::format("{} {}", *first, *second));
  }
}

// Returns `help VERB` as `VERB --help`.
Words help_words(const CLI::App& app, Words::const_iterator help, Words::const_iterator end) {
  Words topics;
  std::copy_if(help + 1, end, std::back_inserter(topics),
               [](const std::string& word) { return !is_option(word); });
  if (topics.empty() ||
      !other_name(topics.front(), kQuestionWords, {"--help", "--version", "--licenses"}).empty())
    return {"--help"};
  if (!contains(verbs_of(app), topics.front())) refuse_verb(app, topics.front());
  const WholeVerb verb = verb_of(app, topics.begin(), topics.end());
  const auto words = static_cast<std::size_t>(std::count(verb.name.begin(), verb.name.end(), ' '));
  if (topics.size() > words + 1) {
    if (!inner_verbs(*verb.app).empty())
      refuse_verb(app, fmt::format("{} {}", topics[0], topics[1]));
    refuse_words(fmt::format("one word too many: '{}'", topics[words + 1]), verb.name);
  }
  topics.push_back("--help");
  return topics;
}

// Returns the verb that the parser chose.
WholeVerb chosen_verb(const CLI::App& app) {
  WholeVerb verb{"", &app};
  while (!verb.app->get_subcommands().empty()) {
    verb.app = verb.app->get_subcommands().front();
    verb.name += (verb.name.empty() ? "" : " ") + verb.app->get_name();
  }
  return verb;
}

// Returns the parser's message in the words of the help.
std::string about(const CLI::App& verb, const CLI::ParseError& error) {
  const std::string text = error.what();
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr)
    return text + "; leave one of the two out";
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) == nullptr) return text;
  if (const std::size_t end = text.find(" was given a disallowed flag override");
      end != std::string::npos)
    return fmt::format("--{0}: takes no value; write --{0}, or leave it out", text.substr(0, end));
  const CLI::Option* option = verb.get_option_no_throw(text.substr(0, text.find(':')));
  if (option == nullptr) return text;
  if (text.ends_with(" missing")) return about_missing_value(*option);
  return fmt::format("{} is given {} times; give it once", option->get_name(), option->count());
}

}  // namespace

std::vector<std::string> completed_words(const CLI::App& app, std::vector<std::string> words) {
  const auto first = std::find_if_not(words.begin(), words.end(), is_option);
  const std::vector<std::string> verbs = verbs_of(app);
  const std::vector<std::string> questions = option_names(app);
  const auto is_question = [&](const std::string& word) { return contains(questions, word); };
  if (first == words.end()) {
    if (std::any_of(words.begin(), words.end(), is_question)) return words;
    for (const std::string& word : words)
      if (word != "--" && verbs_with(app, word.substr(0, word.find('='))).empty())
        refuse_words(about_option(app, {app.get_name(), &app}, word));
    refuse_words(fmt::format("name a verb: one of {}", fmt::join(whole_names(app), ", ")));
  }
  const auto verb = std::find_if(words.begin(), words.end(),
                                 [&](const std::string& word) { return contains(verbs, word); });
  if (verb != words.end() && is_option(words.front()) && words.front() != "--" &&
      !is_question(words.front())) {
    const WholeVerb whole = verb_of(app, verb, words.end());
    const std::string option = words.front().substr(0, words.front().find('='));
    if (!contains(option_names(*whole.app), option) && inner_verbs(*whole.app).empty())
      refuse_words(about_option(app, whole, option), whole.name);
    refuse_words(
        fmt::format("'{0}' comes after the verb: majorant {1} ... {0}", words.front(), whole.name),
        whole.name);
  }
  if (contains(verbs, *first)) {
    const WholeVerb whole = verb_of(app, first, words.end());
    require_inner_verb(app, whole, first, words.end());
    require_whole_values(whole, first, words.end());
    return words;
  }
  if (*first == "help") return help_words(app, first, words.end());
  if (const std::string question = other_name(*first, kQuestionWords, questions);
      !question.empty() && words.size() == 1)
    return {question};
  // A word after an option may be the value of that option, so only the first word is tested then.
  const auto last = first == words.begin() ? first + 1 : words.end();
  const auto file = std::find_if(first, last, is_file);
  if (file == last) refuse_verb(app, *first);
  if (!contains(verbs, kDefaultVerb))
    refuse_words(
        fmt::format("'{0}' is a file; name a verb first, as in majorant parametrize {0} -o "
                    "OUT.obj",
                    *file));
  words.insert(words.begin(), kDefaultVerb);
  require_whole_values({kDefaultVerb, app.get_subcommand(kDefaultVerb)}, words.begin(),
                       words.end());
  return words;
}

void require_values(const CLI::App& app) {
  const WholeVerb verb = chosen_verb(app);
  for (const CLI::Option* option : verb.app->get_options()) {
    const bool is_input = option->get_positional() && option->get_required();
    if (is_input || option->get_type_size() == 0 || option->get_expected_min() == 0) continue;
    if (contains(option->results(), ""))
      refuse_words(
          fmt::format("{}: its value is empty; give one, or leave it out", option->get_name()),
          verb.name);
  }
}

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const WholeVerb verb = chosen_verb(app);
  if (verb.app == &app) return fmt::format("{} (see majorant --help)", error.what());
  const std::vector<std::string> extra = verb.app->remaining();
  // An unknown option explains the other errors: its value was taken for a file.
  const auto option = std::find_if(extra.begin(), extra.end(), is_option);
  std::string problem = about(*verb.app, error);
  if (!extra.empty())
    problem = about_extra(app, verb, option != extra.end() ? *option : extra.front());
  return fmt::format("{} (see majorant {} --help)", problem, verb.name);
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
