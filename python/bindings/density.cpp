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

// The points that the kernels come by, in their order: the same in all kernels.
struct Points {
  int size;                         // entries of J
  std::vector<double> J;            // #q by size
  std::vector<double> value, g, H;  // #q, #q by size, #q by size by size
  mutable std::size_t next = 0;     // point to be answered
  std::size_t count() const { return J.size() / static_cast<std::size_t>(size); }
};

constexpr int kLanes = PointBatch::kMost;

void record(const void* points, const PointBatch& batch, const double* J, double* f) {
  auto& to = const_cast<Points&>(*static_cast<const Points*>(points));
  for (int p = 0; p < batch.count; ++p) {
    for (int r = 0; r < to.size; ++r) to.J.push_back(J[r * kLanes + p]);
    f[p] = 0;
  }
}

void play_values(const void* object, const PointBatch& batch, const double*, double* f) {
  const auto& points = *static_cast<const Points*>(object);
  std::copy_n(points.value.data() + points.next, batch.count, f);
  points.next += static_cast<std::size_t>(batch.count);
}

void play_slopes(const void* object, const PointBatch& batch, const double* J, double* f,
                 double* g) {
  const auto& points = *static_cast<const Points*>(object);
  const int size = points.size;
  const double* gradient = points.g.data() + points.next * static_cast<std::size_t>(size);
  play_values(object, batch, J, f);
  for (int p = 0; p < batch.count; ++p, gradient += size)
    for (int r = 0; r < size; ++r) g[r * kLanes + p] = gradient[r];
}

void play_models(const void* object, const PointBatch& batch, const double* J, double* f, double* g,
                 double* k) {
  const auto& points = *static_cast<const Points*>(object);
  const int size = points.size;
  const double* hessian = points.H.data() + points.next * static_cast<std::size_t>(size * size);
  play_slopes(object, batch, J, f, g);
  for (int p = 0; p < batch.count; ++p, hessian += size * size)
    for (int i = 0, r = 0; i < size; ++i)
      for (int j = 0; j <= i; ++j, ++r) k[r * kLanes + p] = hessian[i * size + j];
}

// The library's, which call a JacobianFunction for some points at a time; by D of J, D by D.
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

void copy_into(std::vector<double>& out, const py::handle& array, std::size_t count) {
  const auto numbers = py::cast<Doubles>(array);  // of the right size: Density has seen to it
  out.assign(numbers.data(), numbers.data() + count);
}

// The points as Python gets them, (n, dim, dim).
py::array_t<double> jacobians(const PythonDensity& density, const Points& points) {
  return py::array_t<double>(
      {static_cast<py::ssize_t>(points.count()), static_cast<py::ssize_t>(density.dim),
       static_cast<py::ssize_t>(density.dim)},
      points.J.data());
}

// Asks Python for values. Outside of its domain a density is +inf.
void evaluate(const PythonDensity& density, Points& points) {
  const py::gil_scoped_acquire lock;
  const std::size_t n = points.count();
  const auto size = static_cast<std::size_t>(points.size);
  const auto J = jacobians(density, points);
  copy_into(points.value, density.density->get().attr("evaluate")(J), n);
  for (std::size_t q = 0; q < n; ++q) {
    const bool inside = density.is_inside(points.J.data() + q * size);
    if (!inside || std::isnan(points.value[q]))
      points.value[q] = std::numeric_limits<double>::infinity();
  }
}

// Asks Python for gradients and Hessians.
void differentiate(const PythonDensity& density, Points& points) {
  const py::gil_scoped_acquire lock;
  const std::size_t n = points.count();
  const auto size = static_cast<std::size_t>(points.size);
  const py::tuple derivatives =
      density.density->get().attr("differentiate")(jacobians(density, points));
  copy_into(points.g, derivatives[0], n * size);
  copy_into(points.H, derivatives[1], n * size * size);
}

Points recorded(int dim, const ContractionView& table, const BatchView& batch, double* scratch) {
  Points points{dim * dim, {}, {}, {}, {}};
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
  evaluate(density, points);
  differentiate(density, points);
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
