#include "majorant/io/internal/vtk_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"

namespace majorant {
namespace {

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

}  // namespace

VtkDocument::VtkDocument(const std::string& path, std::string content, const StopCheck& stop)
    : path_(path),
      content_(std::move(content)),
      arrays_(path, content_, stop),
      root_(parse_xml(path, content_)) {
  if (root_.name != "VTKFile" || root_.attribute("type") != "UnstructuredGrid")
    fail("not a VTK UnstructuredGrid file");
  arrays_.configure(root_);
  grid_ = &require_child(root_, "UnstructuredGrid");
  if (std::count_if(grid_->children.begin(), grid_->children.end(),
                    [](const XmlElement& e) { return e.name == "Piece"; }) > 1)
    fail("more than one Piece; merge the pieces into one");
  piece_ = &require_child(*grid_, "Piece");
}

void VtkDocument::fail(std::string_view problem) const {
  throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", path_, problem));
}

const XmlElement& VtkDocument::require_child(const XmlElement& parent,
                                             std::string_view name) const {
  const XmlElement* child = parent.child(name);
  if (child == nullptr) fail(fmt::format("{} without {}; incomplete file", parent.name, name));
  return *child;
}

const XmlElement* VtkDocument::find_array(const XmlElement& section, std::string_view name) const {
  const XmlElement* found = nullptr;
  for (const XmlElement& array : section.children) {
    if ((array.name != "DataArray" && array.name != "Array") ||
        !same_name(array.attribute("Name"), name))
      continue;
    if (found != nullptr) fail(fmt::format("two arrays are called {}", in_quotes(name)));
    found = &array;
  }
  return found;
}

const XmlElement* VtkDocument::find_role(const XmlElement& section, std::string_view role) const {
  const std::string_view name = section.attribute(role);
  if (name.empty()) return find_array(section, role);
  const XmlElement* array = find_array(section, name);
  if (array == nullptr)
    fail(fmt::format("{} names array {}, which is not there; incomplete file", role,
                     in_quotes(name)));
  return array;
}

bool VtkDocument::is_before(int major, int minor) const {
  const std::string_view version = root_.attribute("version", "0.1");
  int found[2] = {0, 0};
  const char* const end = version.data() + version.size();
  const auto after = std::from_chars(version.data(), end, found[0]);
  if (after.ptr != end) std::from_chars(after.ptr + 1, end, found[1]);
  return found[0] < major || (found[0] == major && found[1] < minor);
}

const XmlElement& VtkDocument::points_array() const {
  return require_child(require_child(*piece_, "Points"), "DataArray");
}

Points3 VtkDocument::points() const {
  const XmlElement& array = points_array();
  if (array.attribute("NumberOfComponents", "3") != "3") fail("points without 3 coordinates");
  const std::vector<double> values = arrays_.doubles(array);
  if (values.size() % 3 != 0) fail("an array does not fit its number of components");
  const std::size_t count = values.size() / 3;
  if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max())) fail("too many points");
  if (piece_->attribute("NumberOfPoints") != std::to_string(count))
    fail(fmt::format("NumberOfPoints says {}, Points holds {}; damaged or truncated",
                     in_quotes(piece_->attribute("NumberOfPoints")), count));
  return Eigen::Map<const Points3>(values.data(), static_cast<Index>(count), 3);
}

VtkCells VtkDocument::cells() const {
  const XmlElement& section = require_child(*piece_, "Cells");
  const auto integers = [&](std::string_view name) {
    const XmlElement* array = find_array(section, name);
    if (array == nullptr) fail(fmt::format("Cells without {}; incomplete file", name));
    return arrays_.integers(*array);
  };
  VtkCells cells{integers("connectivity"), integers("offsets"), integers("types")};
  if (cells.types.empty()) fail("no cells");
  if (cells.offsets.size() != cells.types.size() ||
      piece_->attribute("NumberOfCells") != std::to_string(cells.types.size()))
    fail("NumberOfCells, offsets and types disagree; damaged or truncated");
  return cells;
}

bool VtkDocument::is_rational() const {
  const XmlElement* data = piece_->child("PointData");
  const XmlElement* array = data == nullptr ? nullptr : find_role(*data, "RationalWeights");
  if (array == nullptr) return false;
  const std::vector<double> weights = arrays_.doubles(*array);
  if (std::to_string(weights.size()) != piece_->attribute("NumberOfPoints"))
    fail("RationalWeights is not one number per point");
  return std::any_of(weights.begin(), weights.end(),
                     [&](double w) { return w != weights[0] || w == 0; });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
