// Bernstein coefficients of det J of one element, with bounds of their rounding errors.
//
// Derivatives of the map are differences of control points, times the degree n. In the plane det J
// is bilinear in them ([MC20] Sec. 5.2 with the factor of method.md E6). In space it is computed
// from the cofactors D1 x D2 of the first derivative. The cost is then a sum of two products rather
// than a triple product.
//
// A derivative in the direction of one factor of the cell has degree n - 1 in that factor and n in
// the others, so a factor of dimension k contributes degree D n - k. That gives 2(n-1) on
// triangles, 3(n-1) on tetrahedra, (2n-1, 2n-1) on squares, (3n-2, 3n-1) on wedges. Directions of
// different factors have different numbers of coefficients.
#pragma once

#include <cstdint>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/internal/step_polynomial.h"

namespace majorant {

// The product of two Bernstein polynomials: entry (r, s) adds scale * weight * a_r * b_s to
// coefficient `target`. Entries are stored by r, then s.
class ProductTable {
 public:
  struct Entry {
    int target;
    double weight;  // numerator / denominator, rounded
  };
  struct Fraction {
    double numerator, denominator;  // integers
  };
  ProductTable() = default;
  // Throws InvalidArgument if a numerator or denominator is no exact double.
  ProductTable(const BernsteinBasis& a, const BernsteinBasis& b, const BernsteinBasis& product,
               double scale);
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  int target_count() const { return target_count_; }
  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<Fraction>& fractions() const { return fractions_; }  // one per entry

 private:
  int rows_ = 0, columns_ = 0, target_count_ = 0;
  std::vector<Entry> entries_;
  std::vector<Fraction> fractions_;
};

class DetCoefficients {
 public:
  // element: accepted by check_description() (element_check.h). Throws InvalidArgument for what
  // BernsteinElement::basis() and ProductTable refuse.
  explicit DetCoefficients(const BernsteinElement& element);

  const BernsteinBasis& basis() const { return basis_; }
  int count() const { return basis_.count(); }

  // Computes coefficients for control points c (D numbers per node) and a rigorous bound of the
  // absolute error of each, for finite c without overflow. out, error: count() numbers.
  void at_with_error(const double* c, double* out, double* error) const;
  // Does the same in quadruple precision, rounded to double, with accordingly smaller error bounds.
  void at_with_error_quad(const double* c, double* out, double* error) const;
  // Computes the coefficients of integer control points exactly, multiplied by one positive
  // integer: the product of (degree of the factor)! over the factors of the cell.
  template <class Integer>
  std::vector<Integer> scaled(const std::vector<Integer>& c) const;
  // An affine map of the plane has one coefficient, a 2 by 2 determinant. These members return the
  // numbers of at_with_error() and along_line() without tables.
  bool is_one_minor() const { return dim_ == 2 && minors_.entries().size() == 1; }
  void minor_with_error(const double* c, double* out, double* error) const;
  StepPolynomial<2> minor_along_line(const StepPolynomial<1>* c) const;
  // Computes coefficients as polynomials of degree D in t for control points that are linear in t.
  void along_line(const StepPolynomial<1>* c, StepPolynomial<2>* out) const;
  void along_line(const StepPolynomial<1>* c, StepPolynomial<3>* out) const;

 private:
  // The control value c[plus] - c[minus] of a derivative, without the factor n.
  struct Difference {
    int plus, minus;
  };
  static std::vector<Difference> differences(const BernsteinElement& element, int direction);
  template <class First, class Number>
  auto only_minor(const Number* c) const;
  template <class Number, class First>
  void differentiate(const Number* c, First* out) const;
  template <class Real, class First, class Second>
  void expand_in_plane(const First* derivatives, Second* out) const;
  template <class Real, class First, class Second, class Third>
  void expand_in_space(const First* derivatives, Second* cofactors, Third* out) const;
  template <class Real>
  void with_error(const double* c, double unit, double* out, double* error) const;
  int derivative_count(int direction) const {  // coefficients of one component
    const auto d = to_size(direction);
    return starts_[d + 1] - starts_[d];
  }
  // Returns the place of the derivative of a component in the output of differentiate().
  int derivative_start(int direction, int component) const {
    return dim_ * starts_[direction] + component * derivative_count(direction);
  }
  std::size_t derivative_size() const { return to_size(dim_) * differences_.size(); }

  int dim_, degree_;
  BernsteinBasis basis_;
  std::vector<Difference> differences_;  // of the directions, one after the other
  std::array<int, 4> starts_{};          // of each direction in differences_, and the end
  std::array<int, 4> matrix_{};          // in the plane: starts of the four derivatives, by rows
  ProductTable minors_;                  // of the last two directions; in the plane det J itself
  ProductTable products_;                // in space: of the first direction and a cofactor
};

// Coefficient t has the denominator weight(t) = (sum of exponents)! / (product of their factorials)
// in every factor of the cell, so the product of the factorials makes it an integer. A cofactor
// times its own weight is an integer too; the weight of its partner in a product is a factor of the
// numerator there.
template <class Integer>
std::vector<Integer> DetCoefficients::scaled(const std::vector<Integer>& c) const {
  std::vector<Integer> derivatives(derivative_size());
  Integer* at = derivatives.data();
  for (int direction = 0; direction < dim_; ++direction)
    for (int component = 0; component < dim_; ++component)
      for (int r = starts_[to_size(direction)]; r < starts_[to_size(direction) + 1]; ++r)
        *at++ = c[dim_ * differences_[r].plus + component] -
                c[dim_ * differences_[r].minus + component];
  const auto derivative = [&](int direction, int component, int r) -> const Integer& {
    return derivatives[derivative_start(direction, component % dim_) + r];
  };
  const auto whole = [](double x) { return static_cast<std::int64_t>(x); };
  const int u = dim_ - 2, v = dim_ - 1, columns = minors_.columns();
  const auto scaled_minors = [&](int first, int second) {
    std::vector<Integer> out(to_size(minors_.target_count()));
    for (int e = 0; e < minors_.rows() * columns; ++e) {
      const int r = e / columns, s = e % columns;
      out[minors_.entries()[e].target] += whole(minors_.fractions()[e].numerator) *
                                          (derivative(u, first, r) * derivative(v, second, s) -
                                           derivative(u, second, r) * derivative(v, first, s));
    }
    return out;
  };
  std::vector<Integer> out(to_size(count()));
  if (dim_ == 2) {
    out = scaled_minors(0, 1);
  } else {
    std::vector<double> weights(to_size(minors_.target_count()));
    for (std::size_t e = 0; e < minors_.entries().size(); ++e)
      weights[minors_.entries()[e].target] = minors_.fractions()[e].denominator;
    for (int component = 0; component < 3; ++component) {
      const std::vector<Integer> cofactor = scaled_minors(component + 1, component + 2);
      for (int e = 0; e < products_.rows() * products_.columns(); ++e) {
        const int r = e / products_.columns(), s = e % products_.columns();
        out[products_.entries()[e].target] +=
            whole(products_.fractions()[e].numerator / weights[s]) * derivative(0, component, r) *
            cofactor[s];
      }
    }
  }
  for (int t = 0; t < count(); ++t)
    for (const int exponent : basis_.exponents(t))
      for (int k = 2; k <= exponent; ++k) out[t] *= k;
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
