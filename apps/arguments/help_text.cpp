#include "apps/arguments/help_text.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace majorant::app {
namespace {

constexpr std::array<const char*, 7> kGroups = {
    "Input and output", "Map", "Constraints", "Charts", "Solver", "Pictures", "General"};
constexpr std::size_t kColumn = 28;  // where the description of an option begins
// Bounds of the width of the help and its default, in columns of a terminal.
constexpr std::size_t kNarrowest = 50, kUsual = 80, kWidest = 110;

// The options used most, by verb. Verbs that are not listed have few options.
struct UsualOptions {
  std::string_view verb;
  std::array<const char*, 10> names;
};

constexpr std::array<UsualOptions, 9> kUsualOptions = {{
    {"parametrize",
     {"--output", "--degree", "--energy", "--bijective", "--pins", "--handles", "--seams", "--view",
      "--time-limit", "--report"}},
    {"unwrap",
     {"--output", "--seams", "--max-stretch", "--charts", "--padding", "--resolution", "--preset",
      "--bake", "--time-limit", "--report"}},
    {"seamless",
     {"--output", "--cones", "--start", "--curvature-alignment", "--degree", "--energy",
      "--bijective", "--grid", "--time-limit", "--report"}},
    {"deform",
     {"--output", "--handles", "--soft", "--pins", "--bijective", "--degree", "--energy",
      "--tolerance", "--time-limit", "--report"}},
    {"check",
     {"--surface", "--output", "--cuts", "--certify", "--seamless", "--stacked", "--quads",
      "--distortion", "--time-limit", "--report"}},
    {"compare",
     {"--output", "--methods", "--linear-solvers", "--degree", "--energy", "--init", "--tolerance",
      "--max-iterations", "--time-limit", "--report"}},
    {"convert",
     {"--output", "--refine", "--vtu", "--distortion", "--grid", "--color-by", "--size", "--align",
      "--view", "--image"}},
    {"bake",
     {"--from", "--output", "--image", "--attribute", "--size", "--method", "--distance",
      "--padding", "--samples", "--report"}},
    {"mesh optimize",
     {"--output", "--energy", "--target", "--boundary", "--list", "--tolerance", "--max-iterations",
      "--time-limit", "--threads", "--report"}},
}};

// Returns the width of the terminal on stdout; without one, the value of COLUMNS.
std::size_t help_width() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    return std::clamp(std::size_t{size.ws_col}, kNarrowest, kWidest);
  const char* columns = std::getenv("COLUMNS");
  const long width = columns ? std::strtol(columns, nullptr, 10) : 0;
  return width > 0 ? std::max(static_cast<std::size_t>(width), kNarrowest) : kUsual;
}

// Returns `text` in lines of at most `width` columns; all lines but the first are indented.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t width) {
  std::string lines;
  std::size_t used = indent;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (used > indent && used + 1 + word.size() > width) {
      lines += "\n" + std::string(indent, ' ');
      used = indent;
    } else if (used > indent) {
      lines += ' ';
      ++used;
    }
    lines += word;
    used += word.size();
  }
  return lines;
}

// Returns two columns, the name and its description, which begins a line of its own below a wide
// name.
std::string entry(const std::string& name, const std::string& meaning, std::size_t width) {
  std::string line = "  " + name;
  if (meaning.empty()) return line + "\n";
  if (line.size() + 2 > kColumn)
    line += "\n" + std::string(kColumn, ' ');
  else
    line.resize(kColumn, ' ');
  return line + wrapped(meaning, kColumn, width) + "\n";
}

// The parts of CLI11's type names: "INT:from 1 to 8", "TEXT:{free,fixed}", "FILE".
struct ValueType {
  explicit ValueType(const std::string& text)
      : name(text.substr(0, text.find(':'))),
        check(name.size() < text.size() ? text.substr(name.size() + 1) : "") {}
  std::string name, check;
};

std::string value_name(const ValueType& type) {
  if (type.check.starts_with('{')) {
    std::string choices = type.check.substr(1, type.check.find('}') - 1);
    std::replace(choices.begin(), choices.end(), ',', '|');
    return choices;
  }
  if (type.name == "INT" || type.name == "UINT") return "N";
  return type.name == "FLOAT" ? "X" : type.name;
}

bool is_range(const std::string& check) {
  return check.starts_with("from ") && check.find(" to ") != std::string::npos;
}

// Returns the names and the value of an option: "-o, --output FILE", "--view [X,Y,Z]".
std::string usage(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += "-" + name + ", ";
  for (const std::string& name : option.get_lnames()) names += "--" + name + ", ";
  names.resize(names.size() - 2);
  const std::string value = value_name(ValueType(option.get_type_name()));
  if (value.empty()) return names;  // a flag
  return names + (option.get_expected_min() == 0 ? " [" + value + "]" : " " + value);
}

std::string meaning(const CLI::Option& option) {
  const std::string check = ValueType(option.get_type_name()).check;
  return is_range(check) ? fmt::format("{} ({})", option.get_description(), check.substr(5))
                         : option.get_description();
}

std::string positionals(const CLI::App& app, std::size_t width) {
  std::string lines;
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional() && !option->nonpositional())
      lines += entry(option->get_name(true), option->get_description(), width);
  return lines;
}

std::string options_of(const CLI::App& app, const std::string& group, std::size_t width) {
  std::string lines;
  for (const CLI::Option* option : app.get_options())
    if (option->nonpositional() && option->get_group() == group)
      lines += entry(usage(*option), meaning(*option), width);
  return lines;
}

// Returns the options used most of a verb, "mesh optimize"; null if it has few.
const UsualOptions* usual_options(const CLI::App& app) {
  const CLI::App* const parent = app.get_parent();
  if (parent == nullptr) return nullptr;
  const std::string verb =
      parent->get_parent() == nullptr ? app.get_name() : parent->get_name() + " " + app.get_name();
  const auto* const usual =
      std::find_if(kUsualOptions.begin(), kUsualOptions.end(),
                   [&](const UsualOptions& options) { return options.verb == verb; });
  return usual == kUsualOptions.end() ? nullptr : usual;
}

// Returns the body of the short help: positional arguments, and the options used most.
std::string short_body(const CLI::App& app, const UsualOptions& usual, std::size_t width) {
  std::string lines = positionals(app, width);
  for (const char* name : usual.names)
    if (const CLI::Option* option = app.get_option_no_throw(name))
      lines += entry(usage(*option), meaning(*option), width);
  const std::vector<const CLI::Option*> all =
      app.get_options([](const CLI::Option* option) { return option->nonpositional(); });
  return fmt::format("\nOptions used most:\n{}\n`majorant {} --help` lists all {} options.\n",
                     lines, usual.verb, all.size());
}

std::string usage_line(const CLI::App& app, const std::string& name) {
  std::string line = "Usage: " + name;
  const bool has_verbs = !app.get_subcommands([](const CLI::App*) { return true; }).empty();
  if (has_verbs && app.get_parent() != nullptr) return line + " VERB [OPTIONS] ...\n";
  if (has_verbs) return line + " VERB [OPTIONS] ...\n       " + name + " input output\n";
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_positional() || option->nonpositional()) continue;
    const std::string word = option->get_name(true);
    line += option->get_required() ? " " + word : " [" + word + "]";
  }
  return line + " [OPTIONS]\n";
}

std::string verb_lines(const CLI::App& app) {
  const auto verbs = app.get_subcommands([](const CLI::App*) { return true; });
  std::string lines = verbs.empty() ? "" : "Verbs:\n";
  for (const CLI::App* verb : verbs)
    lines += entry(verb->get_name(), verb->get_description(), help_width());
  return lines;
}

}  // namespace

void begin_group(CLI::App& verb, OptionGroup group) {
  verb.option_defaults()->group(kGroups[static_cast<std::size_t>(group)]);
}

std::string value_words(const CLI::Option& option) {
  const ValueType type(option.get_type_name());
  const std::string range = is_range(type.check) ? fmt::format(", {}", type.check) : "";
  return value_name(type) + range;
}

std::string overview(const CLI::App& app, const std::string& rest) {
  return wrapped(app.get_description(), 0, help_width()) + "\n\n" + verb_lines(app) + "\n" + rest;
}

HelpLength help_length(const std::vector<std::string>& words) {
  const auto contains = [&](const char* word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  return contains("-h") && !contains("--help") ? HelpLength::Short : HelpLength::Full;
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode) const {
  const std::size_t width = help_width();
  std::string text = wrapped(app->get_description(), 0, width) + "\n\n" + usage_line(*app, name);
  if (const UsualOptions* usual = usual_options(*app); usual && length_ == HelpLength::Short) {
    const std::string footer = app->get_footer();
    return text + short_body(*app, *usual, width) + footer.substr(footer.find("Example: ")) + "\n";
  }
  if (const std::string verbs = verb_lines(*app); !verbs.empty()) text += "\n" + verbs;
  for (const char* group : kGroups) {
    std::string lines = options_of(*app, group, width);
    if (group == kGroups.front()) lines = positionals(*app, width) + lines;
    if (!lines.empty()) text += fmt::format("\n{}:\n{}", group, lines);
  }
  return text + "\n" + app->get_footer() + "\n";
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
