// Manifolds on which unknowns may lie: unit spheres, rotations, and manifolds of your own.
//
//   const auto directions = unit_sphere(3);
//   const auto orientations = rotation_matrices();
//
//   // A cylinder of radius 1 about the third axis; v is a tangent vector, of numbers or of duals.
//   const auto cylinder = make_manifold<3, 2>("cylinder",
//       [](const Eigen::Vector3d& p) {
//         Eigen::Matrix<double, 3, 2> basis;
//         basis << -p[1], 0, p[0], 0, 0, 1;
//         return basis;
//       },
//       [](const Eigen::Vector3d& p, const auto& v) {
//         using std::sqrt;
//         const auto x = (v[0] + p[0]), y = (v[1] + p[1]);
//         const auto r = sqrt(x * x + y * y);
//         std::remove_cvref_t<decltype(v)> q;
//         q << x / r, y / r, v[2] + p[2];
//         return q;
//       });
//
// A retraction R(p, t) moves a point p along coordinates t of its tangent space. R(p, 0) = p, and
// the derivative by t there is a basis of that space ([AMS08] Sec. 4.1). ManifoldProblem
// (manifold_problem.h) minimizes on products of manifolds.
//
// Not for linear subspaces, which constraints eliminate (constraint.h).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "majorant/framework/terms/detail/element_term.h"

namespace majorant {

class Manifold {
 public:
  virtual ~Manifold() = default;
  virtual std::string_view name() const = 0;
  virtual int size() const = 0;       // numbers of a point
  virtual int dimension() const = 0;  // of its tangent space
  // Writes x = R(base, t), size() numbers. slopes, unless null: dx/dt, a row of dimension() for
  // each number of x. bends, unless null: the second derivatives of each number, packed lower
  // triangles.
  virtual void retract(const double* base, const double* t, double* x, double* slopes,
                       double* bends) const = 0;
  // Moves x to the nearest point of the manifold. Returns false if there is none, or more than one.
  virtual bool project(double* x) const = 0;
};

// The sphere |x| = 1 in `size` dimensions, 2 or more: directions. Size 2 are unit complex numbers,
// size 4 rotations as unit quaternions. R(p, t) = (p + B t) / |p + B t|, with an orthonormal basis
// B orthogonal to p. Throws InvalidArgument for another size.
std::shared_ptr<const Manifold> unit_sphere(int size);

// The rotations of space as 3 by 3 matrices of 9 numbers, by rows or by columns. R(P, t) = P C(t),
// where C is the rotation of the quaternion (1, t / 2) / |.|, about t by nearly |t|.
std::shared_ptr<const Manifold> rotation_matrices();

namespace detail {

template <int N, int D, class Basis, class Retraction>
class OwnManifold final : public Manifold {
 public:
  OwnManifold(std::string name, Basis basis, Retraction retraction)
      : name_(std::move(name)), basis_(std::move(basis)), retraction_(std::move(retraction)) {}
  std::string_view name() const override { return name_; }
  int size() const override { return N; }
  int dimension() const override { return D; }

  void retract(const double* base, const double* t, double* x, double* slopes,
               double* bends) const override {
    const Eigen::Vector<double, N> p = Eigen::Map<const Eigen::Vector<double, N>>(base);
    const Eigen::Matrix<double, N, D> basis = basis_(p);
    if (!slopes && !bends) {
      const Eigen::Vector<double, N> v = basis * Eigen::Map<const Eigen::Vector<double, D>>(t);
      Eigen::Map<Eigen::Vector<double, N>>(x, N) = retraction_(p, v);
      return;
    }
    using Variable = Dual2<double, D>;
    Eigen::Vector<Variable, N> v;
    for (int k = 0; k < N; ++k) {
      v[k] = Variable(0.0);
      for (int a = 0; a < D; ++a) v[k] = v[k] + basis(k, a) * Variable::variable(t[a], a);
    }
    const Eigen::Vector<Variable, N> moved = retraction_(p, v);
    for (int k = 0; k < N; ++k) {
      x[k] = moved[k].v;
      for (int a = 0; slopes && a < D; ++a) slopes[k * D + a] = moved[k].d[to_size(a)];
      for (std::size_t h = 0; bends && h < moved[k].h.size(); ++h)
        bends[to_size(k) * moved[k].h.size() + h] = moved[k].h[h];
    }
  }
  bool project(double* x) const override {
    const Eigen::Vector<double, D> zero = Eigen::Vector<double, D>::Zero();
    const Eigen::Vector<double, N> at = Eigen::Map<const Eigen::Vector<double, N>>(x);
    retract(at.data(), zero.data(), x, nullptr, nullptr);
    return Eigen::Map<const Eigen::Vector<double, N>>(x).allFinite();
  }

 private:
  std::string name_;
  Basis basis_;
  Retraction retraction_;
};

}  // namespace detail

// Makes a manifold of your own, with points of N numbers and dimension D. basis(p): a basis of the
// tangent space at p, N by D. retraction(p, v): the point to which a tangent vector v leads,
// generic in the numbers of v. For v = 0 it is p, moved back to the manifold if rounding has moved
// it away.
template <int N, int D, class Basis, class Retraction>
std::shared_ptr<const Manifold> make_manifold(std::string name, Basis basis,
                                              Retraction retraction) {
  static_assert(0 < D && D <= N && D <= detail::kMostUnknowns, "a manifold of dimension 1 to N");
  return std::make_shared<const detail::OwnManifold<N, D, Basis, Retraction>>(
      std::move(name), std::move(basis), std::move(retraction));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
