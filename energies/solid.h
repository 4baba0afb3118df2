// Solids: densities of two parts, W(F) + U(det F). The second part makes a material nearly
// incompressible, and makes elements lock.
//
//   const auto shape = density<3, 3>("mine", [](const auto& F) {
//     return F.squaredNorm() - 2.0 * F.determinant();
//   });
//   const auto mine = solid(shape, [](const auto& J) { return 500.0 * (J - 1.0) * (J - 1.0); });
//   builder.add(make_energy(space, rest, mean_dilatation(mine)), 1.0);
//
// mean_dilatation() evaluates U at the projection of det F on polynomials of a low degree inside
// each element; degree 0 is its mean. This is the three-field principle of [STP85] after
// elimination of the pressure and the dilatation, which are discontinuous between elements. The
// energy depends on displacements alone, and its Hessian has the usual pattern. Its minimum does
// not lock if the element is stable with such a pressure (docs/elements.md, Elements that do not
// lock).
//
// The materials of majorant/energies/materials/ are solids: stable_neo_hookean<3>(), ogden<3>() and
// so on.
//
// Both parts should be free of stress at rest. With a projected dilatation, Curvature::Projected is
// that of W alone, clamped, plus U'' with the first derivatives of J. Then a nearly incompressible
// solid takes about as many Newton steps as a soft one.
//
// Energies without such a second part, such as Saint Venant and Kirchhoff's, use density().
#pragma once

#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/detail/determinant_derivatives.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/traits.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/dual2.h"

namespace majorant {

// Shape: W, a density of square Jacobians that is called point by point (density(), stretches()).
// Volume: U, a function of a number. Domain and barrier are those of W; where U is NaN the energy
// is +inf.
template <class Shape, class Volume>
class SolidDensity {
 public:
  static constexpr int rows = Shape::rows, dims = Shape::dims, size = Shape::size;
  static_assert(rows == dims && dims >= 2, "a solid has as many coordinates as dimensions");
  const Traits traits;

  SolidDensity(Shape shape, Volume volume)
      : traits(shape.traits), shape_(std::move(shape)), volume_(std::move(volume)) {}
  std::string_view name() const { return shape_.name(); }
  bool supports(Curvature c) const { return shape_.supports(c); }
  const Shape& shape() const { return shape_; }
  // Returns U and its derivatives.
  Dual2<double, 1> volume_at(double dilatation) const {
    return volume_(Dual2<double, 1>::variable(dilatation, 0));
  }

  double value(const double (&z)[size]) const {
    return number_or_infinity(shape_.value(z) + volume_(determinant_of<dims>(z)));
  }
  void slope(const double (&z)[size], PointModel<double, size>& m) const {
    shape_.slope(z, m);
    add_volume(z, m);
  }
  void model(const double (&z)[size], PointModel<double, size>& m) const {
    shape_.model(z, m);
    const Dual2<double, 1> u = add_volume(z, m);
    double cofactor[size];
    cofactors<dims>(z, cofactor);
    add_second_determinant<dims>(u.d[0], z, m.k);
    for (int r = 0, k = 0; r < size; ++r)
      for (int q = 0; q <= r; ++q, ++k) m.k[k] += u.h[0] * cofactor[r] * cofactor[q];
  }

 private:
  static double number_or_infinity(double f) {
    return f == f ? f : std::numeric_limits<double>::infinity();
  }
  // Adds value and gradient of U.
  Dual2<double, 1> add_volume(const double (&z)[size], PointModel<double, size>& m) const {
    const Dual2<double, 1> u = volume_at(determinant_of<dims>(z));
    double cofactor[size];
    cofactors<dims>(z, cofactor);
    m.f = number_or_infinity(m.f + u.v);
    for (int r = 0; r < size; ++r) m.g[r] += u.d[0] * cofactor[r];
    return u;
  }

  Shape shape_;
  Volume volume_;
};

template <class Shape, class Volume>
SolidDensity<Shape, Volume> solid(Shape shape, Volume volume) {
  return {std::move(shape), std::move(volume)};
}

// A solid whose dilatation is projected inside each element.
template <class Shape, class Volume>
class MeanDilatation : public SolidDensity<Shape, Volume> {
 public:
  MeanDilatation(SolidDensity<Shape, Volume> solid, int degree)
      : SolidDensity<Shape, Volume>(std::move(solid)), degree_(degree) {}
  int dilatation_degree() const { return degree_; }

 private:
  int degree_;
};

// Returns the solid with a projected dilatation. degree: of the polynomials, in the coordinates of
// the reference cell, 0 to 2. Terms throw InvalidArgument for another degree and for rules with too
// few points; without rules a term has one that integrates det F exactly.
template <class Shape, class Volume>
MeanDilatation<Shape, Volume> mean_dilatation(SolidDensity<Shape, Volume> solid, int degree = 0) {
  return {std::move(solid), degree};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
