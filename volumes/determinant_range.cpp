#include "majorant/volumes/determinant_range.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/exact_determinant.h"
#include "majorant/framework/error.h"
#include "majorant/framework/exact_integers.h"
#include "majorant/framework/rounding.h"
#include "majorant/volumes/internal/reference_cell.h"

namespace majorant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSmallest = std::numeric_limits<double>::denorm_min();

// Control points, D numbers each; error[d] bounds the error of coordinate d.
struct ControlPoints {
  std::vector<double> c;
  std::array<double, 3> error{};
};

// Nodes are taken relative to the first node: det J is the same, and cells far from the origin lose
// few digits.
void find_control_points(const ReferenceCell& cell, const double* nodes, ControlPoints& out) {
  const int dim = cell.element().dim(), size = cell.basis().count(),
            stored = cell.type().node_count();
  out.c.assign(to_size(dim * size), 0);
  out.error = {};
  if (cell.nodes_are_control_points()) {
    std::copy(nodes, nodes + dim * size, out.c.begin());
    return;
  }
  const Eigen::Map<const RowMatrix> points(nodes, stored, dim);
  const RowMatrix relative = points.rowwise() - points.row(0);
  Eigen::Map<RowMatrix>(out.c.data(), size, dim) = cell.control_points().lazyProduct(relative);
  // A difference, a weight and a product are rounded once each, a sum once for every term.
  // Underflow adds at most the smallest number.
  const double roundings = stored + 4;
  for (int d = 0; d < dim; ++d)
    out.error[to_size(d)] = 1.01 * (roundings * kUnitRoundoff<double> * cell.amplification() *
                                        relative.col(d).cwiseAbs().maxCoeff() +
                                    roundings * kSmallest);
}

// Bounds the error of the coefficients of det J. Derivatives are n times differences; coordinate d
// of a difference has the size S_d = 2 max |c_d| and the error e_d = 2 error_d. det J has D! terms
// with a factor of each coordinate, and prod (S_d + e_d) - prod S_d <= sum_d e_d prod_{k != d} (S_k
// + e_k).
double perturbation(const ReferenceCell& cell, const ControlPoints& points) {
  if (cell.nodes_are_control_points()) return 0;
  const int dim = cell.element().dim();
  std::array<double, 3> size{};
  for (std::size_t k = 0; k < points.c.size(); ++k) {
    double& largest = size[k % static_cast<std::size_t>(dim)];
    largest = std::max(largest, 2 * std::abs(points.c[k]));
  }
  double sum = 0;
  for (int d = 0; d < dim; ++d) {
    double term = 2 * points.error[to_size(d)];
    for (int k = 0; k < dim; ++k)
      if (k != d) term *= size[to_size(k)] + 2 * points.error[to_size(k)];
    sum += term;
  }
  const double terms = dim == 2 ? 2 : 6;  // D!
  return 1.01 * terms * integer_power(cell.type().degree, dim) * sum;
}

class RangeSearch {
 public:
  RangeSearch(const ReferenceCell& cell, const StopCheck& stop) : cell_(cell), stop_(stop) {}

  DeterminantRange find(const double* nodes) {
    const auto count = to_size(cell_.det().count());
    find_control_points(cell_, nodes, points_);
    coefficients_.resize(count);
    errors_.resize(count);
    DeterminantRange range;
    if (!std::all_of(points_.c.begin(), points_.c.end(), [](double x) { return std::isfinite(x); }))
      return {ProofStatus::Undecided, -kInfinity, kInfinity, -kInfinity, kInfinity, {}};
    cell_.det().at_with_error(points_.c.data(), coefficients_.data(), errors_.data());
    const double error =
        *std::max_element(errors_.begin(), errors_.end()) + perturbation(cell_, points_);
    const auto [least, most] = std::minmax_element(coefficients_.begin(), coefficients_.end());
    if (!std::isfinite(*least + *most + error))
      return exact_determinant_range(cell_.type(), nodes, stop_);
    range.largest = *most + error;
    range.largest_low = -kInfinity;
    for (const int k : cell_.subdivision().corners())
      range.largest_low = std::max(range.largest_low, coefficients_[to_size(k)] - error);
    bisect(error, range);
    if (range.positive != ProofStatus::Undecided) return range;
    const DeterminantRange exact = exact_determinant_range(cell_.type(), nodes, stop_);
    range.positive = exact.positive;
    if (exact.high <= range.high) range.at = exact.at;
    range.low = std::max(range.low, exact.low);
    range.high = std::min(range.high, exact.high);
    return range;
  }

 private:
  // The maximum number of open pieces; cells with a minimum of 1e-9 of their mean need as many.
  static constexpr std::size_t kMostPieces = 600;

  struct Piece {
    double low, error;
    int depth;
    PieceFrame frame;
    std::vector<double> a;
  };
  static bool is_higher(const Piece& a, const Piece& b) { return a.low > b.low; }

  void open(Piece piece, DeterminantRange& range) {
    piece.low = kInfinity;
    for (const double a : piece.a) piece.low = std::min(piece.low, a - piece.error);
    for (const int k : cell_.subdivision().corners()) {
      const double value = piece.a[to_size(k)] + piece.error;
      if (value < range.high) {
        range.high = value;
        range.at = corner_point(cell_.element(), cell_.det(), piece.frame, k);
      }
    }
    open_.push_back(std::move(piece));
    std::push_heap(open_.begin(), open_.end(), is_higher);
  }

  static bool is_found(const DeterminantRange& range) {
    const bool has_sign = range.low > 0 || range.high <= 0;
    return has_sign && range.high - range.low <=
                           kRangeTolerance * std::max(std::abs(range.low), std::abs(range.high));
  }

  void bisect(double error, DeterminantRange& range) {
    range.high = kInfinity;
    open_.clear();
    open({0, error, 0, PieceFrame(cell_.element().coordinate_count()), coefficients_}, range);
    for (std::size_t pieces = 1;; pieces += 2) {
      range.low = std::min(open_.front().low, range.high);
      if (is_found(range) || pieces > kMostPieces) break;
      // Further bisection does not improve bounds that differ by rounding alone.
      if (range.high - range.low <= 4 * open_.front().error) break;
      stop_.poll();
      std::pop_heap(open_.begin(), open_.end(), is_higher);
      const Piece parent = std::move(open_.back());
      open_.pop_back();
      split(parent, range);
    }
    if (range.low > 0) range.positive = ProofStatus::Proven;
    if (range.high <= 0) range.positive = ProofStatus::Violated;
  }

  void split(const Piece& parent, DeterminantRange& range) {
    double largest = 0;
    for (const double a : parent.a) largest = std::max(largest, std::abs(a));
    // As in elements/positivity.cpp: an average adds half an ulp, or half the smallest number.
    const double rounding = 1.01 * cell_.subdivision().levels(parent.depth) *
                            (kUnitRoundoff<double> * largest + kSmallest);
    const double error = std::nextafter(parent.error + rounding, kInfinity);
    std::vector<double> first(parent.a.size()), second(parent.a.size());
    cell_.subdivision().bisect(parent.depth, parent.a.data(), first.data(), second.data());
    const std::vector<EdgeBisection>& cuts = cell_.element().bisections;
    const EdgeBisection& cut = cuts[to_size(parent.depth) % cuts.size()];
    open({0, error, parent.depth + 1, parent.frame.child(cut, cut.first), std::move(first)}, range);
    open({0, error, parent.depth + 1, parent.frame.child(cut, cut.second), std::move(second)},
         range);
  }

  const ReferenceCell& cell_;
  const StopCheck& stop_;
  ControlPoints points_;
  std::vector<double> coefficients_, errors_;
  std::vector<Piece> open_;
};

// ---- In integers. ----

IntegerNet<ExactInteger> integer_net(const ReferenceCell& cell, const double* nodes) {
  const auto dim = to_size(cell.element().dim());
  const auto size = to_size(cell.basis().count()), stored = to_size(cell.type().node_count());
  const std::vector<double> all(nodes, nodes + dim * stored);
  std::vector<ExactInteger> out = to_integers<ExactInteger>(all);
  int lowest = std::numeric_limits<int>::max();  // as to_integers() counts
  for (const double x : all)
    if (x != 0) lowest = std::min(lowest, std::ilogb(x));
  const bool is_zero = lowest == std::numeric_limits<int>::max();
  const int shift = is_zero ? 0 : std::numeric_limits<double>::digits - 1 - lowest;
  ExactInteger denominator = 1;
  if (!cell.nodes_are_control_points()) {
    const ReferenceCell::ExactMatrix& matrix = cell.exact_control_points();
    std::vector<ExactInteger> combined(dim * size);
    for (std::size_t r = 0; r < size; ++r)
      for (std::size_t k = 0; k < stored; ++k)
        for (std::size_t d = 0; d < dim && matrix.numerators[r * stored + k] != 0; ++d)
          combined[dim * r + d] += matrix.numerators[r * stored + k] * out[dim * k + d];
    out = std::move(combined);
    denominator = matrix.denominator;
  }
  ExactInteger unit = 1;
  for (std::size_t d = 0; d < dim; ++d) unit *= denominator;
  std::size_t c = 0;
  for (const int corners : cell.element().factors) {
    int degree = 0;
    for (int k = 0; k < corners; ++k) degree += cell.det().basis().exponents(0)[c++];
    for (int k = 2; k <= degree; ++k) unit *= k;
  }
  // Coordinates are integers times 2^-shift; a large power moves to the numerators.
  const int total = shift * static_cast<int>(dim);
  if (total > 0) unit <<= static_cast<unsigned>(total);
  if (total < 0)
    for (ExactInteger& x : out) x <<= static_cast<unsigned>(-shift);
  return {std::move(out), std::move(unit)};
}

// Returns the product of the lengths of the edges at the corner of a triangle where it is largest.
double largest_pair(const Vector3& a, const Vector3& b) {
  const double x = a.norm(), y = b.norm(), z = (b - a).norm();
  return std::max({x * y, x * z, y * z});
}

double largest_triple(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double x = a.norm(), y = b.norm(), z = c.norm();
  const double xy = (b - a).norm(), xz = (c - a).norm(), yz = (c - b).norm();
  return std::max({x * y * z, x * xy * xz, y * xy * yz, z * xz * yz});
}

// Returns det J divided by its scale, from the derivatives.
double scaled_jacobian(CellShape shape, const Vector3* j, const Vector3& normal) {
  const bool is_flat = dimension(shape) == 2;
  const double det = is_flat ? normal.dot(j[0].cross(j[1])) : j[0].dot(j[1].cross(j[2]));
  const double of_triangles = 2 / std::numbers::sqrt3;
  double size = 0;
  switch (shape) {
    case CellShape::Triangle:
      size = largest_pair(j[0], j[1]) / of_triangles;
      break;
    case CellShape::Quad:
      size = j[0].norm() * j[1].norm();
      break;
    case CellShape::Tetrahedron:
      size = largest_triple(j[0], j[1], j[2]) / std::numbers::sqrt2;
      break;
    case CellShape::Wedge:
      size = largest_pair(j[0], j[1]) * j[2].norm() / of_triangles;
      break;
    default:
      size = j[0].norm() * j[1].norm() * j[2].norm();
  }
  return size > 0 ? det / size : 0;
}

}  // namespace

void require_tables(const std::string& file, const CellType& type) {
  if (dimension(type.shape) < 2) return;
  if (type.degree < 1 || type.degree > CellType::kMaxDegree)
    throw Error(ErrorKind::Unsupported, fmt::format("{}: {}; degrees 1 to {} are supported", file,
                                                    describe(type), CellType::kMaxDegree));
}

DeterminantRange determinant_range(const CellType& type, const double* nodes,
                                   const StopCheck& stop) {
  require_tables("determinant_range", type);
  const ReferenceCell& cell = ReferenceCell::of(type);
  if (cell.det().count() > 1) return RangeSearch(cell, stop).find(nodes);
  // On straight simplices det J is constant.
  double det = 0, error = 0;
  cell.det().at_with_error(nodes, &det, &error);
  if (!(std::abs(det) > error)) return exact_determinant_range(type, nodes, stop);
  const double low = det - error, high = det + error;
  const PieceFrame frame(cell.element().coordinate_count());
  return {low > 0 ? ProofStatus::Proven : ProofStatus::Violated, low, high, low, high,
          corner_point(cell.element(), cell.det(), frame, 0)};
}

DeterminantRange exact_determinant_range(const CellType& type, const double* nodes,
                                         const StopCheck& stop) {
  require_tables("exact_determinant_range", type);
  const ReferenceCell& cell = ReferenceCell::of(type);
  const auto size = to_size(cell.element().dim() * type.node_count());
  if (!std::all_of(nodes, nodes + size, [](double x) { return std::isfinite(x); }))
    return {ProofStatus::Undecided, -kInfinity, kInfinity, -kInfinity, kInfinity, {}};
  using Search = ExactDeterminant<ExactInteger>;
  return Search({cell.element(), cell.det(), cell.subdivision()}, Search::Bounds::OfTheMinimum,
                stop)
      .find(integer_net(cell, nodes));
}

double sampled_scaled_jacobian(const CellType& type, const double* nodes, const Vector3& normal) {
  const ReferenceCell& cell = ReferenceCell::of(type);
  const Eigen::Map<const Points3> points(nodes, type.node_count(), 3);
  const int dim = cell.element().dim();
  const Points3 control =
      cell.nodes_are_control_points() ? Points3(points) : Points3(cell.control_points() * points);
  const Points3 derivatives = cell.sampled_gradients() * control;
  double least = kInfinity;
  for (Index s = 0; s < derivatives.rows(); s += dim) {
    std::array<Vector3, 3> j;
    for (int d = 0; d < dim; ++d) j[to_size(d)] = derivatives.row(s + d);
    least = std::min(least, scaled_jacobian(type.shape, j.data(), normal));
  }
  return least;
}

Vector3 point_of_cell(const CellType& type, const double* nodes, const std::array<double, 6>& at) {
  const ReferenceCell& cell = ReferenceCell::of(type);
  const Eigen::Map<const Points3> points(nodes, type.node_count(), 3);
  Vec values(cell.basis().count());
  for (int k = 0; k < values.size(); ++k) {
    values[k] = cell.basis().weight(k);
    for (std::size_t c = 0; c < at.size(); ++c)
      values[k] *= integer_power(at[c], cell.basis().exponents(k)[c]);
  }
  return (values.transpose() * cell.control_points() * points).transpose();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
