// A VTK XML UnstructuredGrid of one piece, with arrays in any encoding. Meshes of cells and maps
// are made from it.
//
//   const VtkDocument file(path, text, stop);
//   const Points3 points = file.points();
//   if (const XmlElement* data = file.piece().child("PointData"))
//     if (const XmlElement* uv = file.find_array(*data, "uv")) file.arrays().doubles(*uv);
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/io/vtu_arrays.h"
#include "majorant/io/xml_tree.h"

namespace majorant {

struct VtkCells {
  std::vector<long long> connectivity, offsets, types;
};

class VtkDocument {
 public:
  // content: of the whole file. Members throw Error(Unreadable) and Stopped. `path` and `stop` must
  // outlive this.
  VtkDocument(const std::string& path, std::string content, const StopCheck& stop);
  VtkDocument(const VtkDocument&) = delete;
  VtkDocument& operator=(const VtkDocument&) = delete;

  const VtuArrays& arrays() const { return arrays_; }
  const std::string& xml() const { return content_; }  // without its appended data
  const XmlElement& piece() const { return *piece_; }
  const XmlElement* field_data() const { return grid_->child("FieldData"); }
  const XmlElement& points_array() const;
  bool is_before(int major, int minor) const;  // compares the version of the file

  // Returns the child of an element. Throws if there is none.
  const XmlElement& require_child(const XmlElement& parent, std::string_view name) const;
  // Returns the array with this name, in upper or lower case; null if there is none. Two such
  // arrays are refused, since readers would choose differently.
  const XmlElement* find_array(const XmlElement& section, std::string_view name) const;
  // Returns the array with a role of VTK: the one that the section's attribute names, else the one
  // with the role's name; null if there is none.
  const XmlElement* find_role(const XmlElement& section, std::string_view role) const;

  // Both return as many entries as the piece announces.
  Points3 points() const;
  VtkCells cells() const;
  // Returns whether weights make the cells rational functions; equal weights cancel.
  bool is_rational() const;

  [[noreturn]] void fail(std::string_view problem) const;

 private:
  const std::string& path_;
  std::string content_;
  VtuArrays arrays_;
  XmlElement root_;
  const XmlElement* grid_ = nullptr;
  const XmlElement* piece_ = nullptr;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
