#include "majorant/elements/bernstein_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "majorant/elements/element_check.h"
#include "majorant/elements/small_buffer.h"

namespace majorant {
namespace {

// Local coordinates and coefficients of elements of moderate degree stay on the stack.
using Scratch = SmallBuffer<double, 128>;

const BernsteinElement& checked(const BernsteinElement& element) {
  check_description(element);
  return element;
}

std::size_t local_size(const ElementSpace& space) {
  return at(space.reference_dim() * space.nodes_per_element());
}

}  // namespace

BernsteinSpace::BernsteinSpace(const BernsteinElement& element, const Cells& cells,
                               Index vertex_count)
    : element_(checked(element)),
      vertex_count_(vertex_count),
      basis_(element.basis(element.degrees())),
      lattice_(basis_),
      numbering_(number_nodes(lattice_, cells, vertex_count, element.name)),
      det_(element),
      subdivision_(det_.basis(), element.bisections) {
  check_determinants(element, det_);
}

BernsteinSpace::BernsteinSpace(const BernsteinElement& element, NodeNumbering numbering)
    : element_(checked(element)),
      vertex_count_(numbering.node_count),
      basis_(element.basis(element.degrees())),
      lattice_(basis_),
      numbering_(std::move(numbering)),
      det_(element),
      subdivision_(det_.basis(), element.bisections) {
  check_determinants(element, det_);
  if (numbering_.cells.cols() != lattice_.node_count())
    throw std::invalid_argument(fmt::format("{}: cells of {} nodes, {} are needed", element.name,
                                            numbering_.cells.cols(), lattice_.node_count()));
}

RowMatrix BernsteinSpace::node_positions(const RowMatrix& vertices) const {
  if (vertices.rows() != vertex_count_)
    throw std::invalid_argument(fmt::format("{}: {} positions for {} vertices", element_.name,
                                            vertices.rows(), vertex_count_));
  RowMatrix out = RowMatrix::Zero(node_count(), vertices.cols());
  out.topRows(vertex_count_) = vertices;
  for (Index e = 0; e < element_count(); ++e)
    for (int l = lattice_.corner_count(); l < lattice_.node_count(); ++l) {
      out.row(cells()(e, l)).setZero();
      for (int c = 0; c < lattice_.corner_count(); ++c)
        out.row(cells()(e, l)) += lattice_.weight(l, c) * vertices.row(cells()(e, c));
      out.row(cells()(e, l)) /= lattice_.total_weight();
    }
  return out;
}

ContractionTable BernsteinSpace::tabulate(const Quadrature& rule) const {
  return contraction_table(element_, rule);
}

template <class Store>
void BernsteinSpace::gather(Index e, const Store& store) const {
  const int dim = element_.dim(), nodes = nodes_per_element();
  const Index* node = &numbering_.cells(e, 0);
  for (int k = 0; k < nodes; ++k)
    for (int c = 0; c < dim; ++c) store(dim * k + c, dim * node[k] + c);
}

PositivityProof BernsteinSpace::certify(Index e, VecIn x, int max_depth) const {
  const std::size_t size = local_size(*this), count = at(det_.count());
  Scratch c(size), det(count), error(count);
  gather(e, [at = c.data(), &x](int i, Index k) { at[i] = x[k]; });
  if (!std::all_of(c.data(), c.data() + size, [](double v) { return std::isfinite(v); }))
    return {Positivity::Violated, -std::numeric_limits<double>::infinity(), 0};
  const auto prove = [&] {
    const double largest = *std::max_element(error.data(), error.data() + count);
    return certify_positive(subdivision_, det.data(), largest, max_depth);
  };
  det_.at_with_error(c.data(), det.data(), error.data());
  const PositivityProof proof = prove();
  if (proof.result == Positivity::Certified) return proof;
  det_.at_with_error_quad(c.data(), det.data(), error.data());
  return prove();
}

template <int K>
double BernsteinSpace::largest_step_in(Index e, VecIn x, VecIn d, double s, int max_depth) const {
  SmallBuffer<StepPolynomial<1>, 128> c(local_size(*this));
  SmallBuffer<StepPolynomial<K>, 128> det(at(det_.count()));
  gather(e, [&, at = c.data()](int i, Index k) { at[i] = {{x[k], d[k]}}; });
  det_.along_line(c.data(), det.data());
  return largest_positive_step(subdivision_, det.data(), s, max_depth);
}

double BernsteinSpace::largest_step(Index e, VecIn x, VecIn d, double s, int max_depth) const {
  return element_.dim() == 2 ? largest_step_in<2>(e, x, d, s, max_depth)
                             : largest_step_in<3>(e, x, d, s, max_depth);
}

}  // namespace majorant
