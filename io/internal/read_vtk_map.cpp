#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/vtk_document.h"
#include "majorant/io/internal/vtk_types.h"
#include "majorant/io/io.h"
#include "majorant/io/lagrange_cell.h"
#include "majorant/io/map_check.h"
#include "majorant/maps/bezier_cell.h"

namespace majorant {
namespace {

class VtkMapReader {
 public:
  VtkMapReader(const std::string& path, const StopCheck& stop)
      : path_(path),
        stop_(stop),
        file_(path, read_whole_file(path, stop), stop),
        arrays_(file_.arrays()) {}

  MapFile read() {
    read_points();
    read_cells();
    if (const XmlElement* data = file_.piece().child("CellData")) read_cell_data(*data);
    if (const XmlElement* data = file_.field_data()) read_claims(*data);
    if (const std::string defect = map_defect(map_); !defect.empty()) fail(defect);
    if (is_lagrange_) take_as_lagrange_nodes(map_, path_, stop_);
    return std::move(map_);
  }

 private:
  [[noreturn]] void fail(std::string_view problem) const { file_.fail(problem); }

  const XmlElement* find_array(const XmlElement& section, std::string_view name) const {
    return file_.find_array(section, name);
  }

  // Reads #rows by `columns` from an array of `components` per row, of which the first ones are
  // taken.
  template <class Matrix>
  Matrix matrix(const XmlElement& array, int columns, int components) const {
    const std::vector<double> values = arrays_.doubles(array);
    const auto stride = to_size(components);
    if (values.size() % stride != 0) fail("an array does not fit its number of components");
    const auto rows = static_cast<Eigen::Index>(values.size() / stride);
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const RowMajor>(values.data(), rows, components).leftCols(columns);
  }

  void read_points() {
    map_.points = file_.points();
    const XmlElement* data = file_.piece().child("PointData");
    const XmlElement* uv = data == nullptr ? nullptr : find_array(*data, "uv");
    if (uv == nullptr) fail("no PointData array 'uv'; not a parametrization");
    const std::string_view components = uv->attribute("NumberOfComponents");
    if (components != "2" && components != "3") fail("uv must have 2 or 3 components");
    map_.uv = matrix<Points2>(*uv, 2, components == "2" ? 2 : 3);
    if (const XmlElement* array = find_array(*data, "input_vertex")) {
      map_.input_vertex = index_array(*array);
    }
    if (const XmlElement* array = find_array(*data, "cone")) map_.cone = index_array(*array);
    if (file_.is_rational())
      fail("rational cells (RationalWeights that differ, or 0) are not supported");
  }

  // There are three numbers per cell. VTK versions differ in the third one for triangles.
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

  void read_cells() {
    const auto& [connectivity, offsets, types] = file_.cells();
    map_.degree = bezier_cell_degree(offsets[0]);
    if (map_.degree == 0) {
      fail(fmt::format("a cell of {} points is no triangle of degree 1..{}", offsets[0],
                       kHighestFileDegree));
    }
    const long long size = offsets[0];
    for (std::size_t f = 0; f < types.size(); ++f) {
      if (f == 0 || types[f] != types[f - 1]) {
        if (!fits(types[f]))
          fail(fmt::format("cell {} of type {}; only Bezier and Lagrange triangles are supported",
                           f, types[f]));
        if (is_lagrange(types[f]) != is_lagrange(types[0]))
          fail(fmt::format("cell {} is of another type than cell 0", f));
      }
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

  bool fits(long long number) const {
    const std::optional<VtkType> type = vtk_type(number);
    return type && type->shape == CellShape::Triangle &&
           (type->degree == 0 || type->degree == map_.degree);
  }
  static bool is_lagrange(long long number) {
    const std::optional<VtkType> type = vtk_type(number);
    return type->kind == NodeKind::Uniform && type->degree != 1;
  }

  // Accepts -1 (none); map_defect refuses it if a point is needed.
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
    if (const XmlElement* degrees = file_.find_role(section, "HigherOrderDegrees")) {
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

  // Reads all of its arrays or none; older files lack them.
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
  VtkDocument file_;
  const VtuArrays& arrays_;
  MapFile map_;
  bool is_lagrange_ = false;
};

}  // namespace

MapFile read_vtu(const std::string& path, const StopCheck& stop) {
  return VtkMapReader(path, stop).read();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
