#include "density.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "arrays.h"
#include "kept.h"
#include "majorant/energies/detail/point_functions.h"

namespace majorant::python {
namespace {

// The points at which the kernels evaluate the density, in an order that all kernels share.
struct Points {
  int size;               // entries of J
  std::vector<double> J;  // #q by size
  std::vector<double> value = {};
  const double *g = nullptr, *H = nullptr;   // size by #q; lower triangles, packed, by #q
  std::unique_ptr<const Kept> answers = {};  // the Python objects that own g and H
  mutable std::size_t next = 0;              // the next point of the second pass
  std::size_t count() const { return J.size() / static_cast<std::size_t>(size); }
};

constexpr int kLanes = PointBatch::kMost;

void record(const void* points, const PointBatch& batch, const double* J, double* f) {
  auto& to = const_cast<Points&>(*static_cast<const Points*>(points));
  const std::size_t first = to.J.size();
  to.J.resize(first + static_cast<std::size_t>(batch.count * to.size));
  double* next = to.J.data() + first;
  for (int p = 0; p < batch.count; ++p) {
    for (int r = 0; r < to.size; ++r) *next++ = J[r * kLanes + p];
    f[p] = 0;
  }
}

void play_values(const void* object, const PointBatch& batch, const double*, double* f) {
  const auto& points = *static_cast<const Points*>(object);
  std::copy_n(points.value.data() + points.next, batch.count, f);
  points.next += static_cast<std::size_t>(batch.count);
}

// Copies the rows of the next points of the second pass.
void play_rows(const Points& points, int rows, const PointBatch& batch, std::size_t first,
               const double* from, double* to) {
  const std::size_t count = points.count();
  for (int r = 0; r < rows; ++r, to += kLanes)
    std::copy_n(from + static_cast<std::size_t>(r) * count + first, batch.count, to);
}

void play_slopes(const void* object, const PointBatch& batch, const double* J, double* f,
                 double* g) {
  const auto& points = *static_cast<const Points*>(object);
  play_rows(points, points.size, batch, points.next, points.g, g);
  play_values(object, batch, J, f);
}

void play_models(const void* object, const PointBatch& batch, const double* J, double* f, double* g,
                 double* k) {
  const auto& points = *static_cast<const Points*>(object);
  play_rows(points, points.size * (points.size + 1) / 2, batch, points.next, points.H, k);
  play_slopes(object, batch, J, f, g);
}

// Returns the library's kernels for J of size D by D. They call a JacobianFunction for several
// points at a time.
const DensityKernels& kernels(int dim) {
  static const DensityKernels kernels[] = {jacobian_kernels(2, 2), jacobian_kernels(3, 3)};
  return kernels[dim - 2];
}

JacobianFunction recorder(const Points& points) { return {&points, &record, nullptr, nullptr}; }
JacobianFunction player(const Points& points) {
  return {&points, &play_values, &play_slopes, &play_models};
}

struct PythonDensity {
  std::shared_ptr<const Kept> density;
  int dim;
  bool needs_positive_determinant;

  bool is_inside(const double* J) const {
    if (!needs_positive_determinant) return true;
    using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    if (dim == 3) return Eigen::Map<const Matrix3>(J).determinant() > 0;
    return J[0] * J[3] - J[1] * J[2] > 0;
  }
};

// Returns the points for Python, (n, dim, dim), with the same entry of all points contiguous.
py::object jacobians(const PythonDensity& density, const Points& points) {
  const std::size_t n = points.count();
  const auto size = static_cast<std::size_t>(points.size);
  py::array_t<double> J({static_cast<py::ssize_t>(density.dim),
                         static_cast<py::ssize_t>(density.dim), static_cast<py::ssize_t>(n)});
  double* to = J.mutable_data();
  for (std::size_t r = 0; r < size; ++r)
    for (std::size_t q = 0; q < n; ++q) *to++ = points.J[q * size + r];
  return J.attr("transpose")(2, 0, 1);
}

// Sets the value to +inf outside the domain.
void limit_to_domain(const PythonDensity& density, Points& points) {
  for (std::size_t q = 0; q < points.count(); ++q)
    if (std::isnan(points.value[q]) ||
        !density.is_inside(points.J.data() + q * static_cast<std::size_t>(points.size)))
      points.value[q] = std::numeric_limits<double>::infinity();
}

// Calls Python for values.
void evaluate(const PythonDensity& density, Points& points) {
  const py::gil_scoped_acquire lock;
  // Density has checked the size.
  const auto value =
      density.density->get().attr("evaluate")(jacobians(density, points)).cast<Doubles>();
  points.value.assign(value.data(), value.data() + value.size());
  limit_to_domain(density, points);
}

// Calls Python for values, gradients and Hessians.
void linearize(const PythonDensity& density, Points& points) {
  const py::gil_scoped_acquire lock;
  const py::tuple all = density.density->get().attr("_linearize")(jacobians(density, points));
  const auto value = all[0].cast<Doubles>(), g = all[1].cast<Doubles>(), H = all[2].cast<Doubles>();
  points.value.assign(value.data(), value.data() + value.size());
  points.g = g.data();
  points.H = H.data();
  points.answers = std::make_unique<const Kept>(py::make_tuple(g, H));
  limit_to_domain(density, points);
}

Points recorded(int dim, const ContractionView& table, const BatchView& batch, double* scratch) {
  Points points{dim * dim, {}};
  points.J.reserve(static_cast<std::size_t>(table.points * BatchView::stride * points.size));
  const JacobianFunction function = recorder(points);
  double f[BatchView::stride];
  kernels(dim).values(&function, table, batch, scratch, f);
  return points;
}

void values(const void* object, const ContractionView& table, const BatchView& batch,
            double* scratch, double* f) {
  const auto& density = *static_cast<const PythonDensity*>(object);
  Points points = recorded(density.dim, table, batch, scratch);
  evaluate(density, points);
  const JacobianFunction function = player(points);
  kernels(density.dim).values(&function, table, batch, scratch, f);
}

void local(const void* object, const ContractionView& table, const BatchView& batch,
           BlendedCurvature curvature, double* scratch, double* f, double* gradient,
           double* hessian) {
  const auto& density = *static_cast<const PythonDensity*>(object);
  Points points = recorded(density.dim, table, batch, scratch);
  linearize(density, points);
  const JacobianFunction function = player(points);
  kernels(density.dim).local(&function, table, batch, curvature, scratch, f, gradient, hessian);
}

Barrier barrier_named(const std::string& name) {
  if (name == "none") return Barrier::None;
  return name == "strong" ? Barrier::Strong : Barrier::Weak;
}

FreeScale free_scale_named(const std::string& name) {
  if (name == "arbitrary") return FreeScale::Arbitrary;
  return name == "collapses" ? FreeScale::Collapses : FreeScale::Determined;
}

}  // namespace

EnergyFactory python_energy(const py::object& density) {
  DensityTraits traits;
  traits.name = density.attr("name").cast<std::string>();
  traits.curvatures = {Curvature::Projected, Curvature::Exact};
  traits.barrier = barrier_named(density.attr("barrier").cast<std::string>());
  traits.free_scale = free_scale_named(density.attr("free_scale").cast<std::string>());
  const bool positive = density.attr("domain").cast<std::string>() == "positive";
  const auto kept = std::make_shared<const Kept>(density);
  return {traits,
          [=](std::shared_ptr<const ElementSpace> space, std::shared_ptr<const RestShapes> rest,
              const std::vector<Quadrature>& rules) {
            const int dim = space->reference_dim();
            return std::make_shared<const DensityTerm>(
                traits, std::move(space), std::move(rest), rules,
                std::make_shared<const PythonDensity>(PythonDensity{kept, dim, positive}),
                DensityKernels{dim, dim, &values, &local, kernels(dim).scratch_size});
          }};
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
