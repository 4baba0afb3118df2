// Makes an energy term from a density of the Jacobian: the usual way to add an energy.
//
//   auto energy = make_energy(space, rest, spectral("my-energy",
//       [](auto S, auto s) { return S / s + s / S; }));
//   builder.add(energy, 1.0 / rest.measure.sum());       // a mean over the surface
//
// The term is integrated by the rule that fits the space and its degree; other rules may be given
// (quadrature.h).
//
// Drivers that build spaces and rules themselves take an EnergyFactory instead:
//
//   auto mine = spectral("my-energy", [](auto S, auto s) { return S / s + s / S; });
//   options.map.energy = {{energy_factory(mine), 1.0}};
//
// Kernels of the library call the formula point by point; energies/vectorized.h has faster ones. A
// density has TermState::parameters, which may change between steps, if it has three members: `Vec
// parameters() const`, which returns the initial ones, `Index parameter_count() const` and `Density
// with_parameters(const Vec&) const`. The result of the latter is used while its argument lives.
//
// For functions of few unknowns without an integral, such as springs or penalties, use make_term()
// (framework/terms/local_term.h).
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "majorant/energies/detail/contraction.h"
#include "majorant/energies/detail/pointwise.h"
#include "majorant/energies/detail/small_matrix.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/spectral.h"
#include "majorant/energies/traits.h"
#include "majorant/framework/curvature.h"
#include "majorant/framework/dual2.h"
#include "majorant/framework/types.h"

namespace majorant {

// Data of elements: a formula may take a value of its element beside J, such as a stiffness or a
// direction.
//
//   Vec stiffness = Vec::Ones(mesh->face_count());                 // the formula gets a double
//   auto soft = density<2, 2>("soft", [](const auto& J, double k) { return k * J.squaredNorm(); },
//                             stiffness);
//   RowMatrix fibre(mesh->face_count(), 2);                        // a std::span<const double>
//   struct Material { double stiffness, limit; };
//   std::vector<Material> material(to_size(mesh->face_count()));        // a const Material&
//
// Rows are those of the elements; for parametrize(), the faces of the mesh. They follow the faces
// through every degree and rule, and into the charts of unwrap(). Numbers (a double or a span) may
// change between steps: they are TermState::parameters, row by row.
//
//   const TermId term = problem.terms().front();
//   const Problem stiffer = problem.with({{term, {.parameters = Vec::Constant(9, 2.0)}}});

// Values of any type, one an element; copies share them.
template <class T>
class ElementValues {
 public:
  explicit ElementValues(std::vector<T> values)
      : values_(std::make_shared<const std::vector<T>>(std::move(values))) {}
  Index size() const { return static_cast<Index>(values_->size()); }
  decltype(auto) operator[](Index e) const { return (*values_)[e]; }
  // Returns the values of some elements, in their order.
  ElementValues of(std::span<const Index> elements) const {
    std::vector<T> part;
    for (const Index e : elements) part.push_back((*this)[e]);
    return ElementValues(std::move(part));
  }

 private:
  std::shared_ptr<const std::vector<T>> values_;
};

// The rows of a matrix, one an element.
class ElementRows {
 public:
  explicit ElementRows(RowMatrix rows);
  // Refers to numbers that outlive this object: those of element e begin at e * columns.
  ElementRows(const Vec& numbers, Index columns);
  Index size() const { return size_; }
  Index columns() const { return columns_; }
  Vec all() const { return Eigen::Map<const Vec>(first_.get(), size_ * columns_); }
  std::span<const double> operator[](Index e) const {
    return {first_.get() + e * columns_, static_cast<std::size_t>(columns_)};
  }
  ElementRows of(std::span<const Index> elements) const;

 private:
  std::shared_ptr<const double> first_;
  Index size_, columns_;
};

// One number an element.
class ElementScalars {
 public:
  explicit ElementScalars(ElementRows rows) : rows_(std::move(rows)) {}
  ElementScalars(const Vec& numbers, Index columns) : rows_(numbers, columns) {}
  Index size() const { return rows_.size(); }
  Index columns() const { return 1; }
  Vec all() const { return rows_.all(); }
  double operator[](Index e) const { return rows_[e].front(); }
  ElementScalars of(std::span<const Index> elements) const {
    return ElementScalars(rows_.of(elements));
  }

 private:
  ElementRows rows_;
};

namespace detail {
// Return data of elements in one of these forms. Throw InvalidArgument for numbers that are not
// finite. name: of the density.
ElementScalars element_data(const std::string& name, const Vec& numbers);
ElementRows element_data(const std::string& name, const RowMatrix& rows);
template <class T>
ElementValues<T> element_data(const std::string&, std::vector<T> values) {
  return ElementValues<T>(std::move(values));
}
template <class Matrix>
auto element_data(const std::string& name, const Eigen::MatrixBase<Matrix>& data) {
  if constexpr (Matrix::ColsAtCompileTime == 1)
    return element_data(name, Vec(data));
  else
    return element_data(name, RowMatrix(data));
}
}  // namespace detail

// Data of any of these kinds: a vector or matrix of Eigen, or a std::vector.
template <class Data>
concept DataOfElements = requires(const std::string& name, const Data& data) {
  detail::element_data(name, data);
};

// Data that are numbers, which may change between steps as TermState::parameters.
template <class Data>
concept NumbersOfElements = requires(const Data& data) {
  data.columns();
};

// A density whose formula also takes data of the element: f(..., data[e]).
template <class Density, class Data>
class WithData : public Density {
 public:
  WithData(Density density, Data data) : Density(std::move(density)), data_(std::move(data)) {}
  Index element_count() const { return data_.size(); }
  decltype(auto) data_of(Index element) const { return data_[element]; }
  WithData of(std::span<const Index> elements) const { return {*this, data_.of(elements)}; }
  Index parameter_count() const requires NumbersOfElements<Data> {
    return data_.size() * data_.columns();
  }
  Vec parameters() const requires NumbersOfElements<Data> { return data_.all(); }
  WithData with_parameters(const Vec& parameters) const requires NumbersOfElements<Data> {
    return {*this, Data(parameters, data_.columns())};
  }

 private:
  Data data_;
};

// Return isotropic densities of formulas k(x, y, data) and h(Sigma, sigma, data): spectral.h. Throw
// InvalidArgument for numbers that are not finite.
template <class K, DataOfElements Data>
auto invariant(std::string name, K k, const Data& data, const Traits& traits = {}) {
  auto rows = detail::element_data(name, data);
  return WithData(invariant(std::move(name), std::move(k), traits), std::move(rows));
}
template <class H, DataOfElements Data>
auto spectral(std::string name, H h, const Data& data, const Traits& traits = {}) {
  auto rows = detail::element_data(name, data);
  return WithData(spectral(std::move(name), std::move(h), traits), std::move(rows));
}

// Densities of the Jacobian from one line of code, also anisotropic ones, of volumes, and of
// surfaces in space.
//
//   auto mips = density<2, 2>("mips", [](const auto& J) {
//     return J.squaredNorm() / J.determinant();
//   });
//   builder.add(make_energy(space, rest, mips), 1.0 / area);
//
// J is M by D, both 1 to 3: M unknowns per node, D the dimension of the element, in the frame of
// the rest shape (RestShapes; turned() rotates it). Derivatives come from Dual1 and Dual2
// (dual2.h), so the formula may use their operations, and branches. The projected Hessian comes
// from an eigendecomposition of the MD by MD block at every quadrature point. For isotropic planar
// energies spectral() and invariant() are faster and support more curvature models.

template <int M, int D, class F>
class GeneralDensity {
  static_assert(M >= 1 && M <= 3 && D >= 1 && D <= 3, "J has 1 to 3 rows and columns");

 public:
  static constexpr int rows = M, dims = D, size = M * D;
  const Traits traits;

  GeneralDensity(std::string name, F f, const Traits& t)
      : traits(t), f_(std::move(f)), name_(std::move(name)) {}
  std::string_view name() const { return name_; }
  bool supports(Curvature c) const { return c == Curvature::Projected || c == Curvature::Exact; }

  // Returns the value at J, row by row. data: the formula's data beside J.
  template <class... Data>
  double value(const double (&z)[size], const Data&... data) const {
    const auto J = matrix<double>([&z](int r) { return z[r]; });
    return inside_domain(f_(J, data...), z);
  }
  // Computes value, gradient and exact Hessian.
  template <class... Data>
  void model(const double (&z)[size], PointModel<double, size>& m, const Data&... data) const {
    differentiate<Dual2<double, size>>(z, m, data...);
  }
  // Computes value and gradient; m.k is not set.
  template <class... Data>
  void slope(const double (&z)[size], PointModel<double, size>& m, const Data&... data) const {
    differentiate<Dual1<double, size>>(z, m, data...);
  }

 private:
  template <class Scalar, class... Data>
  void differentiate(const double (&z)[size], PointModel<double, size>& m,
                     const Data&... data) const {
    const Scalar e = f_(matrix<Scalar>([&z](int r) { return Scalar::variable(z[r], r); }), data...);
    m.f = inside_domain(e.v, z);
    for (std::size_t r = 0; r < e.d.size(); ++r) m.g[r] = e.d[r];
    for (std::size_t p = 0; p != e.h.size(); ++p) m.k[p] = e.h[p];
  }
  template <class T, class Entry>
  static SmallMatrix<T, M, D> matrix(const Entry& entry) {
    SmallMatrix<T, M, D> J;
    for (int r = 0; r < size; ++r) J(r / D, r % D) = entry(r);
    return J;
  }
  double inside_domain(double f, const double (&z)[size]) const {
    bool inside = f == f;
    if constexpr (M == D)
      if (traits.domain == Domain::PositiveDeterminant)
        inside = inside && matrix<double>([&z](int r) { return z[r]; }).determinant() > 0;
    return inside ? f : std::numeric_limits<double>::infinity();
  }
  F f_;
  std::string name_;
};

// Returns the density f(J), with J a SmallMatrix<T, M, D>. Domain::PositiveDeterminant only affects
// M = D; convexity and reweighting are ignored.
template <int M, int D, class F>
GeneralDensity<M, D, F> density(std::string name, F f, const Traits& traits = {}) {
  return {std::move(name), std::move(f), traits};
}

// Returns the density f(J, data of the element): see ElementValues and WithData above. Throws
// InvalidArgument for numbers that are not finite; make_energy() and drivers throw it unless there
// are data for each element.
template <int M, int D, class F, DataOfElements Data>
auto density(std::string name, F f, const Data& data, const Traits& traits = {}) {
  auto rows = detail::element_data(name, data);
  return WithData(GeneralDensity<M, D, F>(std::move(name), std::move(f), traits), std::move(rows));
}

namespace detail {

// Returns the factory of a density. object: has the density as its member; kernels are called with
// called(object). again: returns the factory of another density of the type.
template <class Object, class Called, class Again>
EnergyFactory make_factory(std::shared_ptr<const Object> object, const DensityKernels& kernels,
                           Called called, Again again) {
  const auto& density = object->density;
  bool supported[std::size(kCurvatures)];
  for (std::size_t k = 0; k < std::size(kCurvatures); ++k)
    supported[k] = density.supports(kCurvatures[k]);
  DensityTraits traits = traits_of(density.name(), density.traits, supported);
  if constexpr (requires(Vec parameters) { density.with_parameters(parameters); }) {
    traits.parameter_count = density.parameter_count();
    traits.parameters = [object] { return object->density.parameters(); };
    traits.with_parameters = [object, called](const Vec& parameters) {
      return called(std::make_shared<const Object>(object->density.with_parameters(parameters)));
    };
  }
  if constexpr (ProjectsDilatation<std::decay_t<decltype(density)>>)
    traits.dilatation_degree = density.dilatation_degree();
  EnergyFactory::Part part;
  if constexpr (requires { density.element_count(); }) {
    traits.elements = density.element_count();
    part = [object, again](std::span<const Index> elements) {
      return again(object->density.of(elements));
    };
  }
  return EnergyFactory::of_density(std::move(traits), called(std::move(object)), kernels,
                                   std::move(part));
}

template <class Density>
struct CalledItself {
  explicit CalledItself(Density d) : density(std::move(d)) {}
  const Density density;
};

}  // namespace detail

// Returns the energy of a density. Throws InvalidArgument for a spectral() formula that is not
// symmetric.
template <class Density>
EnergyFactory energy_factory(const Density& density) {
  detail::require_symmetric<double>(density);
  using Object = detail::CalledByPoint<Density>;
  return detail::make_factory(
      std::make_shared<const Object>(density), detail::point_kernels<Density>(),
      [](const std::shared_ptr<const Object>& object) {
        return std::shared_ptr<const void>(object, &object->function);
      },
      [](const Density& other) { return energy_factory(other); });
}
// Returns the energy with kernels into which this density is compiled (energies/vectorized.h).
template <class Density>
EnergyFactory energy_factory(const Density& density, const DensityKernels& kernels) {
  using Object = detail::CalledItself<Density>;
  return detail::make_factory(
      std::make_shared<const Object>(density), kernels,
      [](const std::shared_ptr<const Object>& object) {
        return std::shared_ptr<const void>(object, &object->density);
      },
      [kernels](const Density& other) { return energy_factory(other, kernels); });
}

// Return a term on a space, with the rules of EnergyFactory::operator() if none are given. Throw
// InvalidArgument as DensityTerm does.
template <class Density>
std::shared_ptr<const DensityTerm> make_energy(std::shared_ptr<const ElementSpace> space,
                                               const RestShapes& rest, const Density& density) {
  return energy_factory(density)(std::move(space), rest);
}
template <class Density>
std::shared_ptr<const DensityTerm> make_energy(std::shared_ptr<const ElementSpace> space,
                                               const RestShapes& rest, const Density& density,
                                               const std::vector<Quadrature>& rules) {
  return energy_factory(density)(std::move(space), rest, rules);
}
template <class Density>
std::shared_ptr<const DensityTerm> make_energy(std::shared_ptr<const ElementSpace> space,
                                               const RestShapes& rest, const Density& density,
                                               const std::vector<Quadrature>& rules,
                                               const DensityKernels& kernels) {
  return energy_factory(density, kernels)(std::move(space), rest, rules);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
