#include "majorant/io/map_check.h"

#include <fmt/format.h>

#include "majorant/framework/error.h"
#include "majorant/maps/bezier_cell.h"

namespace majorant {
namespace {

// Describes the defect of an array that must be complete or, if that is allowed, absent.
std::string size_defect(std::string_view name, Eigen::Index actual, Eigen::Index expected) {
  if (actual == expected || actual == 0) return {};
  return fmt::format("{} has {} entries instead of {}", name, actual, expected);
}

}  // namespace

std::string map_defect(const MapFile& map) {
  const Eigen::Index points = map.points.rows();
  const Eigen::Index cells = map.cells.rows();
  if (points == 0 || cells == 0) return "no cells";
  if (map.degree < 1 || map.degree > kHighestFileDegree ||
      map.cells.cols() != bezier_cell_size(map.degree)) {
    return fmt::format("cells of {} points do not fit degree {}", map.cells.cols(), map.degree);
  }
  if (map.uv.rows() != points) {
    return fmt::format("uv has {} entries instead of {}", map.uv.rows(), points);
  }
  for (const std::string& defect :
       {size_defect("input_vertex", map.input_vertex.size(), points),
        size_defect("input_face", map.input_face.size(), cells),
        size_defect("distortion", map.distortion.size(), cells),
        size_defect("min_det", map.min_det.size(), cells),
        size_defect("the distortion of faces", map.face_distortion.rows(), cells),
        size_defect("cone", map.cone.size(), points), size_defect("chart", map.chart.size(), cells),
        size_defect("seam_edges", map.seam_edges.rows(), cells)}) {
    if (!defect.empty()) return defect;
  }
  for (Eigen::Index f = 0; f < cells; ++f) {
    for (Eigen::Index k = 0; k < map.cells.cols(); ++k) {
      if (map.cells(f, k) >= 0 && map.cells(f, k) < points) continue;
      return fmt::format("cell {}: point {} out of range 0..{}", f, map.cells(f, k), points - 1);
    }
  }
  if (map.chart.size() > 0 && map.chart.minCoeff() < 0) return "a number of chart is negative";
  if (!map.points.allFinite()) return "a coordinate of points is not finite";
  if (!map.uv.allFinite()) return "a coordinate of uv is not finite";
  if (!map.distortion.allFinite()) return "a value of distortion is not finite";
  if (!map.min_det.allFinite()) return "a value of min_det is not finite";
  for (std::size_t k = 0; k < kFaceDistortionNames.size(); ++k)
    if (!map.face_distortion.col(static_cast<Eigen::Index>(k)).allFinite())
      return fmt::format("a value of {} is not finite", kFaceDistortionNames[k]);
  return {};
}

void require_sound(const std::string& path, const MapFile& map) {
  const std::string defect = map_defect(map);
  if (defect.empty()) return;
  throw Error(ErrorKind::Invalid, fmt::format("cannot write {}: {}", path, defect));
}

void require_complete(const std::string& path, const MapFile& map) {
  if (map.is_complete) return;
  throw Error(
      ErrorKind::Unsupported,
      fmt::format("cannot write {}: the run was stopped before all charts had a map, and the "
                  "format cannot say which faces have none; write .obj or .vtu",
                  path));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
