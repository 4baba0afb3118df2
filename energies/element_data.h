// What a density is told of every element beside J: a stiffness, a direction, any value.
//
//   Vec stiffness = Vec::Ones(mesh->face_count());                 // the formula gets a double
//   auto soft = density<2, 2>("soft", [](const auto& J, double k) { return k * J.squaredNorm(); },
//                             stiffness);
//   RowMatrix fibre(mesh->face_count(), 2);                        // a std::span<const double>
//   struct Material { double stiffness, limit; };
//   std::vector<Material> material(to_size(mesh->face_count()));        // a const Material&
//
// Rows are those of the elements: for parametrize(), the faces of the mesh. They follow the faces
// through every degree and rule, and into the charts of unwrap(). Not for what changes while
// solving: that is TermState.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "majorant/energies/spectral.h"
#include "majorant/framework/types.h"

namespace majorant {

// Values of any type, one an element; copies share them.
template <class T>
class ElementValues {
 public:
  explicit ElementValues(std::vector<T> values)
      : values_(std::make_shared<const std::vector<T>>(std::move(values))) {}
  Index size() const { return static_cast<Index>(values_->size()); }
  decltype(auto) operator[](Index e) const { return (*values_)[e]; }
  // Those of some elements, in their order.
  ElementValues of(std::span<const Index> elements) const {
    std::vector<T> part;
    for (const Index e : elements) part.push_back((*this)[e]);
    return ElementValues(std::move(part));
  }

 private:
  std::shared_ptr<const std::vector<T>> values_;
};

// As many numbers an element as a matrix has columns.
class ElementRows {
 public:
  explicit ElementRows(RowMatrix rows)
      : rows_(std::make_shared<const RowMatrix>(std::move(rows))) {}
  Index size() const { return static_cast<Index>(rows_->rows()); }
  std::span<const double> operator[](Index e) const {
    return {rows_->data() + e * rows_->cols(), static_cast<std::size_t>(rows_->cols())};
  }
  ElementRows of(std::span<const Index> elements) const;

 private:
  std::shared_ptr<const RowMatrix> rows_;
};

extern template class ElementValues<double>;

namespace detail {
// Throws InvalidArgument for numbers that are not finite; name: of the density.
ElementValues<double> element_data(const std::string& name, const Vec& numbers);
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

// Of the kinds above: a vector or matrix of Eigen, or a std::vector.
template <class Data>
concept DataOfElements = requires(const std::string& name, const Data& data) {
  detail::element_data(name, data);
};

// A density whose formula is also told of the element: f(..., data[e]).
template <class Density, class Data>
class WithData : public Density {
 public:
  WithData(Density density, Data data) : Density(std::move(density)), data_(std::move(data)) {}
  Index element_count() const { return data_.size(); }
  decltype(auto) data_of(Index element) const { return data_[element]; }
  WithData of(std::span<const Index> elements) const { return {*this, data_.of(elements)}; }

 private:
  Data data_;
};

// Isotropic densities of formulas k(x, y, data) and h(Sigma, sigma, data): spectral.h. Throw
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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
