// Terms made in Python, on single unknowns and on functions of few unknowns.
#include "terms.h"

#include <pybind11/stl.h>

#include <array>
#include <map>
#include <string>

#include "arrays.h"
#include "element_functions.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"
#include "majorant/framework/terms/quadratic_penalty.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "module.h"
#include "options.h"
#include "space.h"

namespace majorant::python {
namespace {

// Returns the quadrature rule: for triangles the optimizer's, or one of so many lattice points if
// that is positive; for other elements the rule of their space.
Quadrature rule_of(const Space& s, int lattice_points) {
  if (!s.mesh) return s.space->default_rule(s.rest.jacobian());
  return optimizer_quadrature(s.space->degree(), lattice_points).guarded.front();
}

// Returns one term and weight for each summand.
std::vector<std::pair<Term, double>> energy_terms(const Space& s, const py::object& energies,
                                                  int lattice_points) {
  std::vector<std::pair<Term, double>> terms;
  for (const WeightedEnergy& summand : energy_sum(energies))
    terms.emplace_back(Term{summand.make(s.space, s.rest, {rule_of(s, lattice_points)})},
                       summand.weight);
  return terms;
}

// Returns the term |A x - b|^2, A in compressed rows.
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

Term element_term(const std::string& name, const Integers& nodes, const Integers& counts, int block,
                  const py::object& function, const std::vector<std::string>& curvatures,
                  const std::optional<Doubles>& data) {
  std::vector<Curvature> models;
  for (const std::string& model : curvatures) models.push_back(curvature_named(model));
  TermData numbers;
  if (data) {
    numbers.numbers = Eigen::Map<const Vec>(data->data(), data->size());
    numbers.per_element = data->ndim() == 1 ? 0 : static_cast<Index>(data->shape(1));
  }
  return {
      python_term(name, elements_of(nodes, counts, block), function, models, std::move(numbers))};
}

// Returns rho, rho' and rho'' of the named loss at every s.
py::tuple robust_loss(const std::string& name, double width, const Doubles& s) {
  const std::map<std::string, RobustLoss (*)(double)> losses{{"huber", huber_loss},
                                                             {"soft-l1", soft_l1_loss},
                                                             {"cauchy", cauchy_loss},
                                                             {"arctan", arctan_loss},
                                                             {"tukey", tukey_loss}};
  const RobustLoss loss = losses.at(name)(width);
  std::array<Vec, 3> out;
  for (Vec& part : out) part.resize(s.size());
  for (Index k = 0; k < out[0].size(); ++k) {
    const std::array<double, 3> at = loss(s.at(k));
    for (std::size_t i = 0; i < at.size(); ++i) out[i][k] = at[i];
  }
  return py::make_tuple(moved(std::move(out[0])), moved(std::move(out[1])),
                        moved(std::move(out[2])));
}

}  // namespace

void bind_terms(py::module_& module) {
  py::class_<Term>(module, "Term").def_property_readonly("name", [](const Term& t) {
    return t.term->name();
  });
  module.def("energy_terms", &energy_terms, py::arg("space"), py::arg("energies"),
             py::arg("lattice_points"));
  module.def("penalty", &penalty, py::arg("starts"), py::arg("columns"), py::arg("values"),
             py::arg("targets"));
  module.def("linear_term", &linear, py::arg("coefficients"));
  module.def("element_term", &element_term, py::arg("name"), py::arg("nodes"), py::arg("counts"),
             py::arg("block"), py::arg("function"), py::arg("curvatures"), py::arg("data"));
  module.def("robust_loss", &robust_loss, py::arg("name"), py::arg("width"), py::arg("s"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
