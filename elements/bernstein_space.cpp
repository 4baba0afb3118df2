#include "majorant/elements/bernstein_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/elements/internal/det_coefficients.h"
#include "majorant/elements/internal/element_check.h"
#include "majorant/elements/internal/node_lattice.h"
#include "majorant/elements/internal/positivity.h"
#include "majorant/elements/internal/small_buffer.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/argument_check.h"

namespace majorant {
namespace {

// Local coordinates and coefficients of elements of moderate degree stay on the stack.
using Scratch = SmallBuffer<double, 128>;

const BernsteinElement& checked(const BernsteinElement& element) {
  check_description(element);
  return element;
}

std::size_t local_size(const BernsteinSpace& space) {
  return to_size(space.reference_dim() * space.nodes_per_element());
}

// store(i, k): number i of element e (D per local node) is unknown k.
template <class Store>
void gather(const BernsteinSpace& space, Index e, const Store& store) {
  const int dim = space.reference_dim(), nodes = space.nodes_per_element();
  const Index* node = &space.cells()(e, 0);
  for (int k = 0; k < nodes; ++k)
    for (int c = 0; c < dim; ++c) store(dim * k + c, dim * node[k] + c);
}

// Coordinates of a triangle with straight edges: 3 corners in the plane.
constexpr int kTriangleSize = 6;

template <int K>
double largest_step_in(const BernsteinSpace& space, const DetCoefficients& coefficients,
                       const Subdivision& subdivision, Index e, VecIn x, VecIn d, double s,
                       int max_depth) {
  SmallBuffer<StepPolynomial<1>, 128> c(local_size(space));
  SmallBuffer<StepPolynomial<K>, 128> det(to_size(coefficients.count()));
  gather(space, e, [&, at = c.data()](int i, Index k) { at[i] = {{x[k], d[k]}}; });
  coefficients.along_line(c.data(), det.data());
  return largest_positive_step(subdivision, det.data(), s, max_depth);
}

}  // namespace

struct BernsteinSpace::Tables {
  explicit Tables(const BernsteinSpace& space)
      : lattice(space.basis_),
        det(space.element_),
        subdivision(det.basis(), space.element_.bisections) {
    check_determinants(space.element_, det);
  }

  NodeLattice lattice;
  DetCoefficients det;
  Subdivision subdivision;
};

BernsteinSpace::BernsteinSpace(const BernsteinElement& element, const Cells& cells,
                               Index vertex_count)
    : element_(checked(element)),
      vertex_count_(vertex_count),
      basis_(element.basis(element.degrees())),
      tables_(std::make_shared<const Tables>(*this)),
      numbering_(number_nodes(tables_->lattice, cells, vertex_count, element.name)) {}

BernsteinSpace::BernsteinSpace(const BernsteinElement& element, NodeNumbering numbering)
    : element_(checked(element)),
      vertex_count_(numbering.node_count),
      basis_(element.basis(element.degrees())),
      tables_(std::make_shared<const Tables>(*this)),
      numbering_(std::move(numbering)) {
  const NodeLattice& lattice = tables_->lattice;
  if (numbering_.cells.cols() != lattice.node_count())
    throw InvalidArgument(fmt::format("{}: cells of {} nodes, {} are needed", element.name,
                                      numbering_.cells.cols(), lattice.node_count()));
  for (Index e = 0; e < numbering_.cells.rows(); ++e)
    for (const Index node : numbering_.cells.row(e))
      if (node < 0 || node >= numbering_.node_count)
        throw InvalidArgument(fmt::format("{}: cell {} has node {}, there are {}", element.name, e,
                                          node, numbering_.node_count));
}

RowMatrix BernsteinSpace::node_positions(const RowMatrix& vertices) const {
  if (vertices.rows() != vertex_count_)
    throw InvalidArgument(fmt::format("{}: {} positions for {} vertices", element_.name,
                                      vertices.rows(), vertex_count_));
  const NodeLattice& lattice = tables_->lattice;
  RowMatrix out = RowMatrix::Zero(node_count(), vertices.cols());
  out.topRows(vertex_count_) = vertices;
  for (Index e = 0; e < element_count(); ++e)
    for (int l = lattice.corner_count(); l < lattice.node_count(); ++l) {
      out.row(cells()(e, l)).setZero();
      for (int c = 0; c < lattice.corner_count(); ++c)
        out.row(cells()(e, l)) += lattice.weight(l, c) * vertices.row(cells()(e, c));
      out.row(cells()(e, l)) /= lattice.total_weight();
    }
  return out;
}

ContractionTable BernsteinSpace::tabulate(const Quadrature& rule) const {
  return contraction_table(element_, rule);
}

Quadrature BernsteinSpace::default_rule(RestJacobian rest) const {
  const Factors& cell = element_.factors;
  const int n = element_.degree, dim = element_.dim();
  // By the coordinates of a factor: one derivative lowers the degree in its own factor alone, every
  // product of the determinant has as many of them as the factor has dimensions.
  const int jacobian = cell.size() == 1 ? n - 1 : n;
  int degree = 0;
  for (const int corners : cell) {
    const int determinant = rest == RestJacobian::Varying ? dim * n - (corners - 1) : 0;
    degree = std::max({degree, 2 * jacobian, determinant});
  }
  return exact_rule(cell, std::min(degree, highest_exactness(cell)));
}

void BernsteinSpace::require_element(Index e, VecIn x) const {
  require_index("element", e, element_count());
  require_enough("the map x", x.size(), reference_dim() * node_count());
}

PositivityProof BernsteinSpace::certify(Index e, VecIn x, int max_depth) const {
  require_element(e, x);
  const DetCoefficients& coefficients = tables_->det;
  if (coefficients.is_one_minor()) {
    double c[kTriangleSize], det, error;
    gather(*this, e, [&](int i, Index k) { c[i] = x[k]; });
    coefficients.minor_with_error(c, &det, &error);
    if (det - error > 0) return {ProofStatus::Proven, det - error, 0};
  }
  const std::size_t size = local_size(*this), count = to_size(coefficients.count());
  Scratch c(size), det(count), error(count);
  gather(*this, e, [at = c.data(), &x](int i, Index k) { at[i] = x[k]; });
  if (!std::all_of(c.data(), c.data() + size, [](double v) { return std::isfinite(v); }))
    return {ProofStatus::Violated, -std::numeric_limits<double>::infinity(), 0};
  const auto prove = [&] {
    const double largest = *std::max_element(error.data(), error.data() + count);
    return certify_positive(tables_->subdivision, det.data(), largest, max_depth);
  };
  coefficients.at_with_error(c.data(), det.data(), error.data());
  const PositivityProof proof = prove();
  if (proof.result == ProofStatus::Proven) return proof;
  coefficients.at_with_error_quad(c.data(), det.data(), error.data());
  return prove();
}

double BernsteinSpace::largest_step(Index e, VecIn x, VecIn d, double s, int max_depth) const {
  require_element(e, x);
  require_enough("the direction d", d.size(), reference_dim() * node_count());
  if (tables_->det.is_one_minor()) {
    StepPolynomial<1> c[kTriangleSize];
    gather(*this, e, [&](int i, Index k) { c[i] = {{x[k], d[k]}}; });
    if (plainly_positive(tables_->det.minor_along_line(c), s)) return s;
  }
  const auto largest = element_.dim() == 2 ? largest_step_in<2> : largest_step_in<3>;
  return largest(*this, tables_->det, tables_->subdivision, e, x, d, s, max_depth);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
