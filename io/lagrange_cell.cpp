#include "majorant/io/lagrange_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/rounding.h"
#include "majorant/maps/bezier_cell.h"

namespace majorant {
namespace {

// A linear map of the numbers of a cell, in VTK's order: a row for each result, a column for each
// input. Every weight is correctly rounded.
class CellMatrix {
 public:
  explicit CellMatrix(int degree)
      : indices_(bezier_multi_indices(degree)), weights_(indices_.size() * indices_.size()) {}

  std::size_t size() const { return indices_.size(); }
  const std::array<int, 3>& index(std::size_t k) const { return indices_[k]; }
  Float128& weight(std::size_t row, std::size_t column) { return weights_[row * size() + column]; }
  Float128 weight(std::size_t row, std::size_t column) const {
    return weights_[row * size() + column];
  }

 private:
  std::vector<std::array<int, 3>> indices_;
  std::vector<Float128> weights_;
};

Float128 factorials(const std::array<int, 3>& index) {
  Float128 product = 1;
  for (const int i : index)
    for (int k = 2; k <= i; ++k) product *= k;
  return product;
}

// Returns the matrix from control points to values: n! / (i! j! k!) a^i b^j c^k / n^n. Numerators
// are exact integers.
CellMatrix evaluation(int degree) {
  CellMatrix matrix(degree);
  Float128 scale = 1;
  for (int k = 0; k < degree; ++k) scale *= degree;
  for (std::size_t row = 0; row < matrix.size(); ++row)
    for (std::size_t column = 0; column < matrix.size(); ++column) {
      Float128 value = factorials({degree, 0, 0}) / factorials(matrix.index(column));
      for (std::size_t c = 0; c < 3; ++c)
        for (int k = 0; k < matrix.index(column)[c]; ++k) value *= matrix.index(row)[c];
      matrix.weight(row, column) = value / scale;
    }
  return matrix;
}

// Coefficients of the monomials of degree n in three variables, by exponents of the first two.
using Form = std::vector<Float128>;

std::size_t place(int degree, int i, int j) { return to_size(i * (degree + 1) + j); }

// Returns form * (n x_axis - s (x_0 + x_1 + x_2)), of degree `power` + 1. All numbers are integers.
Form times_factor(const Form& form, int degree, int power, int axis, int s) {
  Form product(form.size(), 0);
  for (int i = 0; i <= power; ++i)
    for (int j = 0; i + j <= power; ++j) {
      const Float128 c = form[place(degree, i, j)];
      product[place(degree, i + 1, j)] += c * ((axis == 0 ? degree : 0) - s);
      product[place(degree, i, j + 1)] += c * ((axis == 1 ? degree : 0) - s);
      product[place(degree, i, j)] += c * ((axis == 2 ? degree : 0) - s);
    }
  return product;
}

// Returns the matrix from values to control points. The polynomial that is 1 at (i, j, k) / n and 0
// at the other points is
//     prod_{s < i} (n x_0 - s) prod_{s < j} (n x_1 - s) prod_{s < k} (n x_2 - s) / (i! j! k!);
// with 1 = x_0 + x_1 + x_2 in place of every lone s it is homogeneous, and the coefficient of
// x_0^a x_1^b x_2^c, times a! b! c! / n!, is its control point (a, b, c).
CellMatrix interpolation(int degree) {
  CellMatrix matrix(degree);
  for (std::size_t column = 0; column < matrix.size(); ++column) {
    Form form(to_size((degree + 1) * (degree + 1)), 0);
    form[0] = 1;
    int power = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (int s = 0; s < matrix.index(column)[axis]; ++s)
        form = times_factor(form, degree, power++, axis, s);
    for (std::size_t row = 0; row < matrix.size(); ++row) {
      const auto& index = matrix.index(row);
      matrix.weight(row, column) = form[place(degree, index[0], index[1])] * factorials(index) /
                                   (factorials({degree, 0, 0}) * factorials(matrix.index(column)));
    }
  }
  return matrix;
}

// Returns the inputs of each result: the corner itself, or for points of an edge those along it.
std::vector<std::vector<int>> inputs_of(int degree) {
  const Index size = bezier_cell_size(degree);
  std::vector<int> all(to_size(size));
  for (Index k = 0; k < size; ++k) all[k] = k;
  std::vector<std::vector<int>> inputs(to_size(size), all);
  for (int edge = 0; edge < 3; ++edge) {
    const std::vector<int> along = bezier_edge_points(degree, edge);
    for (const int k : along) inputs[k] = along;
  }
  for (int k = 0; k < 3; ++k) inputs[k] = {k};
  return inputs;
}

struct Rounded {
  Vector2 value, error;
};

class CellTransform {
 public:
  CellTransform(CellMatrix matrix, int degree)
      : matrix_(std::move(matrix)), inputs_(inputs_of(degree)), reversed_(inputs_) {
    for (std::vector<int>& inputs : reversed_) std::reverse(inputs.begin(), inputs.end());
  }

  // Returns result `row` of a cell of a map, in extended precision.
  Vector2 value(const MapFile& map, Index cell, int row) const {
    if (inputs_[row].size() == 1) return map.uv.row(map.cells(cell, inputs_[row][0]));
    const std::vector<int>& inputs = inputs_in_order(map, cell, row);
    Vector2 value;
    for (int axis = 0; axis < 2; ++axis)
      value[axis] = static_cast<double>(
          sum(map, cell, row, axis, inputs, [](const Float128&, const Float128&, Index) {}));
    return value;
  }

  Rounded rounded(const MapFile& map, Index cell, int row) const {
    if (inputs_[row].size() == 1) {
      const Index point = map.cells(cell, inputs_[row][0]);
      return {map.uv.row(point), rounding(map, point)};
    }
    const std::vector<int>& inputs = inputs_in_order(map, cell, row);
    Rounded result;
    for (int axis = 0; axis < 2; ++axis) {
      double magnitudes = 0, error = 0;
      const Float128 exact =
          sum(map, cell, row, axis, inputs,
              [&](const Float128& weight, const Float128& term, Index point) {
                magnitudes += std::abs(static_cast<double>(term));
                if (map.uv_rounding.rows() > 0)
                  error += std::abs(static_cast<double>(weight)) * rounding(map, point)[axis];
              });
      // Rounding of the weights, terms and sums, each rounded once.
      const double own =
          3 * static_cast<double>(inputs.size()) * kUnitRoundoff<Float128> * magnitudes;
      result.value[axis] = static_cast<double>(exact);
      const double cut_off = std::abs(static_cast<double>(exact - Float128(result.value[axis])));
      result.error[axis] =
          kRoundUp * (cut_off + own + error) + std::numeric_limits<double>::denorm_min();
    }
    return result;
  }

  // Calls visit(cell, k, result(cell, k)) for all results from `first` on, of all cells in order.
  // Results of an edge are visited once for all cells that share its points.
  template <class Result, class Visit>
  void apply_to_all(const MapFile& map, int first, const StopCheck& stop, const Result& result,
                    const Visit& visit) const {
    const auto cells = static_cast<Index>(map.cells.rows());
    const auto columns = static_cast<int>(map.cells.cols());
    const std::vector<Index> first_cell = first_cells(map);
    using Value = decltype(result(Index{}, int{}));
    std::vector<std::optional<Value>> results(to_size(std::min(cells, kCells)) * to_size(columns));
    for (Index begin = 0; begin < cells; begin += kCells) {
      const Index count = std::min(kCells, cells - begin);
      stop.poll();
      parallel_for(count, kPiece, [&](Index c) {
        for (int k = first; k < columns; ++k) {
          std::optional<Value>& mine = results[to_size(c * columns + k)];
          mine.reset();
          const Index cell = begin + c;
          if (!has_edge_of(map, first_cell[map.cells(cell, k)], cell, k)) mine = result(cell, k);
        }
      });
      for (Index c = 0; c < count; ++c)
        for (int k = first; k < columns; ++k)
          if (const auto& mine = results[to_size(c * columns + k)]) visit(begin + c, k, *mine);
    }
  }

 private:
  // Cells between two polls, some milliseconds; and cells of a task, about 0.1 ms.
  static constexpr Index kCells = 4096, kPiece = 32;
  // Exceeds the rounding of a bound to double, a part of 2^-53.
  static constexpr double kRoundUp = 1.0000001;

  static Vector2 rounding(const MapFile& map, Index point) {
    if (map.uv_rounding.rows() == 0) return Vector2::Zero();
    return map.uv_rounding.row(point);
  }

  // Returns the first cell of each point; -1 for points without a cell.
  static std::vector<Index> first_cells(const MapFile& map) {
    std::vector<Index> first(to_size(static_cast<Index>(map.uv.rows())), -1);
    for (auto cell = static_cast<Index>(map.cells.rows()); cell-- > 0;)
      for (const Index point : map.cells.row(cell)) first[point] = cell;
    return first;
  }

  // Returns whether `other`, which precedes `cell`, has the edge of result k, with k in its place.
  bool has_edge_of(const MapFile& map, Index other, Index cell, int k) const {
    const std::vector<int>& mine = inputs_[k];
    if (other == cell || mine.size() == 1 || mine.size() == matrix_.size()) return false;
    for (int row = 3; row < static_cast<int>(matrix_.size()); ++row)
      for (const std::vector<int>* theirs : {&inputs_[row], &reversed_[row]}) {
        const auto same = [&](int a, int b) {
          return map.cells(cell, a) == map.cells(other, b) && (a == k) == (b == row);
        };
        if (std::equal(mine.begin(), mine.end(), theirs->begin(), theirs->end(), same)) return true;
      }
    return false;
  }

  const std::vector<int>& inputs_in_order(const MapFile& map, Index cell, int row) const {
    const std::vector<int>& inputs = inputs_[row];
    const bool is_backwards = inputs.size() < matrix_.size() && runs_backwards(map, cell, inputs);
    return is_backwards ? reversed_[row] : inputs;
  }

  // Calls visit(weight, term, point) for every input.
  template <class Visit>
  Float128 sum(const MapFile& map, Index cell, int row, int axis, const std::vector<int>& inputs,
               const Visit& visit) const {
    Float128 sum = 0;
    for (const int k : inputs) {
      const Index point = map.cells(cell, k);
      const Float128 weight = matrix_.weight(to_size(row), to_size(k));
      const Float128 term = weight * map.uv(point, axis);
      sum += term;
      visit(weight, term, point);
    }
    return sum;
  }

  // The values decide, so that cells agree that do not share points.
  static bool runs_backwards(const MapFile& map, Index cell, const std::vector<int>& along) {
    for (std::size_t k = 0; k < along.size(); ++k)
      for (int axis = 0; axis < 2; ++axis) {
        const double here = map.uv(map.cells(cell, along[k]), axis);
        const double there = map.uv(map.cells(cell, along[along.size() - 1 - k]), axis);
        if (here != there) return here > there;
      }
    return false;
  }

  CellMatrix matrix_;
  std::vector<std::vector<int>> inputs_, reversed_;
};

}  // namespace

void require_lagrange_degree(const std::string& path, const MapFile& map) {
  if (map.degree > kHighestLagrangeDegree)
    throw Error(ErrorKind::Unsupported,
                fmt::format("cannot write {}: Lagrange cells have degrees up to {}, the map {}",
                            path, kHighestLagrangeDegree, map.degree));
}

Points2 lagrange_nodes(const MapFile& map, const StopCheck& stop) {
  Points2 nodes = map.uv;
  if (map.degree == 1) return nodes;
  const CellTransform transform(evaluation(map.degree), map.degree);
  transform.apply_to_all(
      map, 3, stop, [&](Index cell, int k) { return transform.value(map, cell, k); },
      [&](Index cell, int k, const Vector2& node) { nodes.row(map.cells(cell, k)) = node; });
  return nodes;
}

double lagrange_amplification(int degree) {
  const CellMatrix matrix = interpolation(degree);
  double largest = 0;
  for (std::size_t row = 0; row < matrix.size(); ++row) {
    double sum = 0;
    for (std::size_t column = 0; column < matrix.size(); ++column)
      sum += static_cast<double>(magnitude(matrix.weight(row, column)));
    largest = std::max(largest, sum);
  }
  return largest;
}

void take_as_lagrange_nodes(MapFile& map, const std::string& file, const StopCheck& stop) {
  if (map.degree == 1) return;
  if (map.degree > kHighestLagrangeDegree)
    throw Error(ErrorKind::Unreadable, fmt::format("{}: Lagrange cells of degree {}; up to {} are "
                                                   "supported",
                                                   file, map.degree, kHighestLagrangeDegree));
  const CellTransform transform(interpolation(map.degree), map.degree);
  Points2 uv = map.uv;
  Points2 rounding = Points2::Zero(uv.rows(), 2);
  std::vector<char> is_known(to_size(static_cast<Index>(uv.rows())), 0);
  const auto control_point = [&](Index cell, int k) { return transform.rounded(map, cell, k); };
  transform.apply_to_all(map, 0, stop, control_point, [&](Index cell, int k, const Rounded& at) {
    const Index point = map.cells(cell, k);
    if (is_known[point] && Vector2(uv.row(point)) != at.value)
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}: cell {}: its point {} is another cell's, on another curve; "
                              "damaged file",
                              file, cell, k));
    is_known[point] = 1;
    uv.row(point) = at.value;
    rounding.row(point) = at.error;
  });
  map.uv = std::move(uv);
  map.uv_rounding = std::move(rounding);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
