// Maps of elements for the shared test suite, independent of the library except for exponents and
// coordinates.
#pragma once

#include <gtest/gtest.h>

#include <map>

#include "elements/element_cases.h"
#include "exact_polynomials.h"

namespace majorant::test {

// A polynomial in the homogeneous coordinates of a cell, in the monomial basis.
class ExactPolynomial {
 public:
  void add(const Exponents& e, const Rational& value) { terms_[e] += value; }
  ExactPolynomial derivative(int coordinate) const {
    ExactPolynomial out;
    for (const auto& [e, value] : terms_) {
      Exponents low = e;
      const int exponent = low[static_cast<std::size_t>(coordinate)]--;
      if (exponent > 0) out.add(low, exponent * value);
    }
    return out;
  }
  friend ExactPolynomial operator*(const ExactPolynomial& a, const ExactPolynomial& b) {
    ExactPolynomial out;
    for (const auto& [e, x] : a.terms_)
      for (const auto& [f, y] : b.terms_) {
        Exponents sum = e;
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += f[k];
        out.add(sum, x * y);
      }
    return out;
  }
  ExactPolynomial& operator+=(const ExactPolynomial& b) {
    for (const auto& [e, y] : b.terms_) add(e, y);
    return *this;
  }
  friend ExactPolynomial operator*(int s, ExactPolynomial a) {
    for (auto& [e, x] : a.terms_) x *= s;
    return a;
  }
  Rational operator()(const std::vector<Rational>& x) const {
    Rational sum = 0;
    for (const auto& [e, value] : terms_) {
      Rational term = value;
      for (std::size_t k = 0; k < x.size(); ++k) term *= power(x[k], e[k]);
      sum += term;
    }
    return sum;
  }
  Rational coefficient(const Exponents& e) const {
    const auto found = terms_.find(e);
    return found == terms_.end() ? Rational(0) : found->second;
  }

 private:
  std::map<Exponents, Rational> terms_;
};

// Returns the product of the multinomial coefficients of the factors.
inline Rational exact_weight(const Factors& factors, const Exponents& e) {
  Rational weight = 1;
  std::size_t k = 0;
  for (const int corners : factors) {
    int degree = 0;
    for (int c = 0; c < corners; ++c, ++k) {
      weight /= factorial(e[k]);
      degree += e[k];
    }
    weight *= factorial(degree);
  }
  return weight;
}

// Returns det J of control points c (D numbers per node), by the Leibniz formula.
inline ExactPolynomial exact_det(const BernsteinElement& element, const std::vector<double>& c) {
  const int dim = element.dim();
  const std::vector<Exponents> nodes = element.lattice(element.degrees());
  std::vector<std::vector<ExactPolynomial>> jacobian(static_cast<std::size_t>(dim));
  for (int component = 0; component < dim; ++component) {
    ExactPolynomial x;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      x.add(
          nodes[k],
          exact_weight(element.factors, nodes[k]) *
              Rational(c[static_cast<std::size_t>(dim) * k + static_cast<std::size_t>(component)]));
    for (const auto& [plus, minus] : element.derivatives) {
      ExactPolynomial d = x.derivative(plus);
      d += -1 * x.derivative(minus);
      jacobian[static_cast<std::size_t>(component)].push_back(d);
    }
  }
  std::vector<std::size_t> p;
  for (std::size_t k = 0; k < jacobian.size(); ++k) p.push_back(k);
  ExactPolynomial det;
  do {
    int sign = 1;
    for (std::size_t k = 0; k < p.size(); ++k)
      for (std::size_t j = 0; j < k; ++j) sign *= p[j] > p[k] ? -1 : 1;
    ExactPolynomial term = sign * jacobian[0][p[0]];
    for (std::size_t k = 1; k < p.size(); ++k) term = term * jacobian[k][p[k]];
    det += term;
  } while (std::next_permutation(p.begin(), p.end()));
  return det;
}

// Returns the control points of element e, D numbers per node.
inline std::vector<double> control_points(const BernsteinSpace& space, VecIn x, Index e) {
  std::vector<double> c;
  const int dim = space.reference_dim();
  for (int k = 0; k < space.nodes_per_element(); ++k)
    for (int d = 0; d < dim; ++d) c.push_back(x[dim * space.cells()(e, k) + d]);
  return c;
}

// Returns homogeneous coordinates of random points inside the cell.
inline std::vector<double> random_coordinates(const Factors& factors, Random& random) {
  std::vector<double> x;
  for (const int corners : factors) {
    const std::size_t begin = x.size();
    double sum = 0;
    for (int k = 0; k < corners; ++k) sum += x.emplace_back(random.uniform(0.01, 1));
    for (std::size_t k = begin; k < x.size(); ++k) x[k] /= sum;
  }
  return x;
}

// Returns all points whose homogeneous coordinates are multiples of 1/m.
inline std::vector<std::vector<double>> lattice_coordinates(const Factors& factors, int m) {
  std::vector<std::vector<double>> out{{}};
  for (const int corners : factors) {
    std::vector<std::vector<double>> next;
    for (const auto& head : out) {
      const std::function<void(std::vector<double>, int, int)> fill = [&](std::vector<double> x,
                                                                          int left, int rest) {
        if (left == 1) {
          x.push_back(double(rest) / m);
          return next.push_back(x);
        }
        for (int k = 0; k <= rest; ++k) {
          std::vector<double> longer = x;
          longer.push_back(double(k) / m);
          fill(longer, left - 1, rest - k);
        }
      };
      fill(head, corners, m);
    }
    out = next;
  }
  return out;
}

// Returns the row of Quadrature::points for these homogeneous coordinates.
inline Eigen::RowVectorXd quadrature_point(const Factors& factors, const std::vector<double>& x) {
  std::vector<double> point;
  std::size_t k = 0;
  for (const int corners : factors) {
    for (int c = 0; c < corners; ++c, ++k)
      if (corners > 2 || c == 1) point.push_back(x[k]);
  }
  return Eigen::Map<Eigen::RowVectorXd>(point.data(), static_cast<Index>(point.size()));
}

// Returns all basis functions by their formula.
inline Vec basis_values(const BernsteinElement& element, const std::vector<double>& x) {
  const std::vector<Exponents> nodes = element.lattice(element.degrees());
  Vec b(static_cast<Index>(nodes.size()));
  for (std::size_t l = 0; l < nodes.size(); ++l) {
    double value = static_cast<double>(exact_weight(element.factors, nodes[l]));
    for (std::size_t k = 0; k < x.size(); ++k) value *= std::pow(x[k], nodes[l][k]);
    b[static_cast<Index>(l)] = value;
  }
  return b;
}

inline Vec map_point(const BernsteinSpace& space, VecIn unknowns, Index e,
                     const std::vector<double>& x) {
  const Vec b = basis_values(space.element(), x);
  const int dim = space.reference_dim();
  Vec p = Vec::Zero(dim);
  for (Index l = 0; l < b.size(); ++l) p += b[l] * unknowns.segment(dim * space.cells()(e, l), dim);
  return p;
}

// Returns nodes by reference dimension, from the table of `space` at quadrature point l.
inline RowMatrix reference_gradients(const ContractionTable& table, Index l) {
  RowMatrix g = RowMatrix::Zero(table.nodes, table.directions.cols());
  for (const GradientEntry& e : table.gradient)
    g.row(e.node) += e.coefficient * table.shape_gradient(l, e.shape_gradient) *
                     table.directions.row(e.direction);
  return g;
}

// Returns J of the map in reference coordinates.
inline Eigen::MatrixXd jacobian(const BernsteinSpace& space, const ContractionTable& table, VecIn x,
                                Index e, Index l) {
  const int dim = space.reference_dim();
  const std::vector<double> c = control_points(space, x, e);
  return Eigen::Map<const RowMatrix>(c.data(), space.nodes_per_element(), dim).transpose() *
         reference_gradients(table, l);
}

// Returns interleaved unknowns of one row per node.
inline Vec unknowns(const RowMatrix& positions) {
  return Eigen::Map<const Vec>(positions.data(), positions.size());
}

// Returns a rule of equal weights at the given homogeneous coordinates.
inline Quadrature rule_at(const Factors& factors, const std::vector<std::vector<double>>& points) {
  Quadrature q;
  q.cell = factors;
  const auto size = static_cast<Index>(points.size());
  q.weights = Vec::Constant(size, 1.0 / double(size));
  q.points.resize(size, quadrature_point(factors, points.front()).size());
  for (Index l = 0; l < size; ++l)
    q.points.row(l) = quadrature_point(factors, points[static_cast<std::size_t>(l)]);
  return q;
}

// Returns the smallest det J at many points of element e, in doubles.
inline double sampled_det(const BernsteinSpace& space, const ContractionTable& table, VecIn x,
                          Index e) {
  double lowest = std::numeric_limits<double>::infinity();
  for (Index l = 0; l < table.weights.size(); ++l)
    lowest = std::min(lowest, jacobian(space, table, x, e, l).determinant());
  return lowest;
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
