#include "majorant/io/xml_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"

namespace majorant {
namespace {

// The largest depth of elements. VTK needs five. Chosen, not tuned.
constexpr std::size_t kDeepestElement = 64;
constexpr std::string_view kSpace = " \t\r\n";

std::string decode_entities(std::string_view value) {
  constexpr std::array<std::pair<std::string_view, char>, 5> kEntities = {
      {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}}};
  std::string decoded;
  while (!value.empty()) {
    char c = value.front();
    std::size_t length = 1;
    for (const auto& [entity, character] : kEntities) {
      if (!value.starts_with(entity)) continue;
      c = character;
      length = entity.size();
    }
    decoded += c;
    value.remove_prefix(length);
  }
  return decoded;
}

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == ':' ||
         c == '.';
}

class XmlParser {
 public:
  XmlParser(const std::string& file, std::string_view text) : file_(file), text_(text) {}

  // `stack` points into the vectors of the enclosing elements. Only the last child of an open
  // element is open, so growing the top's children moves nothing that the stack refers to.
  XmlElement parse() {
    XmlElement document;
    std::vector<XmlElement*> stack = {&document};
    while (true) {
      const std::size_t begin = at_;
      at_ = std::min(text_.find('<', at_), text_.size());
      const std::string_view between = text_.substr(begin, at_ - begin);
      if (stack.size() == 1 && between.find_first_not_of(kSpace) != std::string_view::npos) {
        fail("text outside of the root element; not an XML file");
      }
      if (stack.back()->children.empty() && stack.back()->text.empty()) {
        stack.back()->text = between;
      }
      if (at_ == text_.size()) break;
      read_markup(stack);
    }
    if (stack.size() != 1) fail("an element is not closed; the file is truncated");
    if (document.children.size() != 1) fail("no single root element; not a VTK file");
    return std::move(document.children.front());
  }

 private:
  void read_markup(std::vector<XmlElement*>& stack) {
    if (accept("<!--")) {
      skip_past("-->");
    } else if (accept("<?")) {
      skip_past("?>");
    } else if (accept("<!")) {
      skip_past(">");
    } else if (accept("</")) {
      const std::string_view name = read_name();
      skip_space();
      if (stack.size() == 1 || name != stack.back()->name || !accept(">")) {
        fail(fmt::format("misplaced end tag {}", in_quotes(name)));
      }
      stack.pop_back();
    } else {
      accept("<");
      read_start_tag(stack);
    }
  }

  void read_start_tag(std::vector<XmlElement*>& stack) {
    if (stack.size() > kDeepestElement) fail("elements nested too deeply; not a VTK file");
    XmlElement& element = stack.back()->children.emplace_back();
    element.name = read_name();
    while (true) {
      skip_space();
      if (accept("/>")) return;
      if (accept(">")) break;
      const std::string_view name = read_name();
      skip_space();
      if (!accept("=")) fail("attribute without a value");
      skip_space();
      const char quote = at_ < text_.size() ? text_[at_] : '\0';
      if (quote != '"' && quote != '\'') fail("attribute value without quotes");
      const std::size_t begin = ++at_;
      skip_past(quote == '"' ? "\"" : "'");
      element.attributes.emplace_back(name, decode_entities(text_.substr(begin, at_ - 1 - begin)));
    }
    stack.push_back(&element);
  }

  std::string_view read_name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_name_character(text_[at_])) ++at_;
    if (at_ == begin) fail("a name is missing; not XML, or truncated");
    return text_.substr(begin, at_ - begin);
  }

  void skip_space() { at_ = std::min(text_.find_first_not_of(kSpace, at_), text_.size()); }

  bool accept(std::string_view piece) {
    if (!text_.substr(at_).starts_with(piece)) return false;
    at_ += piece.size();
    return true;
  }

  void skip_past(std::string_view piece) {
    const std::size_t found = text_.find(piece, at_);
    if (found == std::string_view::npos) {
      fail(fmt::format("{} is missing; the file is truncated", in_quotes(piece)));
    }
    at_ = found + piece.size();
  }

  [[noreturn]] void fail(std::string_view problem) const {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size()));
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}:{}: {}", file_, 1 + std::count(text_.begin(), end, '\n'), problem));
  }

  const std::string& file_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::string_view XmlElement::attribute(std::string_view attribute_name,
                                       std::string_view otherwise) const {
  for (const auto& [key, value] : attributes) {
    if (key == attribute_name) return value;
  }
  return otherwise;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  for (const XmlElement& element : children) {
    if (element.name == child_name) return &element;
  }
  return nullptr;
}

XmlElement parse_xml(const std::string& file, std::string_view text) {
  return XmlParser(file, text).parse();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
