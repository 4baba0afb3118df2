#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/stop_check.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/io.h"
#include "majorant/io/lagrange_cell.h"
#include "majorant/io/map_check.h"
#include "majorant/io/vtu_arrays.h"
#include "majorant/io/xml_tree.h"
#include "majorant/maps/bezier_cell.h"

namespace majorant {
namespace {

constexpr long long kTriangle = 5;
constexpr long long kQuadraticTriangle = 22;
constexpr long long kLagrangeTriangle = 69;
constexpr long long kBezierTriangle = 76;

bool is_lagrange(long long type) { return type == kLagrangeTriangle || type == kQuadraticTriangle; }

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

class VtuReader {
 public:
  VtuReader(const std::string& path, const StopCheck& stop)
      : path_(path),
        stop_(stop),
        content_(read_whole_file(path, stop)),
        arrays_(path, content_, stop) {}

  MapFile read() {
    const XmlElement root = parse_xml(path_, content_);
    if (root.name != "VTKFile" || root.attribute("type") != "UnstructuredGrid") {
      fail("not a VTK UnstructuredGrid file");
    }
    arrays_.configure(root);
    const XmlElement& grid = require_child(root, "UnstructuredGrid");
    if (std::count_if(grid.children.begin(), grid.children.end(),
                      [](const XmlElement& e) { return e.name == "Piece"; }) > 1) {
      fail("more than one Piece; merge the pieces into one");
    }
    const XmlElement& piece = require_child(grid, "Piece");
    read_points(piece);
    read_cells(require_child(piece, "Cells"));
    if (const XmlElement* data = piece.child("CellData")) read_cell_data(*data);
    if (const XmlElement* data = grid.child("FieldData")) read_claims(*data);
    if (const std::string defect = map_defect(map_); !defect.empty()) fail(defect);
    if (is_lagrange_) take_as_lagrange_nodes(map_, path_, stop_);
    return std::move(map_);
  }

 private:
  [[noreturn]] void fail(std::string_view problem) const {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", path_, problem));
  }

  const XmlElement& require_child(const XmlElement& parent, std::string_view name) const {
    const XmlElement* child = parent.child(name);
    if (child == nullptr) fail(fmt::format("{} without {}; incomplete file", parent.name, name));
    return *child;
  }

  // The array of a name, upper or lower case; null if there is none. Two are refused: readers would
  // not agree on which one it is.
  const XmlElement* find_array(const XmlElement& section, std::string_view name) const {
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

  // The array that plays a role of VTK's: the one that the section's attribute names, else the one
  // of the role's own name; null if there is none.
  const XmlElement* find_role(const XmlElement& section, std::string_view role) const {
    const std::string_view name = section.attribute(role);
    if (name.empty()) return find_array(section, role);
    const XmlElement* array = find_array(section, name);
    if (array == nullptr)
      fail(fmt::format("{} names array {}, which is not there; incomplete file", role,
                       in_quotes(name)));
    return array;
  }

  // #rows by `columns` out of an array of `components` per row, the first of which are taken.
  template <class Matrix>
  Matrix matrix(const XmlElement& array, int columns, int components) const {
    const std::vector<double> values = arrays_.doubles(array);
    const auto stride = to_size(components);
    if (values.size() % stride != 0) fail("an array does not fit its number of components");
    const auto rows = static_cast<Eigen::Index>(values.size() / stride);
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const RowMajor>(values.data(), rows, components).leftCols(columns);
  }

  void read_points(const XmlElement& piece) {
    const XmlElement& points = require_child(require_child(piece, "Points"), "DataArray");
    map_.points = matrix<Points3>(points, 3, 3);
    if (map_.points.rows() > std::numeric_limits<Index>::max()) fail("too many points");
    if (piece.attribute("NumberOfPoints") != std::to_string(map_.points.rows())) {
      fail(fmt::format("NumberOfPoints says {}, Points holds {}; damaged or truncated",
                       in_quotes(piece.attribute("NumberOfPoints")), map_.points.rows()));
    }
    const XmlElement* data = piece.child("PointData");
    const XmlElement* uv = data == nullptr ? nullptr : find_array(*data, "uv");
    if (uv == nullptr) fail("no PointData array 'uv'; not a parametrization");
    const std::string_view components = uv->attribute("NumberOfComponents");
    if (components != "2" && components != "3") fail("uv must have 2 or 3 components");
    map_.uv = matrix<Points2>(*uv, 2, components == "2" ? 2 : 3);
    if (const XmlElement* array = find_array(*data, "input_vertex")) {
      map_.input_vertex = index_array(*array);
    }
    if (const XmlElement* array = find_array(*data, "cone")) map_.cone = index_array(*array);
    if (const XmlElement* weights = find_role(*data, "RationalWeights")) {
      require_polynomial(arrays_.doubles(*weights));
    }
    cell_count_ = std::string(piece.attribute("NumberOfCells"));
  }

  // Equal weights cancel; others make rational functions of the cells.
  void require_polynomial(const std::vector<double>& weights) const {
    if (static_cast<Eigen::Index>(weights.size()) != map_.points.rows()) {
      fail("RationalWeights is not one number per point");
    }
    if (std::any_of(weights.begin(), weights.end(),
                    [&](double w) { return w != weights[0] || w == 0; })) {
      fail("rational cells (RationalWeights that differ, or 0) are not supported");
    }
  }

  // Three numbers per cell; what VTK makes of the third of a triangle differs between versions.
  void require_degrees(const std::vector<double>& degrees) const {
    const auto cells = static_cast<std::size_t>(map_.cells.rows());
    if (degrees.size() != 3 * cells) fail("HigherOrderDegrees is not 3 numbers per cell");
    for (std::size_t k = 0; k < degrees.size(); ++k) {
      if (degrees[k] != map_.degree && !(k % 3 == 2 && (degrees[k] == 0 || degrees[k] == 1))) {
        fail(fmt::format("cell {}: HigherOrderDegrees says {}, its points make degree {}", k / 3,
                         degrees[k], map_.degree));
      }
    }
  }

  void read_cells(const XmlElement& section) {
    const auto require = [&](std::string_view name) {
      const XmlElement* array = find_array(section, name);
      if (array == nullptr) fail(fmt::format("Cells without {}; incomplete file", name));
      return arrays_.integers(*array);
    };
    const std::vector<long long> connectivity = require("connectivity");
    const std::vector<long long> offsets = require("offsets");
    const std::vector<long long> types = require("types");
    if (types.empty()) fail("no cells");
    if (offsets.size() != types.size() || cell_count_ != std::to_string(types.size())) {
      fail("NumberOfCells, offsets and types disagree; damaged or truncated");
    }
    map_.degree = bezier_cell_degree(offsets[0]);
    if (map_.degree == 0) {
      fail(fmt::format("a cell of {} points is no triangle of degree 1..{}", offsets[0],
                       kHighestFileDegree));
    }
    const long long size = offsets[0];
    for (std::size_t f = 0; f < types.size(); ++f) {
      if (!fits(types[f]))
        fail(fmt::format("cell {} of type {}; only Bezier and Lagrange triangles are supported", f,
                         types[f]));
      if (is_lagrange(types[f]) != is_lagrange(types[0]))
        fail(fmt::format("cell {} is of another type than cell 0", f));
      if (offsets[f] != size * static_cast<long long>(f + 1)) {
        fail(fmt::format("cell {} has another number of points than cell 0", f));
      }
    }
    if (static_cast<long long>(connectivity.size()) != offsets.back()) {
      fail("connectivity and offsets disagree; damaged or truncated");
    }
    is_lagrange_ = map_.degree > 1 && is_lagrange(types[0]);
    map_.cells.resize(static_cast<Eigen::Index>(types.size()), size);
    std::transform(connectivity.begin(), connectivity.end(), map_.cells.data(),
                   [this](long long id) { return index(id); });
  }

  bool fits(long long type) const {
    return type == kBezierTriangle || type == kLagrangeTriangle ||
           (type == kTriangle && map_.degree == 1) ||
           (type == kQuadraticTriangle && map_.degree == 2);
  }

  // -1 (none) passes; map_defect refuses it where a point is needed.
  Index index(long long id) const {
    if (id < -1 || id > std::numeric_limits<Index>::max()) {
      fail(fmt::format("number {} out of range", id));
    }
    return static_cast<Index>(id);
  }

  Eigen::VectorXi index_array(const XmlElement& array) const {
    const std::vector<long long> values = arrays_.integers(array);
    Eigen::VectorXi result(static_cast<Eigen::Index>(values.size()));
    std::transform(values.begin(), values.end(), result.data(),
                   [this](long long id) { return index(id); });
    return result;
  }

  void read_cell_data(const XmlElement& section) {
    if (const XmlElement* degrees = find_role(section, "HigherOrderDegrees")) {
      require_degrees(arrays_.doubles(*degrees));
    }
    if (const XmlElement* array = find_array(section, "input_face")) {
      map_.input_face = index_array(*array);
    }
    if (const XmlElement* array = find_array(section, "distortion")) {
      map_.distortion = matrix<Vec>(*array, 1, 1);
    }
    if (const XmlElement* array = find_array(section, "min_det")) {
      map_.min_det = matrix<Vec>(*array, 1, 1);
    }
    read_face_distortion(section);
    if (const XmlElement* array = find_array(section, "chart")) map_.chart = index_array(*array);
    if (const XmlElement* array = find_array(section, "seam_edges")) {
      const Eigen::VectorXi values = index_array(*array);
      if (values.size() != 3 * map_.cells.rows()) fail("seam_edges is not 3 numbers per cell");
      map_.seam_edges = values.reshaped<Eigen::RowMajor>(map_.cells.rows(), 3);
    }
  }

  // All of its arrays or none: files of before they were written have none.
  void read_face_distortion(const XmlElement& section) {
    FaceDistortion all(map_.cells.rows(), kFaceDistortionNames.size());
    for (std::size_t k = 0; k < kFaceDistortionNames.size(); ++k) {
      const XmlElement* array = find_array(section, kFaceDistortionNames[k]);
      if (array == nullptr) return;
      const Vec values = matrix<Vec>(*array, 1, 1);
      if (values.size() != all.rows())
        fail(fmt::format("{} is not one number per cell", kFaceDistortionNames[k]));
      all.col(static_cast<Eigen::Index>(k)) = values;
    }
    map_.face_distortion = std::move(all);
  }

  void read_claims(const XmlElement& section) {
    const XmlElement* array = find_array(section, "majorant_claims");
    if (array != nullptr) map_.claims = arrays_.string(*array);
  }

  const std::string& path_;
  const StopCheck& stop_;
  std::string content_;
  VtuArrays arrays_;
  MapFile map_;
  std::string cell_count_;
  bool is_lagrange_ = false;
};

}  // namespace

MapFile read_vtu(const std::string& path, const StopCheck& stop) {
  return VtuReader(path, stop).read();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
