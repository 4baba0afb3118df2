// A small XML parser for VTK files: elements, attributes, leading text. It has no namespaces and no
// DTD. Views point into the parsed text, which must outlive the tree.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace majorant {

struct XmlElement {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string>> attributes;  // values decoded
  std::string_view text;  // up to the first child or the end tag; not decoded
  std::vector<XmlElement> children;

  // Returns the value of an attribute; `otherwise` if it is missing.
  std::string_view attribute(std::string_view attribute_name,
                             std::string_view otherwise = {}) const;
  // Returns the first child of that name; null if there is none.
  const XmlElement* child(std::string_view child_name) const;
};

// Returns the root element. Comments, processing instructions and <!DOCTYPE ...> are skipped.
// Throws Error(Unreadable, "file:line: ...") for text that is not well formed, or nested more than
// 64 levels deep. `file` is for messages.
XmlElement parse_xml(const std::string& file, std::string_view text);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
