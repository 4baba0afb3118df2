#include <algorithm>
#include <numeric>

#include "majorant/framework/error.h"
#include "majorant/io/io.h"

namespace majorant {
namespace {

// Returns the rows of an array of all charts, chart by chart; none if a chart lacks it.
template <class Array>
Array stacked(const std::vector<MapFile>& charts, Array MapFile::*array) {
  Eigen::Index rows = 0;
  for (const MapFile& chart : charts) {
    if ((chart.*array).rows() == 0) return {};
    rows += (chart.*array).rows();
  }
  Array all(rows, (charts.front().*array).cols());
  rows = 0;
  for (const MapFile& chart : charts) {
    all.middleRows(rows, (chart.*array).rows()) = chart.*array;
    rows += (chart.*array).rows();
  }
  return all;
}

// Returns the rows in the given order: row k of the result is row order[k].
template <class Array>
void reorder(Array& array, const std::vector<Index>& order) {
  if (array.rows() > 0) array = Array(array(order, Eigen::all));
}

}  // namespace

MapFile joined(const std::vector<MapFile>& charts) {
  if (charts.empty()) throw InvalidArgument("joined: no charts");
  MapFile all;
  all.degree = charts.front().degree;
  for (const MapFile& chart : charts)
    if (chart.degree != all.degree) throw InvalidArgument("joined: different degrees");
  all.points = stacked(charts, &MapFile::points);
  all.uv = stacked(charts, &MapFile::uv);
  all.cells = stacked(charts, &MapFile::cells);
  all.input_vertex = stacked(charts, &MapFile::input_vertex);
  all.input_face = stacked(charts, &MapFile::input_face);
  all.distortion = stacked(charts, &MapFile::distortion);
  all.min_det = stacked(charts, &MapFile::min_det);
  all.face_distortion = stacked(charts, &MapFile::face_distortion);
  for (const MapFile& chart : charts) all.is_complete &= chart.is_complete;
  all.chart.resize(all.cells.rows());
  Eigen::Index cell = 0;
  Index point = 0;
  int first_chart = 0;
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const Eigen::Index cells = charts[k].cells.rows();
    all.cells.middleRows(cell, cells).array() += point;
    auto chart = all.chart.segment(cell, cells);
    chart.setConstant(first_chart);
    if (charts[k].chart.size() > 0) chart += charts[k].chart;
    if (cells > 0) first_chart = chart.maxCoeff() + 1;
    cell += cells;
    point += static_cast<Index>(charts[k].points.rows());
  }
  std::vector<Index> order(static_cast<std::size_t>(all.cells.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return all.input_face[a] < all.input_face[b]; });
  reorder(all.cells, order);
  reorder(all.input_face, order);
  reorder(all.distortion, order);
  reorder(all.min_det, order);
  reorder(all.face_distortion, order);
  reorder(all.chart, order);
  return all;
}

MapFile with_cells(const MapFile& map, const std::vector<Index>& cells) {
  std::vector<Index> number(to_size(static_cast<Index>(map.points.rows())), -1), points;
  MapFile part = map;
  reorder(part.cells, cells);
  reorder(part.input_face, cells);
  reorder(part.distortion, cells);
  reorder(part.min_det, cells);
  reorder(part.face_distortion, cells);
  reorder(part.chart, cells);
  reorder(part.seam_edges, cells);
  for (const Index p : part.cells.reshaped()) number[p] = 0;
  for (std::size_t p = 0; p < number.size(); ++p)
    if (number[p] == 0) {
      number[p] = static_cast<Index>(points.size());
      points.push_back(static_cast<Index>(p));
    }
  for (Index& p : part.cells.reshaped()) p = number[p];
  reorder(part.points, points);
  reorder(part.uv, points);
  reorder(part.uv_rounding, points);
  reorder(part.input_vertex, points);
  reorder(part.cone, points);
  return part;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
