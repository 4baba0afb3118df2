#include "majorant/elements/bernstein_space.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/det_coefficients.h"
#include "majorant/elements/internal/element_check.h"
#include "majorant/elements/internal/node_lattice.h"
#include "majorant/elements/internal/small_buffer.h"
#include "majorant/elements/positivity.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/rounding.h"

namespace majorant {

namespace {

double exact(double integer) {
  if (!(integer < kExactIntegers))
    throw InvalidArgument("BernsteinBasis: degree too high for exact weights");
  return integer;
}

// Returns (e_0 + e_1 + ...)! / (e_0! e_1! ...).
double multinomial(const int* e, int size) {
  double out = 1;
  for (int k = 0, total = 0; k < size; ++k)
    for (int j = 1; j <= e[k]; ++j) out = exact(out * ++total) / j;
  return out;
}

}  // namespace

BernsteinBasis::BernsteinBasis(Factors factors, std::vector<Exponents> functions)
    : factors_(std::move(factors)),
      coordinates_(std::accumulate(factors_.begin(), factors_.end(), 0)),
      functions_(std::move(functions)) {
  if (coordinates_ > static_cast<int>(Exponents{}.size()))
    throw InvalidArgument("BernsteinBasis: cell with too many coordinates");
  for (int k = 0; k < count(); ++k) {
    double weight = 1;
    const int* e = exponents(k).data();
    for (const int corners : factors_) {
      weight = exact(weight * multinomial(e, corners));
      e += corners;
    }
    weights_.push_back(weight);
    lookup_.emplace(exponents(k), k);
  }
}

int BernsteinBasis::find(const Exponents& e) const {
  const auto found = lookup_.find(e);
  return found == lookup_.end() ? -1 : found->second;
}

bool BernsteinBasis::is_corner(int k) const {
  const int* e = exponents(k).data();
  for (const int corners : factors_) {
    if (*std::max_element(e, e + corners) != std::accumulate(e, e + corners, 0)) return false;
    e += corners;
  }
  return true;
}

Vec BernsteinBasis::values(VecIn point) const {
  Index columns = 0;
  for (const int corners : factors_) columns += corners == 2 ? 1 : corners;
  require_size("BernsteinBasis::values: the point", point.size(), columns);
  std::array<double, Exponents{}.size()> x{};
  Index from = 0;
  std::size_t to = 0;
  for (const int corners : factors_)
    if (corners == 2) {  // a segment, given by one number
      x[to++] = 1 - point[from];
      x[to++] = point[from++];
    } else {
      for (int k = 0; k < corners; ++k) x[to++] = point[from++];
    }
  Vec b(count());
  for (int k = 0; k < count(); ++k) {
    b[k] = weight(k);
    for (std::size_t c = 0; c < to; ++c) b[k] *= integer_power(x[c], exponents(k)[c]);
  }
  return b;
}

namespace {

// Returns the number of Bernstein polynomials of this degree on a simplex: (degree + corners - 1)!
// / (degree! (corners - 1)!).
int function_count(int corners, int degree) {
  int count = 1;
  for (int k = 1; k < corners; ++k) count = count * (degree + k) / k;
  return count;
}

bool has_degrees(const Factors& factors, const Degrees& degrees, const Exponents& e) {
  auto at = e.begin();
  for (std::size_t f = 0; f < factors.size(); at += factors[f++])
    if (std::accumulate(at, at + factors[f], 0) != degrees[f]) return false;
  return *std::min_element(e.begin(), e.end()) >= 0;
}

}  // namespace

int BernsteinElement::corner_count() const {
  int count = 1;
  for (const int corners : factors) count *= corners;
  return count;
}

int BernsteinElement::coordinate_count() const {
  return std::accumulate(factors.begin(), factors.end(), 0);
}

std::vector<Exponents> BernsteinElement::functions(const Degrees& of) const {
  std::vector<Exponents> out = lattice(of);
  std::size_t expected = 1;
  for (std::size_t f = 0; f < of.size(); ++f)
    expected *= to_size(function_count(factors[f], of[f]));
  const bool all = std::all_of(out.begin(), out.end(),
                               [&](const Exponents& e) { return has_degrees(factors, of, e); });
  if (!all || out.size() != expected || std::set(out.begin(), out.end()).size() != expected)
    throw InvalidArgument(
        fmt::format("{}: lattice({}) must be the {} functions of these degrees, each once", name,
                    fmt::join(of, ", "), expected));
  return out;
}

double BernsteinElement::measure() const {
  double measure = 1;
  for (const int corners : factors)
    for (int k = 2; k < corners; ++k) measure /= k;
  return measure;
}

int BernsteinElement::factor_of(int coordinate) const {
  int factor = 0;
  while (coordinate >= factors[factor]) coordinate -= factors[factor++];
  return factor;
}

Degrees BernsteinElement::lowered(int factor) const {
  Degrees d = degrees();
  --d[factor];
  return d;
}

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

// Calls store(i, k): number i of element e (D per local node) is unknown k.
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
  // A derivative by a coordinate lowers the degree in its own factor only. Every product of the
  // determinant has as many derivatives by a factor's coordinates as the factor has dimensions.
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
