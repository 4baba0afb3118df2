#include "majorant/elements/det_coefficients.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "majorant/elements/internal/small_buffer.h"
#include "majorant/framework/error.h"
#include "majorant/framework/rounding.h"

namespace majorant {
namespace {

// The operations of the numbers in which det J is expanded: subtract(a, b) of control points,
// minor(a0, a1, b0, b1) = a0 b1 - a1 b0, product(a, cofactor), and sum += weight * x. Bounded is a
// number with the sum of the magnitudes of its terms.
template <class Real>
struct Bounded {
  Real value, size;
};

template <class Real>
Bounded<Real> minor(Real a0, Real a1, Real b0, Real b1) {
  return {a0 * b1 - a1 * b0, magnitude(a0 * b1) + magnitude(a1 * b0)};
}

template <class Real>
Bounded<Real> product(Real a, const Bounded<Real>& x) {
  return {a * x.value, magnitude(a) * x.size};
}

template <class Real>
void add(Bounded<Real>& sum, Real weight, const Bounded<Real>& x) {
  sum.value += weight * x.value;
  sum.size += weight * x.size;
}

template <class Real>
Real subtract(double a, double b) {
  return Real(a) - Real(b);
}

// The following operations are those of polynomials in the step.
template <class Line>
Line subtract(const StepPolynomial<1>& a, const StepPolynomial<1>& b) {
  return {{a.power[0] - b.power[0], a.power[1] - b.power[1]}};
}

StepPolynomial<2> minor(const StepPolynomial<1>& a0, const StepPolynomial<1>& a1,
                        const StepPolynomial<1>& b0, const StepPolynomial<1>& b1) {
  const auto [p, q] = a0.power;
  const auto [r, s] = a1.power;
  const auto [t, u] = b0.power;
  const auto [v, w] = b1.power;
  return {{p * v - r * t, p * w + q * v - r * u - s * t, q * w - s * u}};
}

StepPolynomial<3> product(const StepPolynomial<1>& a, const StepPolynomial<2>& x) {
  const auto [p, q] = a.power;
  const auto [u, v, w] = x.power;
  return {{p * u, p * v + q * u, p * w + q * v, q * w}};
}

template <int K>
void add(StepPolynomial<K>& sum, double weight, const StepPolynomial<K>& x) {
  for (int k = 0; k <= K; ++k) sum.power[k] += weight * x.power[k];
}

// Adds weight * f(r)(s) over the entries, with weights in the precision of Real.
template <class Real, class Out, class Function>
void sum_products(const ProductTable& table, Out* out, const Function& f) {
  const ProductTable::Entry* e = table.entries().data();
  const ProductTable::Fraction* fraction = table.fractions().data();
  for (int r = 0; r < table.rows(); ++r) {
    const auto of_row = f(r);
    for (int s = 0; s < table.columns(); ++s, ++e, ++fraction)
      if constexpr (std::is_same_v<Real, double>)
        add(out[e->target], e->weight, of_row(s));
      else
        add(out[e->target], Real(fraction->numerator) / Real(fraction->denominator), of_row(s));
  }
}

template <class Real, class First, class Second>
void sum_minors(const ProductTable& table, const First* a0, const First* a1, const First* b0,
                const First* b1, Second* out) {
  sum_products<Real>(table, out, [=](int r) {
    return [=, x0 = a0[r], x1 = a1[r]](int s) { return minor(x0, x1, b0[s], b1[s]); };
  });
}

// Roundings of a term in the plane, plus one for each term of a coefficient's sum: 2 differences, 2
// products, a subtraction, 2 for the weight, and the subtraction of the bound.
constexpr double kPlaneRoundings = 8;

constexpr double rounding_error(double roundings, double unit) { return 1.01 * roundings * unit; }

// Bounds the underflow of products, and of the rounding of quadruple sums to double.
constexpr double underflow_error(double operations) {
  return 1024 * operations * std::numeric_limits<double>::denorm_min();
}

Degrees operator+(Degrees a, const Degrees& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
  return a;
}

Degrees derivative_degrees(const BernsteinElement& element, int direction) {
  return element.lowered(element.factor_of(element.derivatives[direction][0]));
}

// Returns the degrees of the minors of the last two directions.
Degrees minor_degrees(const BernsteinElement& element) {
  return derivative_degrees(element, element.dim() - 2) +
         derivative_degrees(element, element.dim() - 1);
}

Degrees det_degrees(const BernsteinElement& element) {
  const Degrees minor = minor_degrees(element);
  return element.dim() == 2 ? minor : derivative_degrees(element, 0) + minor;
}

}  // namespace

ProductTable::ProductTable(const BernsteinBasis& a, const BernsteinBasis& b,
                           const BernsteinBasis& product, double scale)
    : rows_(a.count()), columns_(b.count()), target_count_(product.count()) {
  for (int r = 0; r < a.count(); ++r)
    for (int s = 0; s < b.count(); ++s) {
      Exponents e = a.exponents(r);
      for (std::size_t k = 0; k < e.size(); ++k) e[k] += b.exponents(s)[k];
      const int t = product.find(e);
      const double numerator = scale * a.weight(r) * b.weight(s), denominator = product.weight(t);
      if (!(std::max(numerator, denominator) < kExactIntegers))
        throw InvalidArgument("det J: degree too high for exact Bernstein weights");
      entries_.push_back({t, numerator / denominator});
      fractions_.push_back({numerator, denominator});
    }
}

DetCoefficients::DetCoefficients(const BernsteinElement& element)
    : dim_(element.dim()), degree_(element.degree), basis_(element.basis(det_degrees(element))) {
  for (int d = 0; d < dim_; ++d) {
    const std::vector<Difference> more = differences(element, d);
    differences_.insert(differences_.end(), more.begin(), more.end());
    starts_[d + 1] = static_cast<int>(differences_.size());
  }
  const auto basis_of = [&](int d) { return element.basis(derivative_degrees(element, d)); };
  const BernsteinBasis minor_basis = element.basis(minor_degrees(element));
  minors_ =
      ProductTable(basis_of(dim_ - 2), basis_of(dim_ - 1), minor_basis, double(degree_) * degree_);
  if (dim_ == 3) products_ = ProductTable(basis_of(0), minor_basis, basis_, degree_);
  // Rows are directions or, if these share a basis, components, as in [MC20].
  const bool shared = derivative_degrees(element, 0) == derivative_degrees(element, 1);
  const auto at = [&](int direction, int component) {
    return derivative_start(direction, component);
  };
  matrix_ = shared ? std::array{at(0, 0), at(1, 0), at(0, 1), at(1, 1)}
                   : std::array{at(0, 0), at(0, 1), at(1, 0), at(1, 1)};
}

std::vector<DetCoefficients::Difference> DetCoefficients::differences(
    const BernsteinElement& element, int direction) {
  const BernsteinBasis nodes = element.basis(element.degrees()),
                       low = element.basis(derivative_degrees(element, direction));
  const auto [plus, minus] = element.derivatives[direction];
  const auto raised = [&](int k, int coordinate) {
    Exponents e = low.exponents(k);
    ++e[coordinate];
    return nodes.find(e);
  };
  std::vector<Difference> out;
  for (int k = 0; k < low.count(); ++k) out.push_back({raised(k, plus), raised(k, minus)});
  return out;
}

// out: by direction, then component, derivative_count() each.
template <class Number, class First>
void DetCoefficients::differentiate(const Number* c, First* out) const {
  const Difference* w = differences_.data();
  for (int direction = 0; direction < dim_; ++direction) {
    const int count = derivative_count(direction);
    for (int component = 0; component < dim_; ++component)
      for (int r = 0; r < count; ++r)
        *out++ = subtract<First>(c[dim_ * w[r].plus + component], c[dim_ * w[r].minus + component]);
    w += count;
  }
}

template <class Real, class First, class Second>
void DetCoefficients::expand_in_plane(const First* derivatives, Second* out) const {
  std::fill(out, out + count(), Second{});
  const auto entry = [&](int k) { return derivatives + matrix_[k]; };
  sum_minors<Real>(minors_, entry(0), entry(1), entry(2), entry(3), out);
}

// Computes det J = D0 . (D1 x D2).
template <class Real, class First, class Second, class Third>
void DetCoefficients::expand_in_space(const First* derivatives, Second* cofactor,
                                      Third* out) const {
  std::fill(out, out + count(), Third{});
  const auto at = [&](int direction, int component) {
    return derivatives + derivative_start(direction, component % 3);
  };
  for (int c = 0; c < 3; ++c) {
    std::fill(cofactor, cofactor + minors_.target_count(), Second{});
    sum_minors<Real>(minors_, at(1, c + 1), at(1, c + 2), at(2, c + 1), at(2, c + 2), cofactor);
    const First* first = at(0, c);
    sum_products<Real>(products_, out, [=](int r) {
      return [=, x = first[r]](int s) { return product(x, cofactor[s]); };
    });
  }
}

// The bound is a standard forward analysis of one term: differences and products carry one rounding
// each, a weight two (rationals rounded once), the sum one per term; gamma_k <= 1.01 k u covers
// them. A sum has at most one term for each coefficient of one of its two operands. In space there
// are 3 differences, 3 products, 2 weights, sums of at most `most` terms and of three times as
// many. The remaining roundings of the count cover the subtraction of the bound.
template <class Real>
void DetCoefficients::with_error(const double* c, double unit, double* out, double* error) const {
  SmallBuffer<Real, 256> derivatives(derivative_size());
  differentiate(c, derivatives.data());
  SmallBuffer<Bounded<Real>, 256> sums(to_size(count()));
  int most = 0;
  for (int direction = 0; direction < dim_; ++direction)
    most = std::max(most, derivative_count(direction));
  double roundings = kPlaneRoundings + most, underflows = 1;
  if (dim_ == 2) {
    expand_in_plane<Real>(derivatives.data(), sums.data());
  } else {
    SmallBuffer<Bounded<Real>, 128> cofactor(to_size(minors_.target_count()));
    expand_in_space<Real>(derivatives.data(), cofactor.data(), sums.data());
    roundings = 16.0 + 4 * most;
    // The underflow in a cofactor is multiplied by the first derivative.
    double largest = 0;
    for (int k = 0; k < derivative_start(1, 0); ++k)
      largest = std::max(largest, static_cast<double>(magnitude(derivatives.data()[k])));
    underflows += 4 * degree_ * largest;
  }
  const double underflow = underflow_error(roundings * underflows);
  for (int t = 0; t < count(); ++t) {
    const Bounded<Real>& sum = sums.data()[t];
    out[t] = static_cast<double>(sum.value);
    error[t] = rounding_error(roundings, unit) * static_cast<double>(sum.size) +
               (unit < kUnitRoundoff<double> ? 2 * kUnitRoundoff<double> * std::abs(out[t]) : 0) +
               underflow;
  }
}

void DetCoefficients::at_with_error(const double* c, double* out, double* error) const {
  with_error<double>(c, kUnitRoundoff<double>, out, error);
}

void DetCoefficients::at_with_error_quad(const double* c, double* out, double* error) const {
  with_error<Float128>(c, kUnitRoundoff<Float128>, out, error);
}

// Returns the sum that expand_in_plane() computes for one row and column, without the weight.
template <class First, class Number>
auto DetCoefficients::only_minor(const Number* c) const {
  const auto derivative = [&](std::size_t direction, int component) {
    const Difference& w = differences_[direction];
    return subtract<First>(c[2 * w.plus + component], c[2 * w.minus + component]);
  };
  return minor(derivative(0, 0), derivative(1, 0), derivative(0, 1), derivative(1, 1));
}

void DetCoefficients::minor_with_error(const double* c, double* out, double* error) const {
  constexpr double roundings = kPlaneRoundings + 1;
  const Bounded<double> det = only_minor<double>(c);
  const double weight = minors_.entries().front().weight;
  *out = weight * det.value;
  *error = rounding_error(roundings, kUnitRoundoff<double>) * (weight * det.size) +
           underflow_error(roundings);
}

StepPolynomial<2> DetCoefficients::minor_along_line(const StepPolynomial<1>* c) const {
  const StepPolynomial<2> det = only_minor<StepPolynomial<1>>(c);
  StepPolynomial<2> sum{};
  add(sum, minors_.entries().front().weight, det);
  return sum;
}

void DetCoefficients::along_line(const StepPolynomial<1>* c, StepPolynomial<2>* out) const {
  SmallBuffer<StepPolynomial<1>, 256> derivatives(derivative_size());
  differentiate(c, derivatives.data());
  expand_in_plane<double>(derivatives.data(), out);
}

void DetCoefficients::along_line(const StepPolynomial<1>* c, StepPolynomial<3>* out) const {
  SmallBuffer<StepPolynomial<1>, 256> derivatives(derivative_size());
  differentiate(c, derivatives.data());
  SmallBuffer<StepPolynomial<2>, 128> cofactor(to_size(minors_.target_count()));
  expand_in_space<double>(derivatives.data(), cofactor.data(), out);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
