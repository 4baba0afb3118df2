#include "density.h"

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

constexpr int kSize = 4;  // entries of J, 2 by 2

// The points that the kernels come by, in their order: the same in all kernels.
struct Points {
  std::vector<double> J;            // #q by 4
  std::vector<double> value, g, H;  // #q, #q by 4, #q by 4 by 4
  mutable std::size_t next = 0;     // point to be answered
  std::size_t count() const { return J.size() / kSize; }
};

constexpr int kLanes = PointBatch::kMost;

void record(const void* points, const PointBatch& batch, const double* J, double* f) {
  auto& to = const_cast<Points&>(*static_cast<const Points*>(points)).J;
  for (int p = 0; p < batch.count; ++p) {
    for (int r = 0; r < kSize; ++r) to.push_back(J[r * kLanes + p]);
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
  const double* gradient = points.g.data() + points.next * kSize;
  play_values(object, batch, J, f);
  for (int p = 0; p < batch.count; ++p, gradient += kSize)
    for (int r = 0; r < kSize; ++r) g[r * kLanes + p] = gradient[r];
}

void play_models(const void* object, const PointBatch& batch, const double* J, double* f, double* g,
                 double* k) {
  const auto& points = *static_cast<const Points*>(object);
  const double* hessian = points.H.data() + points.next * kSize * kSize;
  play_slopes(object, batch, J, f, g);
  for (int p = 0; p < batch.count; ++p, hessian += kSize * kSize)
    for (int i = 0, r = 0; i < kSize; ++i)
      for (int j = 0; j <= i; ++j, ++r) k[r * kLanes + p] = hessian[i * kSize + j];
}

// The library's, which call a JacobianFunction for some points at a time.
const DensityKernels& kernels() {
  static const DensityKernels kernels = jacobian_kernels(2, 2);
  return kernels;
}

JacobianFunction recorder(const Points& points) { return {&points, &record, nullptr, nullptr}; }
JacobianFunction player(const Points& points) {
  return {&points, &play_values, &play_slopes, &play_models};
}

struct PythonDensity {
  std::shared_ptr<const Kept> density;
  bool needs_positive_determinant;
};

void copy_into(std::vector<double>& out, const py::handle& array, std::size_t count) {
  const auto numbers = py::cast<Doubles>(array);  // of the right size: Density has seen to it
  out.assign(numbers.data(), numbers.data() + count);
}

// Asks Python. Outside of its domain a density is +inf.
void answer(const PythonDensity& density, Points& points, bool models) {
  const py::gil_scoped_acquire lock;
  const std::size_t n = points.count();
  py::array_t<double> J({static_cast<py::ssize_t>(n), py::ssize_t{2}, py::ssize_t{2}},
                        points.J.data());
  const py::handle callee = density.density->get();
  copy_into(points.value, callee.attr("evaluate")(J), n);
  for (std::size_t q = 0; q < n; ++q) {
    const double* j = points.J.data() + q * kSize;
    const bool inside = !density.needs_positive_determinant || j[0] * j[3] - j[1] * j[2] > 0;
    if (!inside || std::isnan(points.value[q]))
      points.value[q] = std::numeric_limits<double>::infinity();
  }
  if (!models) return;
  const py::tuple derivatives = callee.attr("differentiate")(J);
  copy_into(points.g, derivatives[0], n * kSize);
  copy_into(points.H, derivatives[1], n * kSize * kSize);
}

Points recorded(const ContractionView& table, const BatchView& batch, double* scratch) {
  Points points;
  const JacobianFunction function = recorder(points);
  double f[BatchView::stride];
  kernels().values(&function, table, batch, scratch, f);
  return points;
}

void values(const void* object, const ContractionView& table, const BatchView& batch,
            double* scratch, double* f) {
  Points points = recorded(table, batch, scratch);
  answer(*static_cast<const PythonDensity*>(object), points, false);
  const JacobianFunction function = player(points);
  kernels().values(&function, table, batch, scratch, f);
}

void local(const void* object, const ContractionView& table, const BatchView& batch,
           BlendedCurvature curvature, double* scratch, double* f, double* gradient,
           double* hessian) {
  Points points = recorded(table, batch, scratch);
  answer(*static_cast<const PythonDensity*>(object), points, true);
  const JacobianFunction function = player(points);
  kernels().local(&function, table, batch, curvature, scratch, f, gradient, hessian);
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
  const auto object = std::make_shared<const PythonDensity>(
      PythonDensity{std::make_shared<const Kept>(density), positive});
  const DensityKernels ours{2, 2, &values, &local, kernels().scratch_size};
  return {traits, [=](std::shared_ptr<const ElementSpace> space, const RestShapes& rest,
                      const std::vector<Quadrature>& rules) {
            return std::make_shared<const DensityTerm>(traits, std::move(space), rest, rules,
                                                       object, ours);
          }};
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
