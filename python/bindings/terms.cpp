#include "terms.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "arrays.h"
#include "kept.h"
#include "majorant/framework/detail/packed_symmetric.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/maps/quadrature_ladder.h"
#include "majorant/parametrization/maps/rest_shapes_of.h"
#include "majorant/terms/local_term.h"
#include "majorant/terms/quadratic_penalty.h"
#include "mesh.h"
#include "options.h"
#include "run.h"

namespace majorant::python {
namespace {

Space make_space(const SharedPolygons& polygons, int degree) {
  Run run;
  return run([&] {
    auto mesh = std::make_shared<const SurfaceMesh>(
        SurfaceMesh::from_polygons(*polygons, run.stop(), Components::Any));
    auto space =
        std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(), degree);
    return Space{std::move(mesh), std::move(space)};
  });
}

// Of linear maps, 2 numbers a vertex: the same map in the space.
Vec elevated(const Space& s, Vec uv) {
  auto space =
      std::make_shared<const BezierTriangleSpace>(s.mesh->faces(), s.mesh->vertex_count(), 1);
  while (space->degree() < s.space->degree()) {
    const auto higher = std::make_shared<const BezierTriangleSpace>(
        s.mesh->faces(), s.mesh->vertex_count(), space->degree() + 1);
    uv = space->elevate(uv, *higher);
    space = higher;
  }
  return uv;
}

RowMatrix nodes_of(const Space& s) {
  RowMatrix nodes(s.space->node_count(), 3);
  for (Index d = 0; d < 3; ++d) {
    Vec coordinates = Vec::Zero(2 * s.mesh->vertex_count());
    for (Index v = 0; v < s.mesh->vertex_count(); ++v)
      coordinates[2 * v] = s.mesh->input_position(v)[d];
    const Vec at_nodes = elevated(s, coordinates);
    for (Index n = 0; n < nodes.rows(); ++n) nodes(n, d) = at_nodes[2 * n];
  }
  return nodes;
}

// One term a summand, in the optimizer's rule for the degree; lattice points instead, if any.
std::vector<std::pair<Term, double>> energy_terms_of(const Space& s, const py::object& energies,
                                                     int lattice_points) {
  const RestShapes rest = rest_shapes(*s.mesh);
  const Quadrature rule = optimizer_ladder(s.space->degree(), lattice_points).guarded.front();
  std::vector<std::pair<Term, double>> terms;
  for (const WeightedEnergy& summand : energy_sum(energies))
    terms.emplace_back(Term{summand.make(s.space, rest, {rule})}, summand.weight);
  return terms;
}

// Rows of A x - b, A in compressed rows.
Term penalty(const Integers& starts, const Integers& columns, const Doubles& values,
             const Doubles& targets) {
  std::vector<LinearExpression> rows;
  for (py::ssize_t r = 0; r + 1 < starts.size(); ++r) {
    LinearExpression& row = rows.emplace_back();
    for (Index k = starts.at(r); k < starts.at(r + 1); ++k)
      row.terms.emplace_back(columns.at(k), values.at(k));
    row.target = targets.at(r);
  }
  return {std::make_shared<const QuadraticPenalty>(rows)};
}

Term linear(const Doubles& coefficients) {
  return {linear_term("linear", matrix<Vec>(coefficients))};
}

// sum over elements of f(the element's unknowns), f in Python, a batch at a time.
class PythonTerm final : public EnergyTerm {
 public:
  PythonTerm(std::string name, ElementDofs element_dofs, py::object function)
      : name_(std::move(name)),
        element_dofs_(std::move(element_dofs)),
        function_(std::move(function)) {}

  std::string_view name() const override { return name_; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override {
    return c == Curvature::Exact || c == Curvature::Projected;
  }

  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    const py::gil_scoped_acquire lock;
    const Doubles found = ask("evaluate", x, batch).cast<Doubles>();
    for (std::size_t p = 0; p < batch.elements.size(); ++p) f[p] = finite(found.at(p));
  }

  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState&,
             Workspace&, LocalSystem& out) const override {
    const py::gil_scoped_acquire lock;
    const int n = element_dofs_.local_size();
    const Doubles value = ask("evaluate", x, batch).cast<Doubles>();
    const py::tuple derivatives = ask("differentiate", x, batch);
    const Doubles gradient = derivatives[0].cast<Doubles>();
    const Doubles hessian = derivatives[1].cast<Doubles>();
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      out.value[p] = finite(value.at(p));
      for (int i = 0; i < n; ++i)
        out.gradient[static_cast<std::size_t>(i) * LocalSystem::stride + p] = gradient.at(p, i);
      if (!out.hessian) continue;
      std::vector<double> packed;
      for (int i = 0; i < n; ++i)
        packed.insert(packed.end(), hessian.data(p, i), hessian.data(p, i) + i + 1);
      if (curvature.projection_weight > 0)
        clamp_eigenvalues(n, curvature.projection_weight, packed.data());
      for (std::size_t k = 0; k < packed.size(); ++k)
        out.hessian[k * LocalSystem::stride + p] = packed[k];
    }
  }

 private:
  static double finite(double value) {
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
  }

  // The batch's unknowns, an element a row, and the elements' numbers.
  py::object ask(const char* what, VecIn x, const ElementBatch& batch) const {
    const int n = element_dofs_.local_size(), block = element_dofs_.block;
    const auto count = static_cast<py::ssize_t>(batch.elements.size());
    py::array_t<double> unknowns({count, static_cast<py::ssize_t>(n)});
    Integers elements(count);
    for (py::ssize_t p = 0; p < count; ++p) {
      const Index e = batch.elements[static_cast<std::size_t>(p)];
      elements.mutable_at(p) = e;
      for (int k = 0; k < n; ++k)
        unknowns.mutable_at(p, k) = x[block * element_dofs_.nodes(e, k / block) + k % block];
    }
    return function_.get().attr(what)(unknowns, elements);
  }

  std::string name_;
  ElementDofs element_dofs_;
  Kept function_;
};

Term element_term(const std::string& name, const Integers& nodes, int block,
                  const py::object& function) {
  return {
      std::make_shared<const PythonTerm>(name, ElementDofs{matrix<Cells>(nodes), block}, function)};
}

}  // namespace

void bind_terms(py::module_& module) {
  py::class_<Space>(module, "Space")
      .def(py::init(&make_space), py::arg("mesh"), py::arg("degree"))
      .def_property_readonly("degree", [](const Space& s) { return s.space->degree(); })
      .def_property_readonly("node_count", [](const Space& s) { return s.space->node_count(); })
      .def_property_readonly("area", [](const Space& s) { return s.mesh->area(); })
      .def_property_readonly("nodes", [](const Space& s) { return moved(nodes_of(s)); })
      .def_property_readonly(
          "cells",
          [](const py::object& self) { return view(self, self.cast<Space&>().space->cells()); })
      .def_property_readonly("input_vertices",
                             [](const Space& s) {
                               Eigen::VectorXi numbers(s.mesh->vertex_count());
                               for (Index v = 0; v < numbers.size(); ++v)
                                 numbers[v] = s.mesh->input_vertex(v);
                               return moved(std::move(numbers));
                             })
      .def(
          "elevate",
          [](const Space& s, const Doubles& uv) { return moved(elevated(s, matrix<Vec>(uv))); },
          py::arg("uv"))
      .def("tutte",
           [](const Space& s) {
             Run run;
             return moved(run([&] {
               s.mesh->require_planar();
               return elevated(s, tutte_map(*s.mesh, run.stop()));
             }));
           })
      .def("energy_terms", &energy_terms_of, py::arg("energies"), py::arg("lattice_points"));
  py::class_<Term>(module, "Term").def_property_readonly("name", [](const Term& t) {
    return t.term->name();
  });
  module.def("penalty", &penalty, py::arg("starts"), py::arg("columns"), py::arg("values"),
             py::arg("targets"));
  module.def("linear_term", &linear, py::arg("coefficients"));
  module.def("element_term", &element_term, py::arg("name"), py::arg("nodes"), py::arg("block"),
             py::arg("function"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
