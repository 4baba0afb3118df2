// Bernstein coefficients of det J of a planar Bezier triangle, and proofs that they are positive.
//
// det J has degree 2(n-1); its coefficients are bilinear in the differences of control points
// ([MC20] Sec. 5.2 with the factor of method.md E6). All positive => det J > 0 on the triangle.
#pragma once

#include <vector>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/positivity.h"

namespace majorant {

class DetCoefficients {
 public:
  static constexpr int kMaxDegree = 8;
  static const DetCoefficients& of_degree(int n);  // of the map, 1..8; throws std::out_of_range

  int det_degree() const { return 2 * (degree_ - 1); }
  int count() const { return control_point_count(det_degree()); }

  // c: 2 numbers per control point; out: count() coefficients.
  void at(const double* c, double* out) const;
  // Coefficients of det J(c + s d) = out0 + s out1 + s^2 out2.
  void along_line(const double* c, const double* d, double* out0, double* out1, double* out2) const;
  // Coefficients and a rigorous bound of the absolute error of each, for finite c without overflow.
  void at_with_error(const double* c, double* out, double* error) const;
  // The same in quadruple precision, rounded to double; error bounds accordingly smaller.
  void at_with_error_quad(const double* c, double* out, double* error) const;

  // One product (D0u_r D1v_s - D1u_r D0v_s) of coefficient `target`.
  struct Product {
    int r, s, target;
    double weight;                  // numerator / denominator, rounded
    double numerator, denominator;  // integers
  };
  // Differences by direction: D0 = c[plus0] - c[plus2], D1 = c[plus1] - c[plus2].
  struct Difference {
    int plus0, plus1, plus2;
  };
  const std::vector<Product>& products() const { return products_; }
  const std::vector<Difference>& differences() const { return differences_; }

 private:
  explicit DetCoefficients(int n);
  template <class Real>
  void with_error(const double* c, double unit, double* out, double* error) const;
  int degree_;
  std::vector<Product> products_;
  std::vector<Difference> differences_;
};

// Whether a polynomial of degree n with these Bernstein coefficients, each exact to +- error, is
// positive on the triangle; bisects down to max_depth ([MC20] Sec. 5.2, App. E). Certified is a
// proof; Violated: not provably positive at a corner; Undecided: max_depth was reached.
PositivityProof certify_positive(int n, const double* coefficients, double error, int max_depth);

// Largest s' <= s with p0 + t p1 + t^2 p2 > 0 certified for all 0 <= t < s', all polynomials given
// by Bernstein coefficients of degree n; bisects up to max_depth where that lengthens the step.
double largest_positive_step(int n, const double* p0, const double* p1, const double* p2, double s,
                             int max_depth);

}  // namespace majorant
